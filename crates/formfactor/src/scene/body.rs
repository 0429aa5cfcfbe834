//! Closed convex bodies among the polygons, and such as lack a few faces. Of such a body only the near side can occlude, and of the target's own body nothing.
//!
//! With dA outside of a body, every ray that leaves it through its far side has entered it through its near side: the far side
//! hides nothing more. The common edge of two faces of the near side is no part of the visible boundary, so that the body's
//! silhouette remains.
use super::cap::{Cap, lids};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use glam::DVec3;
use std::{cmp::Ordering, collections::BTreeMap};

/// Bodies: sets of polygons that close around a convex solid exactly, fronts outward.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bodies {
    /// Which body each polygon belongs to.
    of: Vec<Option<usize>>,
    faces: Vec<Vec<usize>>,
    /// Those that a few more faces would close.
    caps: Vec<Cap>,
}

/// Bodies of more faces are not looked for: the check takes the square of their number.
const MOST: usize = 256;

impl Bodies {
    /// Takes O(n log n) for n edges, and the square of the faces of each body.
    pub(crate) fn among(polygons: &[PlanarPolygon]) -> Self {
        let neighbours = neighbours(polygons);
        let mut bodies = Self { of: vec![None; polygons.len()], ..Self::default() };
        let mut is_known = vec![false; polygons.len()];
        for first in 0..polygons.len() {
            let faces = connected(first, polygons, &neighbours, &mut is_known);
            if !(2..=MOST).contains(&faces.len()) || !is_convex(polygons, &faces) {
                continue;
            }
            let is_own = |across: &Option<usize>| across.is_some_and(|other| faces.contains(&other));
            if faces.iter().all(|face| neighbours[*face].iter().all(is_own)) {
                faces.iter().for_each(|face| bodies.of[*face] = Some(bodies.faces.len()));
                bodies.faces.push(faces);
            } else if let Some(lids) = lids(polygons, &faces, &neighbours) {
                bodies.caps.push(Cap { faces, lids });
            }
        }
        bodies
    }

    pub(crate) fn count(&self) -> usize {
        self.faces.len()
    }

    /// The polygons of a body.
    pub(crate) fn faces(&self, body: usize) -> &[usize] {
        &self.faces[body]
    }

    pub(crate) fn caps(&self) -> &[Cap] {
        &self.caps
    }

    /// Whether two polygons belong to one body. Then neither hides any of the other's front: the body lies behind it.
    pub(crate) fn is_one(&self, id: usize, other: usize) -> bool {
        self.of[id].is_some() && self.of[id] == self.of[other]
    }

    /// Whether polygon `id` turns its back to dA and belongs to a body of which dA is outside, and not on it. `last` keeps the
    /// answer for the last body, as the faces of a body mostly come in a row.
    pub(crate) fn is_far_side(
        &self,
        polygons: &[PlanarPolygon],
        from: &DifferentialArea,
        id: usize,
        last: &mut Option<Outside>,
    ) -> bool {
        let Some(body) = self.of[id] else { return false };
        if polygons[id].plane().side_of(from.position()) != Ordering::Less {
            return false;
        }
        let known = last.filter(|last| last.body == body);
        let found =
            known.unwrap_or_else(|| Outside { body, is_outside: self.is_outside(polygons, from, body) });
        *last = Some(found);
        found.is_outside
    }

    /// Whether dA is in front of a face, for certain. Where rounding matters the answer is no: the face may lie in the plane of
    /// dA's owner, and then it hides nothing.
    fn is_outside(&self, polygons: &[PlanarPolygon], from: &DifferentialArea, body: usize) -> bool {
        if from.owner().is_some_and(|owner| self.of[owner] == Some(body)) {
            return false;
        }
        let planes = self.faces[body].iter().map(|face| polygons[*face].plane());
        let mut near = planes.filter(|plane| plane.side_of(from.position()) == Ordering::Greater).peekable();
        near.peek().is_some() && near.all(|plane| plane.quick_side(from.position()).is_some())
    }
}

/// Whether dA is outside of a body, so that its far side hides nothing more than its near side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outside {
    body: usize,
    is_outside: bool,
}

/// The polygons across each polygon's edges, `None` where an edge has not exactly one partner that runs the other way.
fn neighbours(polygons: &[PlanarPolygon]) -> Vec<Vec<Option<usize>>> {
    let bits = |p: DVec3| p.to_array().map(f64::to_bits);
    let mut owners: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for (id, polygon) in polygons.iter().enumerate() {
        polygon.edges().for_each(|(a, b)| owners.entry([bits(a), bits(b)]).or_default().push(id));
    }
    let one = |a: DVec3, b: DVec3| match owners.get(&[bits(a), bits(b)]).map(Vec::as_slice) {
        Some([id]) => Some(*id),
        _ => None,
    };
    let across = |polygon: &PlanarPolygon| polygon.edges().map(|(a, b)| one(a, b).and(one(b, a))).collect();
    polygons.iter().map(across).collect()
}

/// The polygons that are connected with one by edges that do not turn inward, if they are not known yet.
fn connected(
    first: usize,
    polygons: &[PlanarPolygon],
    neighbours: &[Vec<Option<usize>>],
    is_known: &mut [bool],
) -> Vec<usize> {
    let is_behind = |id: usize, other: usize| {
        polygons[other].points().iter().all(|p| polygons[id].plane().side_of(*p).is_le())
    };
    let (mut found, mut open) = (Vec::new(), vec![first]);
    while let Some(id) = open.pop() {
        if !std::mem::replace(&mut is_known[id], true) {
            found.push(id);
            let across = neighbours[id].iter().flatten().copied();
            open.extend(across.filter(|other| is_behind(id, *other) && is_behind(*other, id)));
        }
    }
    found
}

/// Whether all faces are convex and exactly planar, and no vertex is before a face.
fn is_convex(polygons: &[PlanarPolygon], faces: &[usize]) -> bool {
    let points = || faces.iter().flat_map(|face| polygons[*face].points());
    faces.iter().map(|face| &polygons[*face]).all(|face| {
        face.is_convex()
            && face.deviation() == 0.0
            && points().all(|p| face.plane().side_of(*p) != Ordering::Greater)
    })
}
