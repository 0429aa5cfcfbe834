//! Closed convex bodies among the polygons. Of such a body only the near side can occlude, and of the target's own body nothing.
//!
//! With dA outside of a body, every ray that leaves it through its far side has entered it through its near side: the far side
//! hides nothing more. The common edge of two faces of the near side is no part of the visible boundary, so that the body's
//! silhouette remains.
use super::shell::{Adjacency, shells};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use std::cmp::Ordering;

/// Bodies: sets of polygons that close around a convex solid exactly, fronts outward.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bodies {
    /// Which body each polygon belongs to.
    of: Vec<Option<usize>>,
    faces: Vec<Vec<usize>>,
}

impl Bodies {
    /// Takes O(n log n) for n edges, and the square of the faces of each body.
    pub(crate) fn among(polygons: &[PlanarPolygon], adjacency: &Adjacency) -> Self {
        let mut bodies = Self { of: vec![None; polygons.len()], faces: Vec::new() };
        for faces in shells(polygons, adjacency, |id, point| polygons[id].plane().side_of(point)) {
            let is_exact = |face: &PlanarPolygon| face.is_convex() && face.deviation() == 0.0;
            if faces.iter().all(|face| is_exact(&polygons[*face])) && adjacency.are_closed(&faces) {
                faces.iter().for_each(|face| bodies.of[*face] = Some(bodies.faces.len()));
                bodies.faces.push(faces);
            }
        }
        bodies
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
