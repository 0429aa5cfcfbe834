//! boundary
use glam::DVec2;
/// A directed piece of the result's boundary, interior to the left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryEdge { /// start
 pub start: DVec2, /// end
 pub end: DVec2, /// leaf of the Csg, in order of appearance
 pub operand: usize, /// edge of that operand, counted through its rings
 pub edge: usize }
/// stub
#[derive(Debug)]
pub struct Boundary<'s> { edges: &'s [BoundaryEdge] }
impl<'s> Boundary<'s> {
    /// edges
    pub fn edges(&self) -> &'s [BoundaryEdge] { self.edges }
    /// none
    pub fn is_empty(&self) -> bool { self.edges.is_empty() }
    /// area
    pub fn area(&self) -> f64 { unimplemented!() }
}
