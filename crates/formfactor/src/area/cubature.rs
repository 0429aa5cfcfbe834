//! Pairs that are hidden in part: cubature on cells that are cut where the view changes its shape.
use super::clip::before;
use super::estimate::{CellView, FINE, RULES, SURE, a_priori};
use super::events::cut;
use super::integral::{Allowed, Integral, least_whole, most};
use super::integrand::Integrand;
use super::patch::Patch;
use super::plan::{Planned, plan};
use super::point::{Eye, Focus, Near};
use super::queue::{Open, Queue};
use crate::scene::surfaces::{Surface, area as area_of};
use crate::shapes::cell::{Cell, area, fan, halves};
use glam::DVec3;

/// The integral of the form factor over a source.
#[derive(Debug)]
pub(super) struct Cubature<'p> {
    of: Integrand<'p>,
    /// What of the source is before the target's plane.
    source: Vec<Vec<DVec3>>,
    /// No point of the source has a larger factor to the target.
    most: f64,
    size: f64,
    /// The integral with nothing in between, if it is known, and roughly.
    unhidden: Option<Integral>,
    whole: f64,
    /// What errors are estimated by.
    scale: f64,
    /// What counts as no less in the tolerance.
    least: f64,
    tolerance: f64,
    open: Queue,
}

/// The share of the tolerance that any cut which is not made may take.
const UNCUT: f64 = 1e-3;

/// Where there are too many cuts, those that change less than so many times that are not made.
const LEAVE_OUT: [f64; 3] = [1.0, 20.0, 400.0];

/// The share of the tolerance that any cell may take at first.
const START: f64 = 0.1;

/// A rule of few nodes is checked by the next where a cell is so close to what it looks at, in halves of its longest side.
const CLOSE: f64 = 2.0;

/// Past one occluder cuts are not made where rules take so few nodes without; past more so many times the square of their number.
const FEW_NODES: usize = 64;

/// What a rule of few nodes says is raised by this.
const RAISED: f64 = 2.0;

/// What rules before this one err by where some is hidden mostly goes either way.
const ROUGH: usize = 3;

/// A cell is halved so often before cuts by events are given up.
const BLIND_HALVINGS: u32 = 4;

