//! What one call is asked to do.

/// A closed chain of points, the first not repeated.
pub type Ring = Vec<[f64; 2]>;

/// An outer ring, counter-clockwise, and its holes, clockwise.
pub type Polygon = Vec<Ring>;

/// The Boolean that is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    /// Of all the polygons of the subject, without a clip.
    UnionOfAll,
    /// Subject ∩ clip.
    Intersection,
    /// Subject − clip.
    Difference,
    /// Subject ⊕ clip.
    SymmetricDifference,
}

impl Op {
    /// The name in the tables.
    pub fn name(self) -> &'static str {
        match self {
            Op::UnionOfAll => "union",
            Op::Intersection => "intersection",
            Op::Difference => "difference",
            Op::SymmetricDifference => "symmetric-difference",
        }
    }
}

/// Two sets of polygons, each read by the non-zero rule, and a Boolean.
#[derive(Clone, Debug)]
pub struct Job {
    /// The Boolean.
    pub op: Op,
    /// The first operand.
    pub subject: Vec<Polygon>,
    /// The second operand; empty for the union of all.
    pub clip: Vec<Polygon>,
    /// Whether the polygons of each operand keep their interiors apart: what peers with rules of validity ask for.
    pub disjoint: bool,
}

impl Job {
    /// How many edges go in.
    pub fn edges(&self) -> usize {
        self.subject.iter().chain(&self.clip).flatten().map(Vec::len).sum()
    }

    /// The largest absolute coordinate.
    pub fn extent(&self) -> f64 {
        let points = self.subject.iter().chain(&self.clip).flatten().flatten().flatten();
        points.fold(0.0, |extent: f64, c| extent.max(c.abs()))
    }
}
