//! Convex shells: polygons, with convex holes or none, that are connected by edges which do not turn inward, and behind which nothing
//! of them is.
use crate::shapes::{holes::holes, polygon::PlanarPolygon};
use glam::DVec3;
use std::{cmp::Ordering, collections::BTreeMap};

/// Shells of more faces are not looked for: the check takes the square of their number.
const MOST: usize = 256;

/// The polygons across each polygon's edges, `None` where an edge has not exactly one partner that runs the other way.
#[derive(Debug)]
pub(crate) struct Adjacency(pub(super) Vec<Vec<Option<usize>>>);

impl Adjacency {
    pub(crate) fn of(polygons: &[PlanarPolygon]) -> Self {
        let bits = |p: DVec3| p.to_array().map(f64::to_bits);
        let mut owners: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        for (id, polygon) in polygons.iter().enumerate() {
            polygon.edges().for_each(|(a, b)| owners.entry([bits(a), bits(b)]).or_default().push(id));
        }
        let one = |a: DVec3, b: DVec3| match owners.get(&[bits(a), bits(b)]).map(Vec::as_slice) {
            Some([id]) => Some(*id),
            _ => None,
        };
        let across =
            |polygon: &PlanarPolygon| polygon.edges().map(|(a, b)| one(a, b).and(one(b, a))).collect();
        Self(polygons.iter().map(across).collect())
    }

    /// Whether polygons have only each other across their edges.
    pub(super) fn are_closed(&self, faces: &[usize]) -> bool {
        let is_own = |across: &Option<usize>| across.is_some_and(|other| faces.contains(&other));
        faces.iter().all(|face| self.0[*face].iter().all(is_own))
    }
}

/// The convex shells among polygons, by where `side` says a point is that may lie behind polygon `id`.
///
/// Takes O(n log n) for n edges, and the square of the faces of each shell.
pub(super) fn shells(
    polygons: &[PlanarPolygon],
    adjacency: &Adjacency,
    side: impl Fn(usize, DVec3) -> Ordering,
) -> Vec<Vec<usize>> {
    let is_behind = |id: usize, other: usize| polygons[other].points().iter().all(|p| side(id, *p).is_le());
    let is_convex = |faces: &[usize]| {
        faces.iter().all(|face| {
            holes(&polygons[*face]).is_some() && faces.iter().all(|other| is_behind(*face, *other))
        })
    };
    let mut is_known = vec![false; polygons.len()];
    let all = (0..polygons.len()).map(|first| connected(first, adjacency, &mut is_known, is_behind));
    all.filter(|faces| (2..=MOST).contains(&faces.len()) && is_convex(faces)).collect()
}

/// The polygons that are connected with one by edges that do not turn inward, if they are not known yet.
fn connected(
    first: usize,
    adjacency: &Adjacency,
    is_known: &mut [bool],
    is_behind: impl Fn(usize, usize) -> bool,
) -> Vec<usize> {
    let (mut found, mut open) = (Vec::new(), vec![first]);
    while let Some(id) = open.pop() {
        if !std::mem::replace(&mut is_known[id], true) {
            found.push(id);
            let across = adjacency.0[id].iter().flatten().copied();
            open.extend(across.filter(|other| is_behind(id, *other) && is_behind(*other, id)));
        }
    }
    found
}
