//! Closed convex bodies among polygons, of which only the near side needs to be looked at.
//!
//! A ray that leaves a body through its far side has entered it through its near side: with dA outside, the far side hides
//! nothing more. Where two faces of the near side meet, their common edge is no part of the visible boundary, so that what
//! is left of the body is its silhouette.
use crate::{DifferentialArea, PlanarPolygon};
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Bodies: sets of polygons that close around a convex solid exactly, fronts outward.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bodies {
    /// Which body each polygon belongs to.
    of: Vec<Option<usize>>,
    faces: Vec<Vec<usize>>,
}

/// More faces than this are not taken for a body: to check takes the square of their number.
const MOST: usize = 256;

impl Bodies {
    /// Takes O(n log n) for n edges, and the square of the faces of each body.
    pub(crate) fn among(polygons: &[PlanarPolygon]) -> Self {
        let neighbours = neighbours(polygons);
        let mut bodies = Self { of: vec![None; polygons.len()], faces: Vec::new() };
        let mut is_known = vec![false; polygons.len()];
        for first in 0..polygons.len() {
            let faces = connected(first, &neighbours, &mut is_known);
            let is_closed = faces.iter().all(|face| neighbours[*face].is_some());
            if is_closed && (4..=MOST).contains(&faces.len()) && is_convex(polygons, &faces) {
                faces.iter().for_each(|face| bodies.of[*face] = Some(bodies.faces.len()));
                bodies.faces.push(faces);
            }
        }
        bodies
    }

    /// Whether polygon `id` turns its back to dA and belongs to a body around which dA is outside, and not on it.
    pub(crate) fn is_far_side(&self, polygons: &[PlanarPolygon], from: &DifferentialArea, id: usize) -> bool {
        let Some(body) = self.of[id] else { return false };
        let side = |face: usize| polygons[face].plane().side_of(from.position());
        from.owner().is_none_or(|owner| self.of[owner] != Some(body))
            && side(id) == Ordering::Less
            && self.faces[body].iter().any(|face| side(*face) == Ordering::Greater)
    }
}

/// The polygons across each polygon's edges, `None` where an edge has not exactly one partner that runs the other way.
fn neighbours(polygons: &[PlanarPolygon]) -> Vec<Option<Vec<usize>>> {
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

/// The polygons that edges connect with one, none of them known before.
fn connected(first: usize, neighbours: &[Option<Vec<usize>>], is_known: &mut [bool]) -> Vec<usize> {
    let (mut found, mut open) = (Vec::new(), vec![first]);
    while let Some(id) = open.pop() {
        if !std::mem::replace(&mut is_known[id], true) {
            found.push(id);
            open.extend(neighbours[id].iter().flatten());
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
