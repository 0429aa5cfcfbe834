//! Vertices that nearly meet become one: cracks that rounding opened are closed.
use crate::coplanar::SINGLE;
use crate::extent::{BoxTree, Extent};
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::Patch,
};
use formfactor::PlanarPolygon;
use glam::DVec3;
use std::collections::BTreeMap;

/// A place as a key of a map; −0.0 reads as 0.0.
pub(crate) type PointKey = [u64; 3];

/// For each place from which a vertex is moved, where to.
#[derive(Debug)]
pub(crate) struct Welds(BTreeMap<PointKey, Weld>);

/// Where a vertex is moved to.
#[derive(Clone, Copy, Debug)]
struct Weld {
    place: DVec3,
    /// Whether it is further than the file's rounding of both places.
    is_told: bool,
}

impl Welds {
    /// Each vertex goes to one that is nearer than a rounding of the smallest patch there: that to which the others around it have the
    /// shortest ways in all, so that few move, and of equal ones the first of the scene. What is moved to does not move, so nothing goes
    /// further. O(n log n) for n vertices that are spread out.
    pub(crate) fn of(scene: &Scene) -> Welds {
        let corners = corners(scene);
        let boxes =
            BoxTree::new(corners.iter().map(|corner| Extent { low: corner.place, high: corner.place }));
        let near: Vec<Vec<(f64, usize)>> =
            corners.iter().map(|corner| corner.near(&corners, &boxes)).collect();
        let way = |(distance, other): &(f64, usize)| distance * corners[*other].vertices;
        let ways = |index: &usize| near[*index].iter().map(way).sum::<f64>();
        let mut order: Vec<usize> = (0..corners.len()).collect();
        order.sort_by(|a, b| ways(a).total_cmp(&ways(b)));
        let mut stays = vec![false; corners.len()];
        let mut moves = BTreeMap::new();
        for index in order {
            let target = near[index].iter().map(|(_, other)| *other).find(|other| stays[*other]);
            stays[index] = target.is_none();
            moves.extend(target.map(|target| corners[index].weld(&corners[target])));
        }
        Welds(moves)
    }

    /// Where a vertex of the scene goes.
    pub(crate) fn place(&self, vertex: DVec3) -> DVec3 {
        self.0.get(&key(vertex)).map_or(vertex, |weld| weld.place)
    }
}

/// A place at which vertices stand.
#[derive(Debug)]
struct WeldedCorner {
    place: DVec3,
    /// How far they may be moved.
    reach: f64,
    /// How far the file's numbers leave them from their places.
    rounding: f64,
    /// How many there are.
    vertices: f64,
}

impl WeldedCorner {
    /// It becomes one with another corner.
    fn weld(&self, target: &WeldedCorner) -> (PointKey, Weld) {
        let is_told = self.place.distance(target.place) > self.rounding + target.rounding;
        (key(self.place), Weld { place: target.place, is_told })
    }

    /// The other corners that may become one with it, nearest first, each behind its distance.
    fn near(&self, corners: &[WeldedCorner], boxes: &BoxTree) -> Vec<(f64, usize)> {
        let around =
            boxes.meeting(&Extent { low: self.place, high: self.place }.grown(self.reach)).into_iter();
        let ways = around.map(|other| (corners[other].place.distance(self.place), other));
        let is_near = |way: &(f64, usize)| way.0 > 0.0 && way.0 <= self.reach.min(corners[way.1].reach);
        let mut near: Vec<(f64, usize)> = ways.filter(is_near).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near
    }
}

/// The places at which vertices stand, in the order of the scene.
fn corners(scene: &Scene) -> Vec<WeldedCorner> {
    let mut known: BTreeMap<PointKey, usize> = BTreeMap::new();
    let mut corners: Vec<WeldedCorner> = Vec::new();
    for patch in &scene.patches {
        let (reach, rounding) = (SINGLE * Extent::of(patch).diagonal(), patch.slack());
        for &place in patch.polygon.loops().flatten() {
            let index = *known.entry(key(place)).or_insert(corners.len());
            match corners.get_mut(index) {
                Some(corner) => {
                    (corner.reach, corner.rounding) =
                        (corner.reach.min(reach), corner.rounding.max(rounding));
                    corner.vertices += 1.0;
                }
                None => corners.push(WeldedCorner { place, reach, rounding, vertices: 1.0 }),
            }
        }
    }
    corners
}

/// The key of a place.
pub(crate) fn key(place: DVec3) -> PointKey {
    place.to_array().map(|coordinate| (coordinate + 0.0).to_bits())
}

/// Moves the vertices; a polygon that would no longer be planar stays as it is. Tells which were further apart than rounding of the
/// file's numbers; returns whether any was moved.
pub(super) fn weld(scene: &mut Scene, findings: &mut Vec<Finding>) -> bool {
    let welds = Welds::of(scene);
    let mut is_moved = false;
    for patch in &mut scene.patches {
        let Some(polygon) = welded(patch, &welds) else { continue };
        findings.extend(finding(patch, &welds));
        patch.polygon = polygon;
        is_moved = true;
    }
    is_moved
}

/// The polygon with its vertices moved, if any of them is to.
fn welded(patch: &Patch, welds: &Welds) -> Option<PlanarPolygon> {
    let points = || patch.polygon.loops().flatten();
    if points().all(|point| welds.place(*point) == *point) {
        return None;
    }
    let ring = |points: &[DVec3]| {
        let mut ring: Vec<DVec3> = points.iter().map(|point| welds.place(*point)).collect();
        ring.dedup();
        if ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        ring
    };
    let polygon = PlanarPolygon::new(patch.polygon.loops().map(ring)).ok()?;
    (polygon.normal().dot(patch.polygon.normal()) > 0.0).then_some(polygon)
}

/// Of vertices that were moved further than rounding of the file's numbers moves them.
fn finding(patch: &Patch, welds: &Welds) -> Option<Finding> {
    let way = |vertex: &DVec3| {
        let weld = welds.0.get(&key(*vertex)).filter(|weld| weld.is_told)?;
        Some(vertex.distance(weld.place))
    };
    let moved = patch.polygon.loops().flatten().filter_map(way).reduce(f64::max)?;
    Some(Finding {
        kind: Kind::Crack,
        patches: vec![patch.name.clone()],
        what: format!("its vertices lie up to {moved:.1e} beside those of its neighbours"),
        repair: "give neighbours the same vertices; or let reading or inspect --repair do it".into(),
        places: Vec::new(),
    })
}
