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

use super::csg::{Csg, Token};
use super::{circuit::Kind, winding::WindingNumbers};
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
        let grown = |b: Bounds, &p: &DVec2| Bounds { low: b.low.min(p), high: b.high.max(p) };
        points.iter().fold(Bounds::NOTHING, grown)
    }

    fn of_operand(token: &Token<'_>) -> Bounds {
        match token {
            Token::Prepared(prepared) => {
                prepared.bounds().map_or(Bounds::NOTHING, |[low, high]| Bounds { low, high })
            }
            token => token.rings().map_or(Bounds::NOTHING, |rings| Bounds::of(rings.points())),
        }
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
    /// Per gate the box outside of which it does not hold; none where no gate needs all of its members.
    bounds: Vec<Bounds>,
    /// Per gate whether the bounds depend on its box: not if its opposite is asked for.
    tells: Vec<bool>,
    /// Tests compare with the arrangement of all rings.
    #[cfg(test)]
    pub(crate) off: bool,
}

impl ResultBounds {
    /// Finds the bounds of an expression's result. O(n) for n points of operands that bound it, if any do.
    pub(crate) fn find(&mut self, csg: &Csg<'_>, winding: &WindingNumbers) {
        self.bounds.clear();
        #[cfg(test)]
        if self.off {
            return;
        }
        let gates = winding.gates();
        if (0..gates.len()).all(|gate| gates.kind(gate) != Kind::All) {
            return;
        }
        self.tells.clear();
        for gate in 0..gates.len() {
            let above = gates.above(gate);
            self.tells.push(above.is_none_or(|(above, opposite)| !opposite && self.tells[above as usize]));
        }
        let start = |gate| if gates.kind(gate) == Kind::All { Bounds::PLANE } else { Bounds::NOTHING };
        self.bounds.extend((0..gates.len()).map(start));
        for (operand, token) in csg.postfix().iter().filter(|token| token.rings().is_some()).enumerate() {
            if let Some(gate) = winding.gate_of(operand).filter(|&gate| self.tells[gate as usize]) {
                self.bound(winding, gate, Bounds::of_operand(token));
            }
        }
        for gate in (1..gates.len()).rev() {
            if let Some((above, false)) = gates.above(gate) {
                self.bound(winding, above, self.bounds[gate as usize]);
            }
        }
    }

    /// Takes up the box of one of a gate's members.
    fn bound(&mut self, winding: &WindingNumbers, gate: u32, member: Bounds) {
        let bounds = &mut self.bounds[gate as usize];
        *bounds = match winding.gates().kind(gate) {
            Kind::All => bounds.common(member),
            Kind::Any | Kind::Odd => bounds.joined(member),
        };
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
