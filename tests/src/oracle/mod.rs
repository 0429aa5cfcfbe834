//! The source's own algorithm, written plainly over exact numbers.
//!
//! Each edge of each operand is cut by all edges (`cut`); each piece's midpoint is classified against each operand by
//! winding numbers just left and just right of it (`winding`); the classes are combined by the completed Table 3.1
//! (`table`); what is `OnPlus` or `OnMinus` at the root is the boundary (`outline`). No filter, no sweep, no
//! shortcut: O(n²) contacts, O(k n) classifications.
mod cut;
mod locate;
mod outline;
mod table;
mod winding;

pub use locate::{Place, locate};
pub use outline::{Outline, Piece, sort};
pub use table::Class;

use crate::Ring;
use crate::exact::{Exact, Grid, edges, nearest_quotient};
use cut::{Edge, Homogeneous};
use glam::DVec2;
use num_bigint::BigInt;
use num_rational::BigRational;

/// Which winding numbers mean inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rule {
    /// Odd numbers.
    EvenOdd,
    /// All but zero.
    NonZero,
    /// Numbers above zero.
    Positive,
}

impl Rule {
    /// All rules.
    pub const ALL: [Rule; 3] = [Rule::EvenOdd, Rule::NonZero, Rule::Positive];

    fn holds(self, winding: i32) -> bool {
        match self {
            Rule::EvenOdd => winding % 2 != 0,
            Rule::NonZero => winding != 0,
            Rule::Positive => winding > 0,
        }
    }
}

/// Rings and what they mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Operand {
    /// Closed chains, the first point not repeated.
    pub rings: Vec<Ring>,
    /// How their winding numbers are read.
    pub rule: Rule,
}

/// The binary operations that every suite tries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// In either.
    Union,
    /// In both.
    Intersection,
    /// In the first and not in the second.
    Difference,
    /// In exactly one.
    SymmetricDifference,
}

impl Operation {
    /// All operations, in the order of the corpus' columns.
    pub const ALL: [Operation; 4] =
        [Operation::Union, Operation::Intersection, Operation::Difference, Operation::SymmetricDifference];

    /// The operation on classes, by Table 3.1.
    pub fn of(self, a: Class, b: Class) -> Class {
        match self {
            Operation::Union => a.union(b),
            Operation::Intersection => a.intersection(b),
            Operation::Difference => a.difference(b),
            Operation::SymmetricDifference => a.symmetric_difference(b),
        }
    }
}

/// A piece of an input edge between neighbouring contacts, with its class against every operand.
#[derive(Clone, Debug)]
pub struct SubEdge {
    /// Operand that the edge belongs to.
    pub operand: usize,
    /// Number of the edge, counted through the operand's rings, degenerate edges included.
    pub edge: usize,
    /// Vertices at its start and end, in the edge's own direction.
    pub ends: [usize; 2],
    /// Equal for equal directions: along the piece, and against it.
    pub directions: [usize; 2],
    /// Class against each operand.
    pub classes: Vec<Class>,
    /// False when a coincident piece of an earlier edge stands for this one.
    pub representative: bool,
    /// Cross product of its ends: its share of twice a signed area.
    pub twice_area: BigRational,
}

/// A contact or an input point, exactly known; here as the double nearest to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Each coordinate rounded to nearest, ties to even.
    pub point: DVec2,
    /// True when some operand has this very point as a ring's vertex.
    pub is_input: bool,
}

/// All pieces of all edges of some operands, classified.
#[derive(Clone, Debug)]
pub struct Arrangement {
    /// Pieces by operand, then edge, then along the edge.
    pub sub_edges: Vec<SubEdge>,
    /// Distinct points, in lexicographic order.
    pub vertices: Vec<Vertex>,
    extent: f64,
}

impl Arrangement {
    /// Cuts and classifies every edge of every operand. Coordinates must be finite.
    pub fn of(operands: &[Operand]) -> Arrangement {
        let grid = Grid::of(operands.iter().flat_map(|o| o.rings.iter().flatten()));
        if grid.is_small() {
            arrange(operands, grid, |value| grid.small_steps(value))
        } else {
            arrange::<BigInt>(operands, grid, |value| grid.steps(value))
        }
    }

    /// The boundary of the set whose class is `combine` of the operands' classes.
    pub fn outline(&self, combine: impl Fn(&[Class]) -> Class) -> Outline<'_> {
        Outline::of(self, combine)
    }

    /// The boundary of a binary operation on operands 0 and 1.
    pub fn operation(&self, operation: Operation) -> Outline<'_> {
        self.outline(|classes| operation.of(classes[0], classes[1]))
    }

    /// The largest magnitude of a coordinate.
    pub fn extent(&self) -> f64 {
        self.extent
    }
}

fn arrange<T: Exact>(operands: &[Operand], grid: Grid, steps: impl Fn(f64) -> T) -> Arrangement {
    let edges = collect(operands, steps);
    let directions = cut::direction_classes(&edges);
    let (points, pieces) = cut::cut(&edges);
    let mut sub_edges = Vec::with_capacity(pieces.len());
    for piece in &pieces {
        let edge = &edges[piece.edge];
        let side = winding::around(&piece.middle, piece.edge, &edges, operands.len());
        let classes = operands.iter().zip(&side.windings);
        sub_edges.push(SubEdge {
            operand: edge.operand,
            edge: edge.number,
            ends: piece.ends,
            directions: directions[piece.edge],
            classes: classes.map(|(o, w)| Class::of(o.rule.holds(w[0]), o.rule.holds(w[1]))).collect(),
            representative: side.is_first,
            twice_area: grid.area(piece.twice_area.clone()),
        });
    }
    let vertices = points.iter().map(|p| round(p, &edges, grid)).collect();
    let extent = operands.iter().flat_map(|o| o.rings.iter().flatten());
    Arrangement { sub_edges, vertices, extent: extent.fold(0.0, |m, p| f64::max(m, p.abs().max_element())) }
}

/// Edges with a length, of rings with three or more of them: fewer bound nothing and are no input.
fn collect<T: Exact>(operands: &[Operand], steps: impl Fn(f64) -> T) -> Vec<Edge<T>> {
    let mut collected = Vec::new();
    for (operand, Operand { rings, .. }) in operands.iter().enumerate() {
        let mut first = 0;
        for ring in rings {
            let long: Vec<_> = edges(ring).enumerate().filter(|(_, (a, b))| a != b).collect();
            let long = if long.len() < 3 { &[] } else { &long[..] };
            for (number, (a, b)) in long {
                let (start, end) = ([steps(a.x), steps(a.y)], [steps(b.x), steps(b.y)]);
                collected.push(Edge::new(operand, first + number, start, end));
            }
            first += ring.len();
        }
    }
    collected
}

fn round<T: Exact>(point: &Homogeneous<T>, edges: &[Edge<T>], grid: Grid) -> Vertex {
    let coordinate =
        |steps: &T| nearest_quotient(&steps.clone().into(), &point.w.clone().into(), grid.exponent);
    let is_input = edges.iter().any(|e| point.is(&e.start));
    Vertex { point: DVec2::new(coordinate(&point.x), coordinate(&point.y)), is_input }
}
