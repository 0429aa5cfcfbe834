//! Patches that face the same way and cover each other in one plane.
use crate::plane::{Plane, slack};
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::Patch,
};
use glam::DVec3;
use polycsg::Region;

/// Two patches, by index, and what they share.
#[derive(Clone, Debug)]
pub(crate) struct Overlap {
    pub(crate) patches: [usize; 2],
    /// The area that both cover.
    area: f64,
}

/// The pairs of patches that face the same way and cover each other in one plane: what is seen of one is counted again for the
/// other. O(n log n) for n patches that are spread out.
#[must_use]
pub fn coplanar_overlaps(scene: &Scene) -> Vec<Finding> {
    overlaps(scene).iter().map(|overlap| finding(scene, overlap)).collect()
}

fn finding(scene: &Scene, overlap: &Overlap) -> Finding {
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
        Kind::Duplicate => "remove one; or let inspect --repair do it",
        _ => "cut one out of the other; or let inspect --repair do it",
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

/// A patch with what the search needs.
struct Sheet {
    plane: Plane,
    low: DVec3,
    high: DVec3,
    slack: f64,
}

/// All pairs that overlap, the lower index first, in order.
pub(crate) fn overlaps(scene: &Scene) -> Vec<Overlap> {
    let sheets: Vec<Sheet> = scene.patches.iter().map(sheet).collect();
    let mut order: Vec<usize> = (0..sheets.len()).collect();
    order.sort_by(|a, b| sheets[*a].low.x.total_cmp(&sheets[*b].low.x).then(a.cmp(b)));
    let mut all = Vec::new();
    for (rank, &first) in order.iter().enumerate() {
        let reach = sheets[first].high.x;
        for &second in order[rank + 1..].iter().take_while(|other| sheets[**other].low.x <= reach) {
            let patches = [first.min(second), first.max(second)];
            if may_overlap(scene, &sheets, patches) {
                all.extend(overlap(scene, &sheets, patches));
            }
        }
    }
    all.sort_by_key(|overlap| overlap.patches);
    all
}

fn sheet(patch: &Patch) -> Sheet {
    let points: Vec<DVec3> = patch.polygon.loops().flatten().copied().collect();
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    Sheet { plane: Plane::of(&patch.polygon), low, high, slack: slack(&points) }
}

/// Boxes that meet, planes that face the same way, each patch on the plane of the other.
fn may_overlap(scene: &Scene, sheets: &[Sheet], [first, second]: [usize; 2]) -> bool {
    let [a, b] = [&sheets[first], &sheets[second]];
    let slack = a.slack.max(b.slack);
    let meet = (a.low - b.high).max_element() <= slack && (b.low - a.high).max_element() <= slack;
    let on = |plane: &Plane, patch: usize| {
        scene.patches[patch].polygon.loops().flatten().all(|point| plane.height(*point).abs() <= slack)
    };
    meet && a.plane.normal.dot(b.plane.normal) > 0.0 && on(&a.plane, second) && on(&b.plane, first)
}

/// What two patches of one plane share; nothing when it is no more than rounding can make of a common edge.
fn overlap(scene: &Scene, sheets: &[Sheet], patches: [usize; 2]) -> Option<Overlap> {
    let [first, second] = patches;
    let plane = &sheets[first].plane;
    let region = |patch: usize| plane.region(&scene.patches[patch].polygon);
    let shared: Region = region(first).intersection(&region(second));
    let size = (sheets[first].high - sheets[first].low).max_element();
    let rounding = sheets[first].slack.max(sheets[second].slack) * size;
    let steepness = 1.0 / plane.normal.abs().max_element();
    let area = shared.area() * steepness;
    (area > rounding).then_some(Overlap { patches, area })
}
