//! What the reader told, whether there is light, and what repair finds.
use crate::repair::repair;
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
};

pub(super) fn findings(scene: &Scene) -> Vec<Finding> {
    let told = scene.warnings.iter().filter(|warning| warning.kind.remedy().is_none()).cloned();
    let dark = (!scene.has_light()).then(|| Finding {
        kind: Kind::Dark,
        patches: Vec::new(),
        what: "no patch emits light, and there is no other light".into(),
        repair: "give the material of an emitter an emission above 0, or solve with --emit or --sky".into(),
        places: Vec::new(),
    });
    told.chain(dark).chain(repair(scene).repairs).collect()
}