impl<'p> Cubature<'p> {
    pub(super) fn new(from: &Surface, to: &'p Surface, occluders: &'p [Near<'p>], eye: &'p mut Eye) -> Self {
        let source = before(&from.pieces, to.face);
        let size = source.iter().map(|piece| area_of(piece)).sum();
        Self {
            of: Integrand::new(from, to, occluders, eye),
            source,
            most: most(from, to),
            size,
            unhidden: None,
            whole: 0.0,
            scale: 0.0,
            least: least_whole(from, to),
            tolerance: 0.0,
            open: Queue::default(),
        }
    }

    /// The integral. `unhidden` is what it were with nothing in between, if that is known.
    pub(super) fn integrate(
        mut self,
        unhidden: Option<Integral>,
        allowed: &Allowed,
        is_cancelled: &(impl Fn() -> bool + ?Sized),
    ) -> Option<Integral> {
        if self.source.is_empty() || self.of.is_nothing() {
            return Some(Integral::default());
        }
        self.unhidden = unhidden;
        self.of.is_rest_known = unhidden.is_some();
        let Self { source, of, .. } = &mut self;
        let roughly = || source.iter().map(|piece| of.roughly(piece)).sum();
        self.whole = unhidden.map_or_else(roughly, |unhidden| unhidden.value);
        // Where planes cut the polygons off, a few nodes may see little of them.
        self.scale = if unhidden.is_some() { self.whole } else { RAISED * self.whole };
        let known = unhidden.map_or(0.0, |unhidden| unhidden.error);
        let whole = self.whole.max(self.least);
        self.tolerance = allowed.error(self.whole, whole);
        for piece in std::mem::take(&mut self.source) {
            self.begin(&piece);
        }
        while self.of.evaluations < allowed.evaluations {
            if is_cancelled() {
                return None;
            }
            self.tolerance = allowed.error(self.seen(self.open.value), whole);
            if known + self.open.error() <= self.tolerance {
                break;
            }
            let Some(worst) = self.open.pop() else { break };
            self.refine(&worst);
        }
        let (value, error) = self.open.sum();
        Some(Integral { value: self.seen(value), error: known + error, evaluations: self.of.evaluations })
    }

    /// What is seen, given the sum over the cells.
    fn seen(&self, sum: f64) -> f64 {
        self.unhidden.map_or(sum, |unhidden| unhidden.value - sum).max(0.0)
    }

    /// Cuts a piece of the source at events, and integrates over what comes of it.
    fn begin(&mut self, piece: &[DVec3]) {
        if !self.of.occluders.is_empty() && self.is_done_uncut(piece) {
            return;
        }
        let least = self.tolerance * UNCUT;
        let mut coarse: Vec<(Cell, u32)> = Vec::new();
        let patch = Patch::of(piece);
        if patch.corners().len() < piece.len() || !self.cut(patch, least) {
            coarse.extend(fan(piece).into_iter().map(|cell| (cell, BLIND_HALVINGS)));
        }
        while let Some((cell, halvings)) = coarse.pop() {
            if self.cut(Patch::of(&cell), least) {
                continue;
            }
            if halvings > 0 {
                coarse.extend(halves(cell).map(|half| (half, halvings - 1)));
            } else {
                self.add(cell, None, 2, None);
            }
        }
    }

    /// Integrates over a piece of the source without cuts, if rules of few nodes are good enough for that.
    fn is_done_uncut(&mut self, piece: &[DVec3]) -> bool {
        let Some(cells) = self.uncut(piece) else { return false };
        for planned in cells {
            let Planned { cell, order, error } = planned;
            let view = self.of.view(&cell, false);
            let sum = self.of.product(&cell, order, &view);
            // Gaps between several occluders may open in between nodes; past one, what is dark is convex.
            let may_gap =
                sum.is_dark && self.of.occluders.len() > 1 && error < self.scale * area(&cell) / self.size;
            let unseen = if may_gap { self.of.unseen(&cell) } else { 0.0 };
            self.open.push(Open {
                order,
                value: sum.value,
                error: error.max(unseen),
                ..Open::over(cell, None)
            });
        }
        true
    }

    /// Cells of a piece and rules that are good enough without cuts, if they take few nodes.
    fn uncut(&self, piece: &[DVec3]) -> Option<Vec<Planned>> {
        let share = |cell: &Cell| area(cell) / self.size;
        let errors = |cell: &Cell| {
            let each = self.of.errors_uncut(cell, self.scale / self.size);
            each.map(|error| self.scale * share(cell) * error)
        };
        let most_nodes = FEW_NODES * self.of.occluders.len().pow(2);
        plan(fan(piece), [self.tolerance, self.scale], most_nodes, share, errors)
    }

    /// Integrates over a patch cut at all events, but for those that change less than `least` there, or some times that if there are too
    /// many parts; whether they are few enough.
    fn cut(&mut self, patch: Patch, least: f64) -> bool {
        let (events, are_all) = self.of.events(&patch);
        let parts = LEAVE_OUT.iter().find_map(|more| cut(patch, &events, self.most, more * least));
        let Some(parts) = parts.filter(|_| are_all) else { return false };
        for (part, left_out) in parts {
            let size = part.area();
            for cell in fan(part.corners()) {
                let left_out = if left_out > 0.0 { left_out * area(&cell) / size } else { 0.0 };
                self.add(cell, Some(left_out), 0, None);
            }
        }
        true
    }

    /// Integrates over a cell with the cheapest rule from `least` on that seems good enough.
    fn add(&mut self, cell: Cell, left_out: Option<f64>, least: usize, known: Option<(f64, [f64; 3])>) {
        if area(&cell) == 0.0 {
            return;
        }
        let view = self.of.view(&cell, left_out.is_some());
        let mut open = Open::over(cell, left_out);
        if view.focus != self.of.adds_nothing() {
            let share = area(&cell) / self.size;
            let allowed = self.tolerance * (share / 2.0).max(START);
            let a_priori = |order| share * self.scale * a_priori(&view, order);
            open.order = (least..FINE).find(|order| a_priori(*order) <= allowed).unwrap_or(FINE.max(least));
            open.error = a_priori(open.order);
            open.is_rough = open.order < ROUGH && view.focus == Focus::Part && left_out.is_some();
            let is_dark = if open.order < FINE {
                self.by_few(&mut open, &view)
            } else {
                self.by_many(&mut open, &view, known)
            };
            if is_dark && (self.of.is_skew() || !view.is_cut) {
                open.error = open.error.max(self.of.unseen(&cell));
            }
            if !view.is_cut {
                // Shadows may begin in between nodes.
                let errors = self.of.errors_uncut(&cell, self.scale / self.size);
                open.error = open.error.max(share * self.scale * errors[open.order]);
            }
        }
        open.error += left_out.unwrap_or(0.0);
        self.open.push(open);
    }

    /// The integral over a cell by a rule of few nodes, to whose error belongs what one more node a side changes nearby or where
    /// shadows overlap; whether no node sees anything.
    fn by_few(&mut self, open: &mut Open, view: &CellView) -> bool {
        let sum = self.of.product(&open.cell, open.order, view);
        open.value = sum.value;
        if sum.is_joint || view.apart < CLOSE {
            open.value = self.of.product(&open.cell, open.order + 1, view).value;
            open.error = open.error.max((open.value - sum.value).abs());
        }
        sum.is_dark
    }

    /// The integral over a cell by a fine rule, after three before it or after the one that is known with its constants; whether no
    /// node sees anything.
    fn by_many(&mut self, open: &mut Open, view: &CellView, known: Option<(f64, [f64; 3])>) -> bool {
        let smoothness = self.of.smoothness(&open.cell, view);
        let first = if known.is_some() { open.order } else { open.order - 2 };
        (open.value, open.constants) =
            known.unwrap_or_else(|| (self.of.product(&open.cell, first - 1, view).value, [0.0; 3]));
        let mut is_dark = false;
        for order in first..=open.order {
            let sum = self.of.product(&open.cell, order, view);
            open.constants.rotate_left(1);
            open.constants[2] = (sum.value - open.value).abs() / smoothness.rate(order - 1);
            (open.value, is_dark) = (sum.value, sum.is_dark);
        }
        let constant = SURE * open.constants.into_iter().fold(0.0, f64::max);
        open.error = constant * smoothness.rate(open.order);
        open.last = constant * smoothness.rate(RULES.len() - 1);
        is_dark
    }

    /// Makes cuts that were left out, or takes a finer rule where the integrand is smooth and there is one, else two halves.
    fn refine(&mut self, worst: &Open) {
        let Some(left_out) = worst.left_out else {
            for half in halves(worst.cell) {
                if !self.cut(Patch::of(&half), self.tolerance * UNCUT) {
                    self.add(half, None, 2, None);
                }
            }
            return;
        };
        if 2.0 * left_out > worst.error && self.cut(Patch::of(&worst.cell), left_out * UNCUT) {
            return;
        }
        let is_near = worst.last <= self.tolerance * (area(&worst.cell) / self.size).max(START);
        if worst.order < FINE || (worst.order + 1 < RULES.len() && is_near) {
            let known = (worst.order >= FINE).then_some((worst.value, worst.constants));
            self.add(worst.cell, Some(left_out), worst.order + 1, known);
            return;
        }
        for half in halves(worst.cell) {
            let share = area(&half) / area(&worst.cell);
            self.add(half, Some(left_out * share), 2, None);
        }
    }
}
