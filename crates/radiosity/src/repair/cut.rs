//! Faces of one plane cut out of each other.
use super::{findings, necks::without_necks};
use crate::coplanar::{Overlap, SINGLE, overlaps, perimeter};
use crate::extent::Extent;
use crate::mesh::subdivide::can_be_divided;
use crate::plane::{Plane, slack};
use crate::scene::{Scene, finding::Finding, patch::Patch};
use formfactor::PlanarPolygon;
use glam::DVec3;
use polycsg::{Csg, Region};
use std::collections::{BTreeMap, HashSet};

/// A corner lies on a plane when it is nearer than this share of what a polygon's vertices may lie off theirs: the other half is for the
/// polygon's own.
const ON_PLANE: f64 = 0.5;

/// Cuts the patches that overlap out of each other; tells what overlapped. Pieces may overlap still where planes are one in pairs and not
/// all together.
pub(super) fn cut(scene: &mut Scene) -> Vec<Finding> {
    let found = overlaps(scene, SINGLE);
    let findings = found.iter().map(|overlap| findings::overlap(scene, overlap)).collect();
    if !found.is_empty() {
        cut_once(scene, &found);
    }
    findings
}

/// Leaves out the lower of each two patches that overlap.
pub(super) fn leave_out_covered(scene: &mut Scene) {
    let found = overlaps(scene, SINGLE);
    let lower: HashSet<usize> = found.iter().map(|overlap| ranked(scene, overlap)[1]).collect();
    let mut indices = 0..;
    scene.patches.retain(|_| indices.next().is_some_and(|index| !lower.contains(&index)));
}

fn cut_once(scene: &mut Scene, overlaps: &[Overlap]) {
    let mut covers: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for overlap in overlaps {
        let [upper, lower] = ranked(scene, overlap);
        covers.entry(lower).or_default().push(upper);
    }
    let mut taken: HashSet<String> = scene.patches.iter().map(|patch| patch.name.clone()).collect();
    let mut patches = Vec::with_capacity(scene.patches.len());
    for (index, patch) in scene.patches.iter().enumerate() {
        match covers.get(&index) {
            None => patches.push(patch.clone()),
            Some(upper) => patches.extend(named(patch, rest(scene, index, upper), &mut taken)),
        }
    }
    scene.patches = patches;
}

/// The patch that stays whole, and the one that it is cut out of.
fn ranked(scene: &Scene, overlap: &Overlap) -> [usize; 2] {
    let mut pair = overlap.patches;
    pair.sort_by_key(|index| rank(scene, *index));
    pair
}

/// Emitters first, then small before large, then in the order of the file.
fn rank(scene: &Scene, index: usize) -> (bool, u64, usize) {
    let patch = &scene.patches[index];
    // The bits of positive numbers are in the order of the numbers.
    (!patch.emits(), patch.polygon.area().to_bits(), index)
}

/// What the patches above leave of a patch.
fn rest(scene: &Scene, index: usize, upper: &[usize]) -> Vec<PlanarPolygon> {
    let polygon = &scene.patches[index].polygon;
    let plane = Plane::of(polygon);
    let above: Vec<&PlanarPolygon> = upper.iter().map(|&index| &scene.patches[index].polygon).collect();
    let regions: Vec<Region> = above.iter().map(|polygon| plane.region(polygon)).collect();
    let rest = (Csg::from(&plane.region(polygon)) - Csg::union(&regions)).evaluate();
    // What lies on the plane is a corner of both, so that no crack opens between them.
    let corners = above.iter().flat_map(|polygon| polygon.loops().flatten());
    let shared = corners.filter(|corner| plane.height(**corner).abs() <= ON_PLANE * slack(&[**corner]));
    pieces(&scene.patches[index], &rest, shared.copied())
}

/// What is left of a patch, without what is thinner than rounding. Corners at a `shared` point, or at one of the patch's, get its place.
pub(super) fn pieces(
    patch: &Patch,
    rest: &Region,
    shared: impl Iterator<Item = DVec3>,
) -> Vec<PlanarPolygon> {
    let width = strip(patch);
    let corners = patch.polygon.loops().flatten().copied();
    let mut pieces =
        Plane::of(&patch.polygon).lift(&without_necks(rest, width, patch.slack()), shared.chain(corners));
    pieces.retain(|piece| piece.area() > width * perimeter(piece) && can_be_divided(piece));
    pieces
}

/// How wide a strip along an edge of a patch is rounding.
pub(super) fn strip(patch: &Patch) -> f64 {
    patch.rounding + SINGLE * Extent::of(patch).diagonal()
}

/// The pieces under their names: the patch's own for a single one.
pub(super) fn named(patch: &Patch, polygons: Vec<PlanarPolygon>, taken: &mut HashSet<String>) -> Vec<Patch> {
    let single = polygons.len() == 1;
    let piece = |(polygon, number): (PlanarPolygon, usize)| {
        let mut name = if single { patch.name.clone() } else { format!("{}.{number}", patch.name) };
        while !single && !taken.insert(name.clone()) {
            name.push('\'');
        }
        Patch { name, polygon, ..patch.clone() }
    };
    polygons.into_iter().zip(1..).map(piece).collect()
}
