//! Patches that face the same way and cover each other in one plane.
use crate::coplanar::{SINGLE, overlaps};
use crate::repair::findings::overlap;
use crate::scene::{Scene, finding::Finding};

/// The pairs of patches that face the same way and cover each other in one plane: what is seen of one is counted again for the
/// other. O(n log n) for n patches that are spread out.
#[must_use]
pub fn coplanar_overlaps(scene: &Scene) -> Vec<Finding> {
    overlaps(scene, SINGLE).iter().map(|found| overlap(scene, found)).collect()
}
