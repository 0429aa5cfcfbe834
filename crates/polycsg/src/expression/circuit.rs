//! The Boolean circuit of an expression: how a change of one member travels to the root.
//!
//! ```text
//!   or ── and ── xor ── …     Seen from its largest member gate, a gate is one of four functions: always false, always
//!    │     │      │           true, the same, the opposite. A path of largest members is the composition of these;
//!    a     b      c           a tree over the path keeps the partial compositions.
//! ```
//!
//! A change recomputes O(log n) compositions on each of the O(log n) paths between its gate and the root, and ends where a
//! composition stays what it was: expressions of any depth cost little more than flat ones.

use crate::base::id::index;
use crate::base::meter::{Meter, Refusal};

/// When a gate holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Any,
    All,
    Odd,
}

/// A function of one Boolean: its values for false and for true, in two bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Function(u8);

impl Function {
    const SAME: Function = Function(0b10);
    const OPPOSITE: Function = Function(0b01);

    fn always(value: bool) -> Function {
        Function(if value { 0b11 } else { 0 })
    }

    #[inline]
    fn of(self, argument: u8) -> u8 {
        self.0 >> argument & 1
    }

    /// This function after another one.
    #[inline]
    fn after(self, first: Function) -> Function {
        Function(self.of(first.of(0)) | self.of(first.of(1)) << 1)
    }
}

#[derive(Clone, Copy, Debug)]
struct Gate {
    kind: Kind,
    /// Its members but the largest gate, and how many of them hold.
    others: i32,
    true_others: i32,
    /// The gate that it is a member of, and whether that takes its opposite.
    above: Option<(u32, bool)>,
    /// Its largest member gate, and whether it takes its opposite.
    largest: Option<(u32, bool)>,
    /// The first of its path, and its place in the path's tree.
    top: u32,
    place: u32,
    /// Of the first of a path: where the path's tree starts.
    tree: u32,
}

impl Gate {
    /// What it makes of its largest member gate.
    #[inline]
    fn function(&self) -> Function {
        let open = match self.kind {
            Kind::Any if self.true_others > 0 => return Function::always(true),
            Kind::All if self.true_others < self.others => return Function::always(false),
            Kind::Any | Kind::All => false,
            Kind::Odd => self.true_others & 1 == 1,
        };
        match self.largest {
            Some((_, opposite)) if opposite == open => Function::SAME,
            Some(_) => Function::OPPOSITE,
            None => Function::always(open || self.kind == Kind::All),
        }
    }
}

/// See the module's page. The first gate is the root.
#[derive(Debug, Default)]
pub(crate) struct Circuit {
    gates: Vec<Gate>,
    /// The trees of all paths, each a heap: node `i` composes nodes `2 i` and `2 i + 1`.
    nodes: Vec<Function>,
    /// Per gate how many gates are in it.
    sizes: Vec<u32>,
    /// Per gate its truth table.
    columns: Vec<u64>,
}

impl Circuit {
    pub(crate) fn clear(&mut self) {
        self.gates.clear();
        self.nodes.clear();
    }

    /// Adds a gate as a member of another one, which may take its opposite.
    pub(crate) fn add(&mut self, kind: Kind, above: Option<(u32, bool)>) -> u32 {
        let gate = Gate { kind, others: 0, true_others: 0, above, largest: None, top: 0, place: 0, tree: 0 };
        self.gates.push(gate);
        index(self.gates.len() - 1)
    }

    /// Adds a member that is no gate.
    pub(crate) fn add_member(&mut self, gate: u32) {
        self.gates[gate as usize].others += 1;
    }

    pub(crate) fn kind(&self, gate: u32) -> Kind {
        self.gates[gate as usize].kind
    }

    /// The truth table of the whole expression, from the gates of its members that are none, each with its own column.
    pub(crate) fn table(&mut self, members: impl Iterator<Item = (u32, u64)>) -> u64 {
        let start = |gate: &Gate| if gate.kind == Kind::All { u64::MAX } else { 0 };
        self.columns.clear();
        self.columns.extend(self.gates.iter().map(start));
        for (gate, column) in members {
            self.combine(gate, column);
        }
        for gate in (1..self.gates.len()).rev() {
            if let Some((above, opposite)) = self.gates[gate].above {
                let column = self.columns[gate];
                self.combine(above, if opposite { !column } else { column });
            }
        }
        self.columns[0]
    }

    /// Takes up the column of one of a gate's members.
    fn combine(&mut self, gate: u32, member: u64) {
        let column = &mut self.columns[gate as usize];
        match self.gates[gate as usize].kind {
            Kind::Any => *column |= member,
            Kind::All => *column &= member,
            Kind::Odd => *column ^= member,
        }
    }

