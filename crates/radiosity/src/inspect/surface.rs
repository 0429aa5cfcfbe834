//! What a patch gets wrong by itself.
use crate::plane::slack;
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::Patch,
};
use glam::DVec3;

/// A patch whose width is less than so many times its coordinates' rounding is a sliver.
const WIDTH: f64 = 1e3;

pub(super) fn findings(scene: &Scene) -> Vec<Finding> {
    let told = scene.warnings.iter().cloned();
    let dark = (!scene.has_light()).then(|| Finding {
        kind: Kind::Dark,
        patches: Vec::new(),
        what: "no patch emits light, and there is no other light".into(),
        repair: "give the material of an emitter an emission above 0, or solve with --emit or --sky".into(),
    });
    let own = scene.patches.iter().flat_map(|patch| reflectance(patch).into_iter().chain(sliver(patch)));
    told.chain(dark).chain(own).collect()
}

fn reflectance(patch: &Patch) -> Option<Finding> {
    let (band, value) =
        patch.reflectance.iter().enumerate().find(|(_, value)| !(0.0..1.0).contains(*value))?;
    Some(Finding {
        kind: Kind::Reflectance,
        patches: vec![patch.name.clone()],
        what: format!("its reflectance in band {band} is {value}; a surface reflects from 0 to below 1"),
        repair: "lower the diffuse colour; white paint is about 0.85".into(),
    })
}

/// A patch is narrow when its area is small for its diameter.
fn sliver(patch: &Patch) -> Option<Finding> {
    let points: Vec<DVec3> = patch.polygon.loops().flatten().copied().collect();
    let length = points.iter().map(|point| point.distance(points[0])).fold(0.0, f64::max);
    let width = patch.polygon.area() / length;
    (width < WIDTH * slack(&points)).then(|| Finding {
        kind: Kind::Sliver,
        patches: vec![patch.name.clone()],
        what: format!("it is {length:.3e} long and only {width:.3e} wide"),
        repair: "remove it, or give it a width that its coordinates can hold".into(),
    })
}
