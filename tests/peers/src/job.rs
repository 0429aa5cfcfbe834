//! What one call is asked to do.

/// A closed chain of points, the first not repeated.
pub type Ring = Vec<[f64; 2]>;

/// An outer ring, counter-clockwise, and its holes, clockwise.
pub type Polygon = Vec<Ring>;

/// One side of a Boolean: polygons read by the non-zero rule.
pub type Operand = Vec<Polygon>;

/// The Boolean that is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    /// Of all the polygons of the subject, without a clip.
    UnionOfAll,
    /// Subject ∪ clip.
    Union,
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
            Op::UnionOfAll | Op::Union => "union",
            Op::Intersection => "intersection",
            Op::Difference => "difference",
            Op::SymmetricDifference => "symmetric-difference",
        }
    }
}

/// How the polygons of one operand lie: what peers with rules of validity ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parts {
    /// In any way.
    Overlapping,
    /// With their interiors apart.
    Apart,
    /// Apart, and neighbours share their borders vertex by vertex.
    Coverage,
}

/// Booleans of one kind, each with its own result.
#[derive(Clone, Debug)]
pub struct Job {
    /// The Boolean.
    pub op: Op,
    /// The first operand of each Boolean.
    pub subjects: Vec<Operand>,
    /// The second operand of each Boolean, or one for all of them; empty for the union of all.
    pub clips: Vec<Operand>,
    /// How the polygons of each operand lie.
    pub parts: Parts,
}

impl Job {
    /// A single Boolean.
    pub fn one(op: Op, subject: Operand, clip: Operand, parts: Parts) -> Job {
        Job { op, subjects: vec![subject], clips: vec![clip], parts }
    }

    /// The union of one operand's polygons.
    pub fn union_of_all(subject: Operand, parts: Parts) -> Job {
        Job::one(Op::UnionOfAll, subject, vec![], parts)
    }

    /// Whether one operand's polygons are united.
    pub fn is_dissolve(&self) -> bool {
        self.op == Op::UnionOfAll
    }

    /// Whether those share their borders vertex by vertex.
    pub fn is_coverage(&self) -> bool {
        self.is_dissolve() && self.parts == Parts::Coverage
    }

    /// Whether one clip serves many subjects.
    pub fn has_common_clip(&self) -> bool {
        self.clips.len() < self.subjects.len()
    }

    /// How many edges go into one Boolean, on average.
    pub fn edges(&self) -> usize {
        let edges = |operands: &[Operand]| {
            operands.iter().flatten().flatten().map(Vec::len).sum::<usize>() / operands.len()
        };
        edges(&self.subjects) + edges(&self.clips)
    }

    /// The largest absolute coordinate.
    pub fn extent(&self) -> f64 {
        let points = self.subjects.iter().chain(&self.clips).flatten().flatten().flatten().flatten();
        points.fold(0.0, |extent: f64, c| extent.max(c.abs()))
    }
}

/// The area that a ring encloses, positive when it turns counter-clockwise.
pub fn signed_area(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| (b[0] - a[0]) * (a[1] + b[1]) / -2.0).sum()
}

/// Each subject with its clip.
pub fn pairs<'a, T>(subjects: &'a [T], clips: &'a [T]) -> impl Iterator<Item = (&'a T, &'a T)> {
    subjects.iter().zip(clips.iter().cycle())
}
