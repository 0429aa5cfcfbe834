//! No surface reflects all light, or more.
use super::findings::reflectance;
use crate::scene::{Scene, finding::Finding};

/// What reflects all light in a file reflects so much: brighter than white paint, and light ends.
const LARGEST: f64 = 0.99;

/// Limits the reflectances of 1 and more, and negative ones.
pub(super) fn limit(scene: &mut Scene) -> Vec<Finding> {
    let mut findings = Vec::new();
    for patch in &mut scene.patches {
        let Some(finding) = reflectance(patch) else { continue };
        findings.push(finding);
        for value in &mut patch.reflectance {
            *value = if *value > 0.0 { value.min(LARGEST) } else { 0.0 };
        }
    }
    findings
}
