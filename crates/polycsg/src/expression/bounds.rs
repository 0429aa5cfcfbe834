//! Result bounds: a box around the result, and which rings cannot matter as they miss it.
//!
//! ```text
//!   a & (b | c)   +---a---+       Outside of a's box the result is empty, whatever b and c are. So the boxes of the
//!        +--b--+  |   +---|--c-+  operands bound the result. A ring whose box misses these bounds winds around none
//!        +-----+  +---+---+    |  of their points and touches nothing in them, so the result without that ring is
//!                     +--------+  the same.
//! ```
//!
//! Of a ring that leaves the bounds only what is near them is read; the rest, which may then run anywhere outside of them, never
//! matters: at each place outside of the bounds some operand that is needed is missing, and an operand stays in its own box.
//!
//! Rings that only touch the bounds stay: their vertices are put into the edges that they touch.

use super::csg::{Csg, Operator, Token};
use crate::base::corners::corners;
use crate::predicates::Window;
use glam::DVec2;

/// An axis-parallel box with its sides; no point when it is turned inside out.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: DVec2,
    high: DVec2,
}

impl Bounds {
    const NOTHING: Bounds = Bounds { low: DVec2::INFINITY, high: DVec2::NEG_INFINITY };
    const PLANE: Bounds = Bounds { low: DVec2::NEG_INFINITY, high: DVec2::INFINITY };

    fn of(points: &[DVec2]) -> Bounds {
        let [low, high] = corners(points);
        Bounds { low, high }
    }

    fn from_box(sides: Option<[DVec2; 2]>) -> Bounds {
        sides.map_or(Bounds::NOTHING, |[low, high]| Bounds { low, high })
    }

    fn joined(self, other: Bounds) -> Bounds {
        Bounds { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn common(self, other: Bounds) -> Bounds {
        if self.misses(other) {
            return Bounds::NOTHING;
        }
        Bounds { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    fn misses(self, other: Bounds) -> bool {
        self.high.cmplt(other.low).any() || other.high.cmplt(self.low).any()
    }

    fn contains(self, p: DVec2) -> bool {
        p.cmpge(self.low).all() && p.cmple(self.high).all()
    }
}

/// The box that the set lies in.
#[derive(Debug, Default)]
pub(crate) struct ResultBounds {
    /// The boxes of what no operator has taken yet; in the end that of the result, or none if no operator bounds it.
    bounds: Vec<Bounds>,
    /// Tests compare with the arrangement of all rings.
    #[cfg(test)]
    pub(crate) off: bool,
}

impl ResultBounds {
    /// Finds the bounds of an expression's result. O(n) for n points, if any operator bounds it.
    pub(crate) fn find(&mut self, csg: &Csg<'_>) {
        self.bounds.clear();
        #[cfg(test)]
        if self.off {
            return;
        }
        if !csg.postfix().any(bounds_its_operands) {
            return;
        }
        for token in csg.postfix() {
            let bounds = match token {
                Token::Region(region) => Bounds::of(region.rings_of().points()),
                Token::Prepared(prepared) => Bounds::from_box(prepared.bounds()),
                Token::Rings(rings, _) | Token::Edge(rings) => Bounds::of(rings.points()),
                Token::Operator(operator, count) => self.combined(*operator, *count),
            };
            self.bounds.push(bounds);
        }
    }

    /// The box of what an operator makes of the last operands.
    fn combined(&mut self, operator: Operator, count: usize) -> Bounds {
        let mut operands = self.bounds.drain(self.bounds.len() - count..);
        match operator {
            Operator::Union | Operator::SymmetricDifference => operands.fold(Bounds::NOTHING, Bounds::joined),
            Operator::Intersection => operands.fold(Bounds::PLANE, Bounds::common),
            Operator::Difference => operands.next().unwrap_or(Bounds::NOTHING),
        }
    }

    /// The box, if the result is confined to one.
    pub(crate) fn window(&self) -> Option<Window> {
        let result = self.bounds.first().filter(|result| result.low.cmpgt(DVec2::NEG_INFINITY).all())?;
        Some(Window::new(result.low, result.high))
    }

    /// Whether a ring may matter.
    #[inline]
    pub(crate) fn meets(&self, ring: &[DVec2]) -> bool {
        let result = self.bounds.first();
        result.is_none_or(|result| result.contains(ring[0]) || !result.misses(Bounds::of(ring)))
    }
}

/// Whether a token is an operator whose result may be smaller than the box around all of its operands.
fn bounds_its_operands(token: &Token<'_>) -> bool {
    matches!(token, Token::Operator(Operator::Intersection | Operator::Difference, _))
}
