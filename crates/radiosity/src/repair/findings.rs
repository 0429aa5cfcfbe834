//! What is wrong with patches, in words.
use crate::coplanar::Overlap;
use crate::plane::slack;
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::Patch,
};
use glam::DVec3;

/// A patch whose width is less than so many times its coordinates' rounding is a sliver.
pub(super) const WIDTH: f64 = 1e3;

/// Of a patch that reflects all light, or more, or less than none.
pub(super) fn reflectance(patch: &Patch) -> Option<Finding> {
    let (band, value) =
        patch.reflectance.iter().enumerate().find(|(_, value)| !(0.0..1.0).contains(*value))?;
    Some(Finding {
        kind: Kind::Reflectance,
        patches: vec![patch.name.clone()],
        what: format!("its reflectance in band {band} is {value}; a surface reflects from 0 to below 1"),
        repair: "lower the diffuse colour; white paint is about 0.85".into(),
        places: Vec::new(),
    })
}

/// A patch is narrow when its area is small for its diameter.
pub(super) fn sliver(patch: &Patch) -> Option<Finding> {
    let points: Vec<DVec3> = patch.polygon.loops().flatten().copied().collect();
    let length = points.iter().map(|point| point.distance(points[0])).fold(0.0, f64::max);
    let width = patch.polygon.area() / length;
    (width < WIDTH * slack(&points)).then(|| Finding {
        kind: Kind::Sliver,
        patches: vec![patch.name.clone()],
        what: format!("it is {length:.3e} long and only {width:.3e} wide"),
        repair: "remove it, or give it a width that its coordinates can hold".into(),
        places: Vec::new(),
    })
}

/// Of two patches that overlap.
pub(crate) fn overlap(scene: &Scene, overlap: &Overlap) -> Finding {
    let [a, b] = overlap.patches.map(|index| &scene.patches[index]);
    let areas = [a, b].map(|patch| patch.polygon.area());
    let same = same_points(a, b);
    let lit = [a, b].iter().filter(|patch| patch.emits()).count();
    let (kind, what) = match (same, lit) {
        (true, _) => (Kind::Duplicate, "they have the same outline".to_owned()),
        (false, 1) => (
            Kind::EmitterInFace,
            format!("an emitter lies in the plane of a face and covers {:.4e} of it", overlap.area),
        ),
        (false, _) => {
            let share = 100.0 * overlap.area / areas[0].min(areas[1]);
            (
                Kind::Overlap,
                format!(
                    "they lie in one plane and cover each other: {:.4e}, {share:.3} % of the smaller",
                    overlap.area
                ),
            )
        }
    };
    let repair = match kind {
        Kind::Duplicate => "remove one; or let reading or inspect --repair do it",
        _ => "cut one out of the other; or let reading or inspect --repair do it",
    };
    let patches = vec![a.name.clone(), b.name.clone()];
    Finding { kind, patches, what, repair: repair.into(), places: Vec::new() }
}

/// Whether two patches have the same vertices.
fn same_points(a: &Patch, b: &Patch) -> bool {
    let sorted = |patch: &Patch| {
        let mut points: Vec<[f64; 3]> = patch.polygon.loops().flatten().map(|p| p.to_array()).collect();
        points.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        points
    };
    sorted(a) == sorted(b)
}
