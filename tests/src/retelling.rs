//! One question told in other words: operands and rings in another order, rings from another point and, where the rule does
//! not read it, in the other direction. The answer has the same bits.
use crate::Ring;
use crate::against::leaf;
use crate::exact::{edges, twice_signed_area};
use crate::oracle::{Operand, Rule};
use crate::trees::Tree;
use glam::DVec2;
use num_traits::Zero;
use polycsg::Scratch;

/// An expression of some operands.
#[derive(Clone, Debug)]
pub struct Telling {
    /// What combines them, by number.
    pub tree: Tree,
    /// The operands, all of which enter as raw rings.
    pub operands: Vec<Operand>,
}

/// The bits of two points.
type Ends = [[u64; 2]; 2];

/// What an expression evaluates to.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The region's rings, with the depths of their polygons.
    rings: Vec<(usize, Vec<[u64; 2]>)>,
    /// The boundary's edges in order, with the operand and the input edge that they come from.
    edges: Vec<(Ends, usize, [DVec2; 2])>,
}

fn bits(p: DVec2) -> [u64; 2] {
    p.to_array().map(f64::to_bits)
}

impl Telling {
    /// The same in other words; `choose(n)` decides by a number below n.
    pub fn retold(&self, choose: &mut impl FnMut(usize) -> usize) -> Telling {
        let operands = self.operands.iter().map(|operand| retold(operand, choose)).collect();
        Telling { tree: self.tree.retold(choose), operands }
    }

    /// The region, and the boundary with what it comes from.
    pub fn answer(&self) -> Answer {
        let csg = self.tree.of(&|operand| leaf(&self.operands[operand]));
        let mut scratch = Scratch::default();
        let region = csg.evaluate_with(&mut scratch);
        let rings = region.polygons().flat_map(|polygon| {
            let rings = std::iter::once(polygon.outer()).chain(polygon.holes());
            let ring = |ring: &[DVec2]| (polygon.depth(), ring.iter().copied().map(bits).collect());
            rings.map(ring).collect::<Vec<_>>()
        });
        let rings = rings.collect();
        let appearance = self.tree.operands();
        let named = csg.boundary(&mut scratch).edges().map(|edge| {
            let operand = appearance[edge.operand];
            let mut inputs = self.operands[operand].rings.iter().flat_map(|ring| edges(ring));
            let (from, to) = inputs.nth(edge.edge).expect("an edge of the operand");
            ([edge.start, edge.end].map(bits), operand, [from, to])
        });
        let mut edges: Vec<_> = named.collect();
        edges.sort_by_key(|edge| edge.0);
        Answer { rings, edges }
    }
}

impl Answer {
    /// What differs, if anything does.
    pub fn difference(&self, other: &Answer) -> Option<&'static str> {
        let ends = |answer: &Answer| answer.edges.iter().map(|edge| edge.0).collect::<Vec<_>>();
        if self.rings != other.rings {
            return Some("the region");
        }
        if ends(self) != ends(other) {
            return Some("the boundary");
        }
        let is_known = |&(ends, operand, input): &(Ends, usize, [DVec2; 2])| {
            let mut alike = other.edges.iter().filter(|edge| edge.0 == ends);
            alike.any(|edge| (edge.1 == operand && is_one_edge(edge.2, input)) || coincide(edge.2, input))
        };
        (!self.edges.iter().all(is_known)).then_some("what an edge comes from")
    }
}

fn is_one_edge(s: [DVec2; 2], t: [DVec2; 2]) -> bool {
    s == t || s == [t[1], t[0]]
}

/// Whether two edges that bound the same lie on one line, so that either may be named.
fn coincide(s: [DVec2; 2], t: [DVec2; 2]) -> bool {
    s.iter().all(|&p| twice_signed_area([&[t[0], t[1], p][..]]).is_zero())
}

fn retold(operand: &Operand, choose: &mut impl FnMut(usize) -> usize) -> Operand {
    let all_reversed = operand.rule == Rule::NonZero && choose(2) == 1;
    let mut ring = |ring: &Ring| {
        let mut ring = ring.clone();
        let start = choose(ring.len().max(1));
        ring.rotate_left(start);
        if all_reversed || (operand.rule == Rule::EvenOdd && choose(2) == 1) {
            ring.reverse();
        }
        ring
    };
    let mut rings: Vec<Ring> = operand.rings.iter().map(&mut ring).collect();
    shuffle(&mut rings, choose);
    Operand { rings, rule: operand.rule }
}

/// Any order of some items.
pub fn shuffle<T>(items: &mut [T], choose: &mut impl FnMut(usize) -> usize) {
    for i in (1..items.len()).rev() {
        items.swap(i, choose(i + 1));
    }
}