    /// Lays out the paths, once all gates and members are there; no member holds.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn lay_out(&mut self, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.find_largest();
        meter.spend(self.gates.len())?;
        for gate in 0..self.gates.len() {
            let is_largest = |(above, _): (u32, bool)| {
                self.gates[above as usize].largest.is_some_and(|(largest, _)| largest as usize == gate)
            };
            if !self.gates[gate].above.is_some_and(is_largest) {
                self.lay_out_path(index(gate));
            }
        }
        meter.spend(self.gates.len())?;
        // Paths start false: those whose start holds tell the gate above.
        for gate in (0..self.gates.len()).rev() {
            if self.gates[gate].top as usize == gate {
                self.start(index(gate));
            }
        }
        meter.spend(self.gates.len())
    }

    /// Finds the largest member gate of each, and counts the others.
    fn find_largest(&mut self) {
        self.sizes.clear();
        self.sizes.resize(self.gates.len(), 1);
        for gate in (1..self.gates.len()).rev() {
            let Some((above, opposite)) = self.gates[gate].above else { continue };
            self.sizes[above as usize] += self.sizes[gate];
            let size = |other: Option<(u32, bool)>| other.map_or(0, |(other, _)| self.sizes[other as usize]);
            let largest = self.gates[above as usize].largest;
            self.gates[above as usize].others += i32::from(largest.is_some());
            if self.sizes[gate] > size(largest) {
                self.gates[above as usize].largest = Some((index(gate), opposite));
            }
        }
    }

    fn lay_out_path(&mut self, top: u32) {
        let next = |gate: &u32| self.gates[*gate as usize].largest.map(|(largest, _)| largest);
        let length = std::iter::successors(Some(top), next).count();
        let (tree, leaves) = (index(self.nodes.len()), length.next_power_of_two());
        self.nodes.resize(tree as usize + 2 * leaves, Function::SAME);
        let mut gate = Some(top);
        let mut place = index(leaves);
        while let Some(at) = gate {
            let about = &mut self.gates[at as usize];
            (about.top, about.place, about.tree) = (top, place, tree);
            gate = about.largest.map(|(largest, _)| largest);
            place += 1;
        }
    }

    /// Composes a path from its gates, whose other members are started, and tells the gate above.
    fn start(&mut self, top: u32) {
        let Gate { tree, place: leaves, above, .. } = self.gates[top as usize];
        let mut gate = Some(top);
        while let Some(at) = gate {
            let about = &self.gates[at as usize];
            self.nodes[(tree + about.place) as usize] = about.function();
            gate = about.largest.map(|(largest, _)| largest);
        }
        for node in (1..leaves).rev() {
            self.nodes[(tree + node) as usize] = self.composed(tree, node);
        }
        if let Some((above, opposite)) = above {
            let holds = self.path_holds(tree) != opposite;
            self.gates[above as usize].true_others += i32::from(holds);
        }
    }

    #[inline]
    fn composed(&self, tree: u32, node: u32) -> Function {
        let [outer, inner] = [2 * node, 2 * node + 1].map(|node| self.nodes[(tree + node) as usize]);
        outer.after(inner)
    }

    /// Whether the first gate of a path holds.
    #[inline]
    fn path_holds(&self, tree: u32) -> bool {
        self.nodes[tree as usize + 1].of(0) == 1
    }

    /// Whether the whole expression holds.
    #[inline]
    pub(crate) fn holds(&self) -> bool {
        self.path_holds(0)
    }

    /// Takes up that a member of a gate, which is no gate itself, holds now, or does not any more.
    #[inline]
    pub(crate) fn change(&mut self, mut gate: u32, mut holds: bool) {
        loop {
            let about = &mut self.gates[gate as usize];
            about.true_others += if holds { 1 } else { -1 };
            let (function, mut node, top) = (about.function(), about.place, about.top);
            let Gate { tree, above, .. } = self.gates[top as usize];
            if !self.set(tree, node, function) {
                return;
            }
            while node > 1 {
                node /= 2;
                if !self.set(tree, node, self.composed(tree, node)) {
                    return;
                }
            }
            let Some((above, opposite)) = above else { return };
            (gate, holds) = (above, self.path_holds(tree) != opposite);
        }
    }

    /// Whether the whole expression would hold after a [`change`](Circuit::change).
    #[inline]
    pub(crate) fn would_hold(&self, mut gate: u32, mut holds: bool) -> bool {
        loop {
            let mut about = self.gates[gate as usize];
            about.true_others += if holds { 1 } else { -1 };
            let (mut function, mut node) = (about.function(), about.place);
            let Gate { tree, above, .. } = self.gates[about.top as usize];
            let at = |node: u32| self.nodes[(tree + node) as usize];
            while function != at(node) && node > 1 {
                let other = at(node ^ 1);
                function = if node & 1 == 0 { function.after(other) } else { other.after(function) };
                node /= 2;
            }
            if function == at(node) {
                return self.holds();
            }
            let Some((above, opposite)) = above else { return function.of(0) == 1 };
            (gate, holds) = (above, (function.of(0) == 1) != opposite);
        }
    }

    /// Sets a node, and tells whether that changed it.
    #[inline]
    fn set(&mut self, tree: u32, node: u32, function: Function) -> bool {
        std::mem::replace(&mut self.nodes[(tree + node) as usize], function) != function
    }
}
