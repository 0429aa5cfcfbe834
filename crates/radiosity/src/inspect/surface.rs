//! What the reader told, whether there is light, and what repair finds.
use crate::repair::repair_until;
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
};

pub(super) fn findings(scene: &Scene, stop: &dyn Fn() -> bool) -> Vec<Finding> {
    let told = scene.warnings.iter().filter(|warning| warning.kind.remedy().is_none()).cloned();
    let has_materials = scene.patches.iter().any(|patch| !patch.material.is_empty());
    let remedy = match has_materials {
        true => "give the material of an emitter an emission above 0, or solve with --emit or --sky",
        false => {
            "solve with --sky, or give the surfaces materials, one of which emits, in a format that has them"
        }
    };
    let dark = (!scene.has_light()).then(|| Finding {
        kind: Kind::Dark,
        patches: Vec::new(),
        what: "no patch emits light, and there is no other light".into(),
        repair: remedy.into(),
        places: Vec::new(),
    });
    let repairs = repair_until(scene, stop).into_iter().flat_map(|repaired| repaired.repairs);
    told.chain(dark).chain(repairs).collect()
}
