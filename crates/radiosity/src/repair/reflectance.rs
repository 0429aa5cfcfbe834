//! No surface reflects all light, or more.
use super::findings::reflectance;
use crate::scene::{Scene, finding::Finding};

/// What reflects all light in a file reflects so much: brighter than white paint, and light ends.
pub(crate) const BRIGHTEST: f64 = 0.99;

/// Limits the reflectances of 1 and more, and negative ones; of a patch with a picture also what its colours are multiplied by.
pub(super) fn limit(scene: &mut Scene) -> Vec<Finding> {
    let mut findings = Vec::new();
    for patch in &mut scene.patches {
        let Some(finding) = reflectance(patch) else { continue };
        findings.push(finding);
        let factor = patch.texture.iter_mut().flat_map(|texture| &mut texture.factor);
        for value in patch.reflectance.iter_mut().chain(factor) {
            *value = if *value > 0.0 { value.min(BRIGHTEST) } else { 0.0 };
        }
    }
    findings
}
