//! The boundary of an evaluated expression, as a set of directed edges.

pub(crate) mod outline;
pub(crate) mod repair;
pub(crate) mod select;

use crate::contacts::Contacts;
use crate::edges::{Edges, Origin};
use crate::region::area::enclosed_area;
use glam::DVec2;
use select::{Piece, Selection};

/// A directed edge of a boundary, with the interior to its left, and the input edge that it comes from.
///
/// It is part or all of one input edge, and may run against it, as the edges of a subtracted operand do. Where input edges
/// coincide, one of them is named.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BoundaryEdge {
    /// Where it starts: an input vertex, or a crossing rounded to nearest.
    pub start: DVec2,
    /// Where it ends.
    pub end: DVec2,
    /// The operand that it comes from, counted in the order of appearance in the [`Csg`](crate::Csg).
    pub operand: usize,
    /// The edge of that operand on which it lies. Edge i starts in point i, counted through all rings of the operand.
    pub edge: usize,
}

/// The boundary of a set: directed edges, interior to the left, in no particular order.
///
/// Every vertex is rounded once to the nearest double. Edges that rounding made meet are not repaired, and no rings are
/// built. The edges form closed walks, so that sums over edges (areas, moments, contour integrals) are right.
#[derive(Clone, Copy, Debug)]
#[must_use = "a boundary is read through its edges"]
pub struct Boundary<'s> {
    selection: &'s Selection,
    edges: &'s Edges,
    contacts: &'s Contacts,
}

impl<'s> Boundary<'s> {
    pub(crate) fn new(selection: &'s Selection, edges: &'s Edges, contacts: &'s Contacts) -> Boundary<'s> {
        Boundary { selection, edges, contacts }
    }

    /// The edges, without those that rounding shrank to a point. The order is the same from run to run.
    pub fn edges(&self) -> impl Iterator<Item = BoundaryEdge> + Clone + use<'s> {
        let boundary = *self;
        self.selection.pieces().iter().flat_map(move |&piece| boundary.edges_of(piece))
    }

    fn edges_of(self, piece: Piece) -> impl Iterator<Item = BoundaryEdge> + Clone + use<'s> {
        let Boundary { selection, edges, contacts } = self;
        let points = selection.points(edges, contacts, piece);
        let (mut ids, along) = (piece.edges(), piece.along);
        let next_id = move || if along { ids.next() } else { ids.next_back() };
        points
            .clone()
            .zip(points.skip(1))
            .zip(std::iter::from_fn(next_id))
            .filter(|((start, end), _)| start != end)
            .map(move |((start, end), id)| {
                let Origin { operand, edge } = edges.origin(id);
                BoundaryEdge { start, end, operand: operand as usize, edge: edge as usize }
            })
    }

    /// Whether the set is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.selection.pieces().is_empty()
    }

    /// The enclosed area; infinite when it exceeds the largest `f64`, 0 when it is below the smallest. O(n).
    #[must_use]
    pub fn area(&self) -> f64 {
        let walks = self.selection.pieces().iter().map(|&piece| {
            let points = self.selection.points(self.edges, self.contacts, piece);
            points.clone().zip(points.skip(1)).map(|(start, end)| [start, end])
        });
        enclosed_area(std::iter::once(walks.flatten()))
    }
}
