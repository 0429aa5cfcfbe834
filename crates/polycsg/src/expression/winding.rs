//! The state of a walk over the arrangement: the winding number of each operand at the walk's place, and whether the whole
//! expression holds there.
//!
//! Winding numbers are kept in counters, the members of [`Circuit`]. Operands that wind once at most (regions, and small simple
//! rings) and stand under one union or symmetric difference share one counter: the number of operands that contain the place
//! decides. Opposite edges of one counter cancel, so that such operands dissolve quickly. Whether raw rings wind so is asked where
//! they are many, and of few only where edges coincide.

use super::apart::{operands_are_apart, rings_wind_once};
use super::circuit::{Circuit, Kind};
use super::csg::{Csg, FillRule, Operator, Token};
use super::simple_ring::winds_once;
use crate::base::id::index;
use crate::base::meter::{Meter, Refusal};
use crate::{region::rings::Rings, spatial::strips::Strips};
use glam::DVec2;

/// Which winding numbers hold: those that lie in a range, if `mask` is laid over them first. Without branches, as walks
/// ask it at each crossing.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rule {
    mask: i32,
    low: i32,
    width: u32,
}

impl Rule {
    const NON_ZERO: Rule = Rule { mask: !0, low: 1, width: u32::MAX };
    const NEGATIVE: Rule = Rule { mask: !0, low: i32::MIN, width: 1 << 31 };
    const POSITIVE: Rule = Rule { mask: !0, low: 1, width: i32::MAX.unsigned_abs() };
    const ODD: Rule = Rule { mask: 1, low: 1, width: 1 };

    fn of(rule: FillRule) -> Rule {
        match rule {
            FillRule::EvenOdd => Rule::ODD,
            FillRule::NonZero => Rule::NON_ZERO,
            FillRule::Positive => Rule::POSITIVE,
        }
    }

    #[inline]
    fn holds(self, winding: i32) -> bool {
        ((winding & self.mask).wrapping_sub(self.low) as u32) < self.width
    }
}

#[derive(Clone, Copy, Debug)]
struct Counter {
    winding: i32,
    rule: Rule,
    holds: bool,
    gate: u32,
    /// Whether the whole expression is a union, and it holds where any ring does that it counts, if these wind one way.
    is_union: bool,
}

/// The gate of the whole expression.
const ROOT: u32 = 0;

/// Of so many counters every combination fits into a table of 64 bits.
const FEW: usize = 6;

/// In bit i whether bit k of i is set: the column of counter k in a truth table.
const COLUMNS: [u64; FEW] = [
    0xaaaa_aaaa_aaaa_aaaa,
    0xcccc_cccc_cccc_cccc,
    0xf0f0_f0f0_f0f0_f0f0,
    0xff00_ff00_ff00_ff00,
    0xffff_0000_ffff_0000,
    0xffff_ffff_0000_0000,
];

/// See the module's page.
#[derive(Debug, Default)]
pub(crate) struct WindingNumbers {
    counters: Vec<Counter>,
    /// Of few counters: those that hold, in bits, and for each combination of bits whether the expression holds there.
    holding: u32,
    table: Option<u64>,
    gates: Circuit,
    /// Per gate the counters that its members share that wind once, clockwise and counter-clockwise.
    shared: Vec<[Option<u32>; 2]>,
    /// The counter of each operand; an open edge has none.
    operands: Vec<Option<u32>>,
    /// Whether raw rings share counters, too.
    raw_share: bool,
    /// Whether more operands might share counters.
    more_may_share: bool,
    open: Vec<Open>,
    /// Of operands that may lie apart.
    boxes: Vec<[DVec2; 2]>,
}

/// A gate that awaits operands: `remaining` of them, the first into `first`, all others into `rest`.
#[derive(Clone, Copy, Debug)]
struct Open {
    remaining: usize,
    first: u32,
    rest: u32,
}

