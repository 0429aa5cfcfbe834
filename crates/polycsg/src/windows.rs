//! Stage 0: which rings cannot matter, by their boxes alone.
//!
//! ```text
//!   a & (b | c)   +---a---+       Outside of a's box the intersection is empty, whatever b and c are: that box is the
//!        +--b--+  |   +---|--c-+  *window* of what stands beside a. A ring whose box misses the window winds around
//!        +-----+  +---+---+    |  none of its points, so the set without it is the same set.
//!                     +--------+  Windows come from the boxes of what must hold at once; a union alone has none.
//! ```
//!
//! Rings that only touch a window stay: their vertices are put into the edges that they touch.

use crate::csg::{Csg, Token};
use crate::gates::Kind;
use crate::truth::Truth;
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

/// The window of each gate's members.
#[derive(Debug, Default)]
pub(crate) struct Windows {
    /// Per gate the box outside of which it does not hold, then the window; none where there are no windows.
    bounds: Vec<Bounds>,
    /// Per gate whether its box tells anything: all of something must hold where it does.
    tell: Vec<bool>,
    /// Tests compare with the arrangement of all rings.
    #[cfg(test)]
    pub(crate) off: bool,
}

impl Windows {
    /// Finds the windows of an expression's gates. O(n) for n points of operands that bound any, if there are any.
    pub(crate) fn find(&mut self, csg: &Csg<'_>, truth: &Truth) {
        self.bounds.clear();
        #[cfg(test)]
        if self.off {
            return;
        }
        let gates = truth.gates();
        if (0..gates.len()).all(|gate| gates.kind(gate) != Kind::All) {
            return;
        }
        let start = |gate| if gates.kind(gate) == Kind::All { Bounds::PLANE } else { Bounds::NOTHING };
        self.bounds.extend((0..gates.len()).map(start));
        self.find_telling(truth);
        self.bound_by_operands(csg, truth);
        for gate in (1..gates.len()).rev() {
            if let Some((above, false)) = gates.above(gate) {
                self.bound(truth, above, self.bounds[gate as usize]);
            }
        }
        for gate in 0..gates.len() {
            let above = gates.above(gate).map_or(Bounds::PLANE, |(above, _)| self.bounds[above as usize]);
            let own = if gates.kind(gate) == Kind::All { self.bounds[gate as usize] } else { Bounds::PLANE };
            self.bounds[gate as usize] = own.common(above);
        }
    }

    fn find_telling(&mut self, truth: &Truth) {
        let gates = truth.gates();
        self.tell.clear();
        for gate in 0..gates.len() {
            let by_above =
                gates.above(gate).is_some_and(|(above, opposite)| !opposite && self.tell[above as usize]);
            self.tell.push(by_above || gates.kind(gate) == Kind::All);
        }
    }

    fn bound_by_operands(&mut self, csg: &Csg<'_>, truth: &Truth) {
        for (operand, rings) in csg.postfix().iter().filter_map(Token::rings).enumerate() {
            if let Some(gate) = truth.gate_of(operand).filter(|&gate| self.tell[gate as usize]) {
                self.bound(truth, gate, Bounds::of(rings.points()));
            }
        }
    }

    /// Takes up the box of one of a gate's members.
    fn bound(&mut self, truth: &Truth, gate: u32, member: Bounds) {
        let bounds = &mut self.bounds[gate as usize];
        *bounds = match truth.gates().kind(gate) {
            Kind::All => bounds.common(member),
            Kind::Any | Kind::Odd => bounds.joined(member),
        };
    }

    /// Whether a ring of an operand may matter.
    #[inline]
    pub(crate) fn meet(&self, operand: u32, ring: &[DVec2], truth: &Truth) -> bool {
        if self.bounds.is_empty() {
            return true;
        }
        let Some(gate) = truth.gate_of(operand as usize) else { return true };
        let window = self.bounds[gate as usize];
        window.contains(ring[0]) || !window.misses(Bounds::of(ring))
    }
}
