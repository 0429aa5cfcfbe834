//! Patches that face the same way and cover each other in one plane.
use crate::coplanar::{Overlap, SINGLE, overlaps};
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::Patch,
};

/// The pairs of patches that face the same way and cover each other in one plane: what is seen of one is counted again for the
/// other. O(n log n) for n patches that are spread out.
#[must_use]
pub fn coplanar_overlaps(scene: &Scene) -> Vec<Finding> {
    overlaps(scene, SINGLE).iter().map(|overlap| finding(scene, overlap)).collect()
}

pub(crate) fn finding(scene: &Scene, overlap: &Overlap) -> Finding {
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
