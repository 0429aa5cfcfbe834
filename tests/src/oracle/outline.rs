//! The boundary of a set: what is ON at the root.
use super::{Arrangement, Class, SubEdge, Vertex};
use crate::exact::ratio;
use glam::DVec2;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

/// A directed piece of the boundary, interior to the left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Start and end among the arrangement's vertices.
    pub ends: [usize; 2],
    /// Equal for equal directions.
    pub direction: usize,
}

/// All boundary pieces of a set.
#[derive(Clone, Debug)]
pub struct Outline<'a> {
    /// What was cut.
    pub arrangement: &'a Arrangement,
    /// One piece for each stretch of boundary between contacts, however many edges coincide there.
    pub pieces: Vec<Piece>,
    /// Twice the exact area inside.
    pub twice_area: BigRational,
}

impl<'a> Outline<'a> {
    pub(super) fn of(arrangement: &'a Arrangement, combine: impl Fn(&[Class]) -> Class) -> Outline<'a> {
        let mut outline = Outline { arrangement, pieces: Vec::new(), twice_area: BigRational::zero() };
        for sub_edge in arrangement.sub_edges.iter().filter(|s| s.representative) {
            match combine(&sub_edge.classes) {
                Class::OnPlus => outline.push(sub_edge, false),
                Class::OnMinus => outline.push(sub_edge, true),
                Class::In | Class::Out => {}
            }
        }
        outline
    }

    fn push(&mut self, sub_edge: &SubEdge, is_reversed: bool) {
        let ([a, b], [along, against]) = (sub_edge.ends, sub_edge.directions);
        if is_reversed {
            self.twice_area -= &sub_edge.twice_area;
            self.pieces.push(Piece { ends: [b, a], direction: against });
        } else {
            self.twice_area += &sub_edge.twice_area;
            self.pieces.push(Piece { ends: [a, b], direction: along });
        }
    }

    /// The exact area.
    pub fn area(&self) -> BigRational {
        &self.twice_area / BigInt::from(2)
    }

    /// The pieces with straight-through crossings dropped and each end rounded once, in lexicographic order.
    ///
    /// A vertex is dropped when it is no input vertex and the boundary passes it once, straight on.
    pub fn merged(&self) -> Vec<[DVec2; 2]> {
        let is_passed = self.passed();
        let starts = self.starts();
        let point = |vertex: usize| self.vertex(vertex).point;
        let mut merged = Vec::new();
        for piece in self.pieces.iter().filter(|p| !is_passed[p.ends[0]]) {
            let mut end = piece.ends[1];
            while is_passed[end] {
                end = self.pieces[starts[end][0]].ends[1];
            }
            merged.push([point(piece.ends[0]), point(end)]);
        }
        sort(&mut merged);
        merged
    }

    /// For each vertex, whether the boundary goes straight through a crossing there.
    fn passed(&self) -> Vec<bool> {
        let starts = self.starts();
        let mut ends = vec![Vec::new(); self.arrangement.vertices.len()];
        for (index, piece) in self.pieces.iter().enumerate() {
            ends[piece.ends[1]].push(index);
        }
        let passed = |vertex: usize| match (ends[vertex].as_slice(), starts[vertex].as_slice()) {
            (&[a], &[b]) => {
                !self.vertex(vertex).is_input && self.pieces[a].direction == self.pieces[b].direction
            }
            _ => false,
        };
        (0..ends.len()).map(passed).collect()
    }

    /// For each vertex, the pieces that start there.
    pub fn starts(&self) -> Vec<Vec<usize>> {
        let mut starts = vec![Vec::new(); self.arrangement.vertices.len()];
        for (index, piece) in self.pieces.iter().enumerate() {
            starts[piece.ends[0]].push(index);
        }
        starts
    }

    /// A vertex of the arrangement.
    pub fn vertex(&self, index: usize) -> Vertex {
        self.arrangement.vertices[index]
    }

    /// How far the area may move when every vertex of the boundary moves by an ulp in each coordinate.
    ///
    /// Sweeping an edge of extent (dx, dy) by (u, u) covers at most (|dx| + |dy| + 2u) u. Rounding once moves a vertex
    /// by half an ulp; each round of repair can move the pieces of the rounded edges by as much again, so that this
    /// covers two roundings.
    pub fn area_of_one_ulp(&self) -> BigRational {
        let mut sum = BigRational::zero();
        for [p, q] in self.merged() {
            let top = p.abs().max_element().max(q.abs().max_element());
            let ulp = ratio(ulp(top));
            let [dx, dy] = [(p.x, q.x), (p.y, q.y)].map(|(a, b)| ratio(a.max(b)) - ratio(a.min(b)));
            sum += (dx + dy + &ulp * BigInt::from(2)) * ulp;
        }
        sum
    }
}

/// The distance to the next double away from zero, without overflow.
fn ulp(magnitude: f64) -> f64 {
    let below = magnitude.min(f64::MAX.next_down());
    below.next_up() - below
}

/// Sorts segments lexicographically by their ends.
pub fn sort(segments: &mut [[DVec2; 2]]) {
    let key = |s: &[DVec2; 2]| [s[0].x, s[0].y, s[1].x, s[1].y];
    segments.sort_by(|a, b| key(a).partial_cmp(&key(b)).expect("coordinates are finite"));
}
