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

/// For each place at which a vertex stands, the place to which it is moved.
#[derive(Debug)]
pub(crate) struct Welds(BTreeMap<PointKey, DVec3>);

impl Welds {
    /// Each vertex goes to the first one of the scene that is nearer than a rounding of the smallest patch there. What is moved to does
    /// not move, so nothing goes further. O(n log n).
    pub(crate) fn of(scene: &Scene) -> Welds {
        let places = places(scene);
        let boxes = BoxTree::new(places.iter().map(|(place, _)| Extent { low: *place, high: *place }));
        let mut target: Vec<usize> = (0..places.len()).collect();
        for (index, (place, reach)) in places.iter().enumerate() {
            let around = boxes.meeting(&Extent { low: *place, high: *place }.grown(*reach)).into_iter();
            let fixed = around.take_while(|other| *other < index).filter(|other| target[*other] == *other);
            let near = fixed.filter(|other| places[*other].0.distance(*place) <= reach.min(places[*other].1));
            target[index] = near.min_by(|a, b| distance(&places, index, *a, *b)).unwrap_or(index);
        }
        let moves = target.iter().enumerate().map(|(index, &to)| (key(places[index].0), places[to].0));
        Welds(moves.collect())
    }

    /// Where a vertex of the scene goes.
    pub(crate) fn place(&self, vertex: DVec3) -> DVec3 {
        self.0.get(&key(vertex)).copied().unwrap_or(vertex)
    }
}

/// Which of two places is nearer.
fn distance(places: &[(DVec3, f64)], from: usize, a: usize, b: usize) -> std::cmp::Ordering {
    let to = |other: usize| places[other].0.distance_squared(places[from].0);
    to(a).total_cmp(&to(b))
}

/// The places at which vertices stand, in the order of the scene, each with how far it may be moved.
fn places(scene: &Scene) -> Vec<(DVec3, f64)> {
    let mut known: BTreeMap<PointKey, usize> = BTreeMap::new();
    let mut places: Vec<(DVec3, f64)> = Vec::new();
    for patch in &scene.patches {
        let reach = SINGLE * Extent::of(patch).diagonal();
        for point in patch.polygon.loops().flatten() {
            let index = *known.entry(key(*point)).or_insert(places.len());
            match places.get_mut(index) {
                Some((_, least)) => *least = least.min(reach),
                None => places.push((*point, reach)),
            }
        }
    }
    places
}

/// The key of a place.
pub(crate) fn key(place: DVec3) -> PointKey {
    place.to_array().map(|coordinate| (coordinate + 0.0).to_bits())
}

/// Moves the vertices; a polygon that would no longer be planar stays as it is.
pub(super) fn weld(scene: &mut Scene) -> Vec<Finding> {
    let welds = Welds::of(scene);
    let mut findings = Vec::new();
    for patch in &mut scene.patches {
        let Some(polygon) = welded(patch, &welds) else { continue };
        findings.push(finding(patch, &polygon));
        patch.polygon = polygon;
    }
    findings
}

/// The polygon with its vertices moved, if any of them is to.
fn welded(patch: &Patch, welds: &Welds) -> Option<PlanarPolygon> {
    let points = || patch.polygon.loops().flatten();
    if points().all(|point| welds.place(*point) == *point) {
        return None;
    }
    let ring = |points: &[DVec3]| points.iter().map(|point| welds.place(*point)).collect::<Vec<_>>();
    let polygon = PlanarPolygon::new(patch.polygon.loops().map(ring)).ok()?;
    (polygon.normal().dot(patch.polygon.normal()) > 0.0).then_some(polygon)
}

fn finding(patch: &Patch, polygon: &PlanarPolygon) -> Finding {
    let pairs = patch.polygon.loops().flatten().zip(polygon.loops().flatten());
    let moved = pairs.map(|(before, after)| before.distance(*after)).fold(0.0, f64::max);
    Finding {
        kind: Kind::Crack,
        patches: vec![patch.name.clone()],
        what: format!("its vertices lie up to {moved:.1e} beside those of its neighbours"),
        repair: "give neighbours the same vertices; or let reading or inspect --repair do it".into(),
        places: Vec::new(),
    }
}