impl WindingNumbers {
    /// Compiles an expression; the state is that of a place outside of everything.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn compile(&mut self, csg: &Csg<'_>, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.raw_share = csg.len() > 2 * FEW;
        if self.compile_pair(csg) { Ok(()) } else { self.compile_shared(csg, None, meter) }
    }

    /// Two operands of raw rings, by far the most frequent, need no circuit: they have two counters and one of four tables.
    fn compile_pair(&mut self, csg: &Csg<'_>) -> bool {
        if csg.len() != 3 {
            return false;
        }
        let tokens = (csg.token(0), csg.token(1), csg.token(2));
        let (Token::Rings(_, first), Token::Rings(_, second), Token::Operator(operator, 2)) = tokens else {
            return false;
        };
        let of = |rule: Rule| {
            let is_union = rule == Rule::NON_ZERO && *operator == Operator::Union;
            Counter { winding: 0, rule, holds: false, gate: ROOT, is_union }
        };
        self.more_may_share = true;
        self.counters.clear();
        self.counters.extend([of(Rule::of(*second)), of(Rule::of(*first))]);
        self.operands.clear();
        self.operands.extend([Some(1), Some(0)]);
        let [second, first, ..] = COLUMNS;
        self.holding = 0;
        self.table = Some(match operator {
            Operator::Union => first | second,
            Operator::Intersection => first & second,
            Operator::Difference => first & !second,
            Operator::SymmetricDifference => first ^ second,
        });
        true
    }

    /// Compiles it anew where operands that wind once might share counters and do not yet: operands may have other counters then.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn share(
        &mut self,
        csg: &Csg<'_>,
        strips: &mut Strips,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        if self.more_may_share && csg.len() > 1 {
            self.raw_share = true;
            self.compile_shared(csg, Some(strips), meter)?;
        }
        Ok(())
    }

    fn compile_shared(
        &mut self,
        csg: &Csg<'_>,
        mut strips: Option<&mut Strips>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.more_may_share = false;
        self.counters.clear();
        self.gates.clear();
        self.shared.clear();
        self.operands.clear();
        let root = match csg.postfix().next_back() {
            Some(Token::Operator(operator, _)) => kind_of(*operator),
            _ => Kind::Any,
        };
        self.add_gate(root, None);
        self.open.clear();
        self.open.push(Open { remaining: 1, first: 0, rest: 0 });
        let mut tally = meter.tally();
        for (token, place) in csg.postfix().rev().zip((0..csg.len()).rev()) {
            tally.add(1)?;
            while self.open.last().is_some_and(|top| top.remaining == 0) {
                self.open.pop();
            }
            let Some(top) = self.open.last_mut() else { break };
            top.remaining -= 1;
            let gate = if top.remaining == 0 { top.first } else { top.rest };
            match token {
                Token::Operator(operator, count) => {
                    let operands = csg.postfix().skip(place.saturating_sub(*count)).take(*count);
                    let operator = self.simpler(*operator, operands, gate, strips.as_deref_mut(), meter)?;
                    let gate = self.gate_for(operator, *count, gate);
                    self.open.push(gate);
                }
                Token::Region(_) | Token::Prepared(_) => self.add_once(1, gate),
                Token::Rings(rings, rule) => {
                    match self.winds_once(rings, *rule, gate, strips.as_deref_mut(), meter)? {
                        Some(winds) => self.add_once(winds, gate),
                        None => self.add_rings(*rule, gate),
                    }
                }
                Token::Edge(_) => self.operands.push(None),
            }
        }
        self.operands.reverse();
        self.holding = 0;
        self.table = (self.counters.len() <= FEW).then(|| {
            let columns = self.counters.iter().zip(COLUMNS).map(|(counter, column)| (counter.gate, column));
            self.gates.table(columns)
        });
        if self.table.is_none() {
            self.gates.lay_out(meter)?;
        }
        Ok(())
    }

    fn gate_for(&mut self, operator: Operator, count: usize, above: u32) -> Open {
        let kind = kind_of(operator);
        // Same in same is one gate.
        let first =
            if self.gates.kind(above) == kind { above } else { self.add_gate(kind, Some((above, false))) };
        let subtracts = operator == Operator::Difference;
        let rest = if subtracts { self.add_gate(Kind::Any, Some((first, true))) } else { first };
        Open { remaining: count, first, rest }
    }

    fn add_gate(&mut self, kind: Kind, above: Option<(u32, bool)>) -> u32 {
        self.shared.push([None; 2]);
        self.gates.add(kind, above)
    }

    fn add_counter(&mut self, rule: Rule, gate: u32, is_union: bool) -> u32 {
        self.gates.add_member(gate);
        self.counters.push(Counter { winding: 0, rule, holds: false, gate, is_union });
        index(self.counters.len() - 1)
    }

    /// Adds an operand whose winding number is 0 or `winds`, 1 or -1.
    fn add_once(&mut self, winds: i32, gate: u32) {
        let once = if winds < 0 { Rule::NEGATIVE } else { Rule::POSITIVE };
        let kind = self.gates.kind(gate);
        let rule = match kind {
            // What the result's bounds see of a region winds once at most within them alone: others must not make up for it.
            Kind::All => {
                let counter = self.add_counter(once, gate, false);
                return self.operands.push(Some(counter));
            }
            Kind::Any => once,
            Kind::Odd => Rule::ODD,
        };
        let direction = usize::from(winds > 0);
        let counter = match self.shared[gate as usize][direction] {
            Some(counter) => counter,
            None => self.add_counter(rule, gate, kind == Kind::Any && gate == ROOT),
        };
        self.shared[gate as usize][direction] = Some(counter);
        self.operands.push(Some(counter));
    }

    /// A union of operands that lie apart is their symmetric difference, which may be a part of another one.
    fn simpler<'t, 'c: 't>(
        &mut self,
        operator: Operator,
        operands: impl Iterator<Item = &'t Token<'c>>,
        above: u32,
        strips: Option<&mut Strips>,
        meter: &Meter<'_>,
    ) -> Result<Operator, Refusal> {
        if operator != Operator::Union || self.gates.kind(above) != Kind::Odd {
            return Ok(operator);
        }
        self.more_may_share |= strips.is_none();
        let apart = match strips {
            Some(strips) => operands_are_apart(operands, &mut self.boxes, strips, meter)?,
            None => false,
        };
        Ok(if apart { Operator::SymmetricDifference } else { operator })
    }

    /// 1 or -1 if raw rings are known to wind so, or not at all, wherever they hold; sought where they may share a counter.
    fn winds_once(
        &mut self,
        rings: &Rings,
        rule: FillRule,
        gate: u32,
        strips: Option<&mut Strips>,
        meter: &Meter<'_>,
    ) -> Result<Option<i32>, Refusal> {
        if self.gates.kind(gate) == Kind::All {
            return Ok(None);
        }
        self.more_may_share |= strips.is_none() && !self.raw_share;
        let winds = match (strips, rings.len()) {
            (_, 1) if self.raw_share => winds_once(rings.closed(0)),
            (Some(strips), 2..) => rings_wind_once(rings, &mut self.boxes, strips, meter)?,
            _ => None,
        };
        Ok(winds.filter(|&winds| winds > 0 || rule != FillRule::Positive))
    }

    fn add_rings(&mut self, rule: FillRule, gate: u32) {
        let rule = Rule::of(rule);
        let is_union = rule == Rule::NON_ZERO && gate == ROOT && self.gates.kind(gate) == Kind::Any;
        let counter = self.add_counter(rule, gate, is_union);
        self.operands.push(Some(counter));
    }

    /// The counter of an operand.
    pub(crate) fn counter(&self, operand: usize) -> Option<u32> {
        self.operands[operand]
    }

    /// Whether the whole expression is a union, and a counter holds where any of its rings does, if these all wind one way.
    pub(crate) fn is_union(&self, counter: u32) -> bool {
        self.counters[counter as usize].is_union
    }

    /// Whether the expression holds at the walk's place.
    #[inline]
    pub(crate) fn holds(&self) -> bool {
        match self.table {
            Some(table) => table >> self.holding & 1 == 1,
            None => self.gates.holds(),
        }
    }

    /// Moves the walk over an edge: the winding number of one counter changes by `change`.
    #[inline]
    pub(crate) fn cross(&mut self, counter: u32, change: i32) {
        let about = &mut self.counters[counter as usize];
        about.winding += change;
        let holds = about.rule.holds(about.winding);
        let changes = holds != std::mem::replace(&mut about.holds, holds);
        match self.table {
            Some(_) => self.holding ^= u32::from(changes) << counter,
            None if changes => self.gates.change(about.gate, holds),
            None => {}
        }
    }

    /// Whether the expression would hold after a [`cross`](WindingNumbers::cross).
    #[inline]
    pub(crate) fn would_hold(&self, counter: u32, change: i32) -> bool {
        let about = &self.counters[counter as usize];
        let holds = about.rule.holds(about.winding + change);
        match self.table {
            Some(table) => table >> (self.holding ^ u32::from(holds != about.holds) << counter) & 1 == 1,
            None if holds == about.holds => self.holds(),
            None => self.gates.would_hold(about.gate, holds),
        }
    }

    /// Whether the walk has come back to a place outside of everything.
    pub(crate) fn is_outside(&self) -> bool {
        self.counters.iter().all(|c| c.winding == 0)
    }
}

fn kind_of(operator: Operator) -> Kind {
    match operator {
        Operator::Union => Kind::Any,
        Operator::Intersection | Operator::Difference => Kind::All,
        Operator::SymmetricDifference => Kind::Odd,
    }
}
