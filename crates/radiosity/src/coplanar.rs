//! Patches that face the same way and cover each other in one plane: what is seen of one is counted again for the other.
//!
//! Files hold coordinates in single precision, so planes nearer than its rounding are one, and strips along edges that are thinner than
//! it do not count. Where two planes are a little further apart the front one hides the other, and nothing is counted twice.
use crate::extent::{BoxTree, Extent};
use crate::plane::Plane;
use crate::scene::{Scene, patch::Patch};
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};

/// A few roundings of a single, in shares of a patch's size.
pub(crate) const SINGLE: f64 = 1.0 / (1 << 21) as f64;
/// Beyond so many vertices two polygons are not asked whether an edge separates them.
const SIMPLE: usize = 32;

/// Two patches, the lower index first, and what they share.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Overlap {
    pub(crate) patches: [usize; 2],
    /// The area that both cover.
    pub(crate) area: f64,
}

/// A patch with what the search needs.
struct Sheet<'s> {
    patch: &'s Patch,
    plane: Plane,
    extent: Extent,
    /// How far the roundings of its coordinates may reach.
    slack: f64,
}

/// All pairs that overlap, in order. Planes are one when they are nearer than `near`, in shares of the larger patch, or than the
/// coordinates' rounding. O(n log n) for n patches that are spread out.
pub(crate) fn overlaps(scene: &Scene, near: f64) -> Vec<Overlap> {
    let sheets: Vec<Sheet<'_>> = scene.patches.iter().map(Sheet::new).collect();
    let boxes = BoxTree::new(sheets.iter().map(|sheet| sheet.extent));
    let around = |first: usize| {
        let sheet = &sheets[first];
        let reach = sheet.extent.grown(sheet.slack + near * sheet.extent.diagonal());
        let others = boxes.meeting(&reach).into_iter().filter(move |&second| second != first);
        others.map(move |second| [first.min(second), first.max(second)])
    };
    let mut pairs: Vec<[usize; 2]> = (0..sheets.len())
        .flat_map(around)
        .filter(|pair| may_overlap(pair.map(|k| &sheets[k]), near))
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs.into_iter().filter_map(|patches| overlap(&sheets, patches)).collect()
}

impl Sheet<'_> {
    fn new(patch: &Patch) -> Sheet<'_> {
        let points: Vec<DVec3> = patch.polygon.loops().flatten().copied().collect();
        Sheet {
            patch,
            plane: Plane::of(&patch.polygon),
            extent: Extent::holding(&points),
            slack: patch.slack(),
        }
    }

    fn points(&self) -> impl Iterator<Item = DVec3> {
        self.patch.polygon.loops().flatten().copied()
    }
}

/// The length of all edges.
pub(crate) fn perimeter(polygon: &PlanarPolygon) -> f64 {
    let ring = |points: &[DVec3]| {
        points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| a.distance(*b)).sum::<f64>()
    };
    polygon.loops().map(ring).sum()
}

/// How wide a strip is rounding, for two patches whose planes may be so far apart.
fn strip([a, b]: [&Sheet<'_>; 2], near: f64) -> f64 {
    a.slack.max(b.slack) + near * a.extent.diagonal().max(b.extent.diagonal())
}

/// Planes that face the same way, each patch on the plane of the other.
fn may_overlap(pair: [&Sheet<'_>; 2], near: f64) -> bool {
    let [a, b] = pair;
    let apart = strip(pair, near);
    let on =
        |plane: &Plane, sheet: &Sheet<'_>| sheet.points().all(|point| plane.height(point).abs() <= apart);
    a.plane.normal.dot(b.plane.normal) > 0.0 && on(&a.plane, b) && on(&b.plane, a)
}

/// What two patches of one plane share; nothing where it is no more than a strip along an edge that rounding can make.
fn overlap(sheets: &[Sheet<'_>], patches: [usize; 2]) -> Option<Overlap> {
    let pair = patches.map(|index| &sheets[index]);
    let [a, b] = pair;
    let width = strip(pair, SINGLE);
    if is_separated(pair, width) || is_separated([b, a], width) {
        return None;
    }
    let [one, other] = pair.map(|sheet| a.plane.region(&sheet.patch.polygon));
    let steepness = 1.0 / a.plane.normal.abs().max_element();
    let area = one.intersection(&other).area() * steepness;
    let least = pair.map(|sheet| perimeter(&sheet.patch.polygon)).into_iter().fold(f64::INFINITY, f64::min);
    (area > width * least).then_some(Overlap { patches, area })
}

/// Whether a line along an edge of the first polygon has it on one side and the other, but for a strip, on the other side.
fn is_separated([a, b]: [&Sheet<'_>; 2], width: f64) -> bool {
    let flat = |sheet: &Sheet<'_>| sheet.points().map(|point| a.plane.flatten(point)).collect::<Vec<DVec2>>();
    let (ours, theirs) = (flat(a), flat(b));
    if ours.len() > SIMPLE || theirs.len() > SIMPLE {
        return false;
    }
    let outline = a.patch.polygon.loops().next().map_or(0, <[DVec3]>::len);
    (0..outline).any(|k| {
        let [start, end] = [ours[k], ours[(k + 1) % outline]];
        let Some(way) = (end - start).try_normalize() else { return false };
        let left = |point: &DVec2| way.perp_dot(*point - start);
        theirs.iter().all(|point| left(point) <= width) && ours.iter().all(|point| left(point) >= -width)
    })
}
