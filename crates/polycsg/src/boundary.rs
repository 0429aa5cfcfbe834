//! The boundary of an evaluated expression, as a set of directed edges.

use crate::area::enclosed_area;
use crate::edges::Edges;
use crate::select::Selection;
use glam::DVec2;

/// A directed edge of a boundary, the interior to its left, and where it comes from.
///
/// It is a piece of one input edge, or all of it, and may run against it: what is subtracted bounds from outside. Of
/// input edges that coincide, one is named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryEdge {
    /// Where it starts: an input vertex, or a crossing rounded to nearest.
    pub start: DVec2,
    /// Where it ends.
    pub end: DVec2,
    /// Which operand it comes from, counted in the order of appearance in the [`Csg`](crate::Csg).
    pub operand: usize,
    /// Which of that operand's edges it lies on; edge i starts in point i of all the operand's rings in a row.
    pub edge: usize,
}

/// The boundary of a set: directed edges, interior to the left, in no particular order.
///
/// Every vertex is rounded once to the nearest double; what rounding may have made meet is not mended, no
/// rings are built. The edges form closed walks, so that sums over edges (areas, moments, contour integrals) are right.
#[derive(Clone, Copy, Debug)]
pub struct Boundary<'s> {
    selection: &'s Selection,
    edges: &'s Edges,
}

impl<'s> Boundary<'s> {
    pub(crate) fn new(selection: &'s Selection, edges: &'s Edges) -> Boundary<'s> {
        Boundary { selection, edges }
    }

    /// The edges; those that rounding shrank to a point are left out. The order is the same from run to run.
    pub fn edges(&self) -> impl Iterator<Item = BoundaryEdge> + Clone + use<'s> {
        let Boundary { selection, edges } = *self;
        selection
            .pieces()
            .iter()
            .map(move |piece| BoundaryEdge {
                start: selection.point(edges, piece.start),
                end: selection.point(edges, piece.end),
                operand: edges.ring(piece.edge).operand as usize,
                edge: edges.source(piece.edge) as usize,
            })
            .filter(|edge| edge.start != edge.end)
    }

    /// Whether the set is empty.
    pub fn is_empty(&self) -> bool {
        self.selection.pieces().is_empty()
    }

    /// The enclosed area; infinite when it exceeds the largest `f64`, 0 when it is below the smallest. O(n).
    pub fn area(&self) -> f64 {
        enclosed_area(std::iter::once(self.edges().map(|edge| [edge.start, edge.end])))
    }
}
