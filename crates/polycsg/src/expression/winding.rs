//! The state of a walk over the arrangement: the winding number of each operand at the walk's place, and whether the whole
//! expression holds there.
//!
//! Winding numbers are kept in counters, the members of [`Circuit`]. Operands that wind once at most (regions) and stand
//! under one union or symmetric difference share one counter: the number of operands that contain the
//! place decides.

use super::circuit::{Circuit, Kind};
use super::csg::{Csg, FillRule, Operator, Token};
use crate::base::id::index;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    NonZero,
    Positive,
    Odd,
}

impl Rule {
    #[inline]
    fn holds(self, winding: i32) -> bool {
        match self {
            Rule::NonZero => winding != 0,
            Rule::Positive => winding > 0,
            Rule::Odd => winding & 1 == 1,
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Counter {
    winding: i32,
    rule: Rule,
    holds: bool,
    gate: u32,
}

/// See the module's page.
#[derive(Debug, Default)]
pub(crate) struct WindingNumbers {
    counters: Vec<Counter>,
    gates: Circuit,
    /// Per gate the counter that its regions share.
    shared: Vec<Option<u32>>,
    /// The counter of each operand; an open edge has none.
    operands: Vec<Option<u32>>,
    open: Vec<Open>,
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
    pub(crate) fn compile(&mut self, csg: &Csg<'_>) {
        self.counters.clear();
        self.gates.clear();
        self.shared.clear();
        self.operands.clear();
        let root = match csg.postfix().back() {
            Some(Token::Operator(operator, _)) => kind_of(*operator),
            _ => Kind::Any,
        };
        self.add_gate(root, None);
        self.open.clear();
        self.open.push(Open { remaining: 1, first: 0, rest: 0 });
        for token in csg.postfix().iter().rev() {
            while self.open.last().is_some_and(|top| top.remaining == 0) {
                self.open.pop();
            }
            let Some(top) = self.open.last_mut() else { break };
            top.remaining -= 1;
            let gate = if top.remaining == 0 { top.first } else { top.rest };
            match token {
                Token::Operator(operator, count) => {
                    let gate = self.gate_for(*operator, *count, gate);
                    self.open.push(gate);
                }
                Token::Region(_) | Token::Prepared(_) => self.add_region(gate),
                Token::Rings(_, rule) => self.add_rings(*rule, gate),
                Token::Edge(_) => self.operands.push(None),
            }
        }
        self.operands.reverse();
        self.gates.lay_out();
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
        self.shared.push(None);
        self.gates.add(kind, above)
    }

    fn add_counter(&mut self, rule: Rule, gate: u32) -> u32 {
        self.gates.add_member(gate);
        self.counters.push(Counter { winding: 0, rule, holds: false, gate });
        index(self.counters.len() - 1)
    }

    fn add_region(&mut self, gate: u32) {
        let rule = match self.gates.kind(gate) {
            // What the result's bounds see of a region winds once at most within them alone: others must not make up for it.
            Kind::All => return self.add_rings(FillRule::Positive, gate),
            Kind::Any => Rule::Positive,
            Kind::Odd => Rule::Odd,
        };
        let counter = match self.shared[gate as usize] {
            Some(counter) => counter,
            None => self.add_counter(rule, gate),
        };
        self.shared[gate as usize] = Some(counter);
        self.operands.push(Some(counter));
    }

    fn add_rings(&mut self, rule: FillRule, gate: u32) {
        let rule = match rule {
            FillRule::EvenOdd => Rule::Odd,
            FillRule::NonZero => Rule::NonZero,
            FillRule::Positive => Rule::Positive,
        };
        let counter = self.add_counter(rule, gate);
        self.operands.push(Some(counter));
    }

    pub(crate) fn gates(&self) -> &Circuit {
        &self.gates
    }

    /// The gate that an operand is a member of; none for an open edge.
    pub(crate) fn gate_of(&self, operand: usize) -> Option<u32> {
        self.operands[operand].map(|counter| self.counters[counter as usize].gate)
    }

    /// The counter of an operand.
    pub(crate) fn counter(&self, operand: usize) -> Option<u32> {
        self.operands[operand]
    }

    /// Whether the expression holds at the walk's place.
    #[inline]
    pub(crate) fn holds(&self) -> bool {
        self.gates.holds()
    }

    /// Moves the walk over an edge: the winding number of one counter changes by `change`.
    #[inline]
    pub(crate) fn cross(&mut self, counter: u32, change: i32) {
        let counter = &mut self.counters[counter as usize];
        counter.winding += change;
        let holds = counter.rule.holds(counter.winding);
        if holds != counter.holds {
            counter.holds = holds;
            self.gates.change(counter.gate, holds);
        }
    }

    /// Whether the expression would hold after a [`cross`](WindingNumbers::cross).
    #[inline]
    pub(crate) fn would_hold(&self, counter: u32, change: i32) -> bool {
        let counter = &self.counters[counter as usize];
        let holds = counter.rule.holds(counter.winding + change);
        if holds == counter.holds { self.holds() } else { self.gates.would_hold(counter.gate, holds) }
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
