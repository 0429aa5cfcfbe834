//! Pairs that are hidden in part: cubature on cells that are cut where the view changes its shape.
use super::clip::before;
use super::estimate::{CellView, FINE, RULES, SURE, Smoothness, a_priori};
use super::events::{are_skew, cut, events};
use super::integral::{Allowed, Integral, least_whole, most};
use super::patch::Patch;
use super::point::{Eye, Focus, Near, Seen};
use super::queue::{Open, Queue};
use super::uncut::{self, away_from, away_from_surface, fair_share, slopes};
use crate::scene::surfaces::{Surface, area as area_of};
use crate::shapes::cell::{Cell, area, fan, halves, nodes};
use glam::DVec3;
use std::cell::OnceCell;

/// The form factor from the points of a source to a target.
#[derive(Debug)]
pub(super) struct Cubature<'p> {
    normal: DVec3,
    /// What of the two is before the other's plane.
    source: Vec<Vec<DVec3>>,
    target: Vec<Vec<DVec3>>,
    to: &'p Surface,
    occluders: &'p [Near<'p>],
    /// Whether three edges in three directions may open a gap where no vertex is.
    is_skew: OnceCell<bool>,
    /// No point of the source has a larger factor to the target.
    most: f64,
    eye: &'p mut Eye,
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
    evaluations: u64,
}

/// What a rule says about a cell.
struct OnCell {
    value: f64,
    /// Whether shadows overlap.
    is_joint: bool,
    /// Whether no node sees anything.
    is_dark: bool,
}

/// The share of the tolerance that any cut which is not made may take.
const UNCUT: f64 = 1e-3;

/// The share of the tolerance that any cell may take at first.
const START: f64 = 0.1;

/// A rule of few nodes is checked by the next where a cell is so close to what it looks at, in halves of its longest side.
const CLOSE: f64 = 2.0;

/// Past one occluder cuts are not made where rules take so few nodes without; past more so many times the square of their number.
const FEW_NODES: usize = 64;

/// Into so many cells a piece is halved where it is not cut.
const MOST_CELLS: usize = 16;

/// What no node sees more of than this share counts as nothing: roundings of what is hidden.
const DARK: f64 = 1e-13;

/// A cell is halved so often before cuts by events are given up.
const BLIND_HALVINGS: u32 = 4;

impl<'p> Cubature<'p> {
    pub(super) fn new(from: &Surface, to: &'p Surface, occluders: &'p [Near<'p>], eye: &'p mut Eye) -> Self {
        let source = before(&from.pieces, to.face);
        let size = source.iter().map(|piece| area_of(piece)).sum();
        Self {
            normal: from.face[1],
            source,
            target: before(&to.pieces, from.face),
            to,
            occluders,
            is_skew: OnceCell::new(),
            most: most(from, to),
            eye,
            size,
            unhidden: None,
            whole: 0.0,
            scale: 0.0,
            least: least_whole(from, to),
            tolerance: 0.0,
            open: Queue::default(),
            evaluations: 0,
        }
    }

    /// The integral. `unhidden` is what it were with nothing in between, if that is known.
    pub(super) fn integrate(
        mut self,
        unhidden: Option<Integral>,
        allowed: &Allowed,
        is_cancelled: &(impl Fn() -> bool + ?Sized),
    ) -> Option<Integral> {
        if self.source.is_empty() || self.target.is_empty() {
            return Some(Integral::default());
        }
        self.unhidden = unhidden;
        self.whole = unhidden.map_or_else(|| self.middling() * self.size, |unhidden| unhidden.value);
        // Where planes cut the polygons off, what the middle sees says little.
        self.scale = if unhidden.is_some() { self.whole } else { self.whole.max(8.0 * self.least) };
        let known = unhidden.map_or(0.0, |unhidden| unhidden.error);
        let whole = self.whole.max(self.least);
        self.tolerance = allowed.error(self.whole, whole);
        for piece in std::mem::take(&mut self.source) {
            self.begin(&piece);
        }
        while self.evaluations < allowed.evaluations {
            if is_cancelled() {
                return None;
            }
            self.tolerance = allowed.error(self.seen(self.open.value), whole);
            if known + self.open.error <= self.tolerance {
                break;
            }
            let Some(worst) = self.open.pop() else { break };
            self.refine(&worst);
        }
        let (value, error) = self.open.sum();
        Some(Integral { value: self.seen(value), error: known + error, evaluations: self.evaluations })
    }

    /// What is seen, given the sum over the cells.
    fn seen(&self, sum: f64) -> f64 {
        self.unhidden.map_or(sum, |unhidden| unhidden.value - sum).max(0.0)
    }

    fn is_skew(&self) -> bool {
        *self.is_skew.get_or_init(|| are_skew(self.to, self.occluders))
    }

    /// The form factor to the target with nothing in between, from a point of the source.
    fn middling(&mut self) -> f64 {
        let corners = &self.source[0];
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        self.eye.look(middle, self.normal, &self.target, &[]).whole
    }

    /// Cuts a piece of the source at events, and integrates over what comes of it.
    fn begin(&mut self, piece: &[DVec3]) {
        if !self.occluders.is_empty() && self.is_done_uncut(piece) {
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
        let mut found = Vec::with_capacity(cells.len());
        for (cell, order, error) in cells {
            let view = self.view(&cell, false);
            let sum = self.product(&cell, order, &view);
            // Gaps between several occluders may open in between nodes; past one, what is dark is convex.
            let may_gap = sum.is_dark && self.occluders.len() > 1;
            let unseen = if may_gap { self.unseen(&cell) } else { 0.0 };
            found.push(Open { order, value: sum.value, error: error.max(unseen), ..Open::over(cell, None) });
        }
        let error: f64 = found.iter().map(|open| open.error).sum();
        let is_good = error <= self.tolerance * area_of(piece) / self.size;
        if is_good {
            found.into_iter().for_each(|open| self.open.push(open));
        }
        is_good
    }

    /// Cells of a piece with rules that are good enough without cuts, and what they may err by, if they take few nodes.
    fn uncut(&self, piece: &[DVec3]) -> Option<Vec<(Cell, usize, f64)>> {
        let mut left = FEW_NODES * self.occluders.len().pow(2);
        let mut coarse = fan(piece);
        let mut found = Vec::with_capacity(coarse.len());
        while let Some(cell) = coarse.pop() {
            if let Some((order, error)) = self.rule_uncut(&cell) {
                left = left.checked_sub(RULES[order].len().pow(2))?;
                found.push((cell, order, error));
            } else if coarse.len() + found.len() < MOST_CELLS {
                coarse.extend(halves(cell));
            } else {
                return None;
            }
        }
        Some(found)
    }

    /// The cheapest rule that is good enough on a cell without cuts, if any, and what it may err by.
    fn rule_uncut(&self, cell: &Cell) -> Option<(usize, f64)> {
        let share = area(cell) / self.size;
        let [skewness, apart] = self.shape(cell);
        let view = CellView { focus: Focus::Part, is_cut: false, skewness, apart };
        let slopes = slopes(cell, self.to, self.occluders);
        let errors = (0..RULES.len()).map(|order| self.scale * uncut::error(&view, slopes, order));
        let mut rules = errors.enumerate();
        let (order, error) = rules.find(|(order, error)| *error <= self.tolerance * fair_share(*order))?;
        Some((order, share * error))
    }

    /// Integrates over a patch cut at all events, but for those that change less than `least` there; whether they are few enough.
    fn cut(&mut self, patch: Patch, least: f64) -> bool {
        let (events, are_all) = events(&patch, &self.target, self.occluders);
        let Some(parts) = cut(patch, &events, self.most, least).filter(|_| are_all) else { return false };
        for (part, left_out) in parts {
            let size = part.area();
            for cell in fan(part.corners()) {
                let left_out = if left_out > 0.0 { left_out * area(&cell) / size } else { 0.0 };
                self.add(cell, Some(left_out), 0, None);
            }
        }
        true
    }

    /// How far a cell is at least from what it looks at.
    fn away(&self, cell: &Cell) -> f64 {
        let to_occluders = self.occluders.iter().map(|occluder| away_from(occluder, cell));
        to_occluders.fold(away_from_surface(self.to, cell), f64::min)
    }

    /// Integrates over a cell with the cheapest rule from `least` on that seems good enough.
    fn add(&mut self, cell: Cell, left_out: Option<f64>, least: usize, known: Option<(f64, [f64; 3])>) {
        if area(&cell) == 0.0 {
            return;
        }
        let view = self.view(&cell, left_out.is_some());
        let mut open = Open::over(cell, left_out);
        if view.focus != self.adds_nothing() {
            let share = area(&cell) / self.size;
            let allowed = self.tolerance * (share / 2.0).max(START);
            let a_priori = |order| share * self.scale * a_priori(&view, order);
            open.order = (least..FINE).find(|order| a_priori(*order) <= allowed).unwrap_or(FINE.max(least));
            open.error = a_priori(open.order);
            let is_dark = if open.order < FINE {
                self.by_few(&mut open, &view)
            } else {
                self.by_many(&mut open, &view, known)
            };
            if is_dark && (self.is_skew() || !view.is_cut) {
                open.error = open.error.max(self.unseen(&cell));
            }
        }
        open.error += left_out.unwrap_or(0.0);
        self.open.push(open);
    }

    /// How a cell sees the target, all events on it cut or not.
    fn view(&mut self, cell: &Cell, is_cut: bool) -> CellView {
        if !is_cut {
            self.eye.face(cell, &self.target, self.occluders);
            return CellView { focus: Focus::Part, is_cut, skewness: 1.0, apart: 0.0 };
        }
        let focus = self.eye.focus(cell, &self.target, self.occluders);
        let [skewness, apart] = self.shape(cell);
        CellView { focus, is_cut, skewness, apart }
    }

    /// How far a cell is from a parallelogram, and from what it looks at.
    fn shape(&self, cell: &Cell) -> [f64; 2] {
        let [a, b, c, d] = *cell;
        let longest = [b - a, c - b, d - c, a - d].map(DVec3::length).into_iter().fold(0.0, f64::max);
        [(a - b + c - d).length() / longest, 2.0 * self.away(cell) / longest]
    }

    /// What a cell must see to add nothing.
    fn adds_nothing(&self) -> Focus {
        if self.unhidden.is_some() { Focus::All } else { Focus::Nothing }
    }

    /// The integral over a cell by a rule of few nodes, to whose error belongs what one more node a side changes nearby or where
    /// shadows overlap; whether no node sees anything.
    fn by_few(&mut self, open: &mut Open, view: &CellView) -> bool {
        let sum = self.product(&open.cell, open.order, view);
        open.value = sum.value;
        if sum.is_joint || view.apart < CLOSE {
            open.value = self.product(&open.cell, open.order + 1, view).value;
            open.error = open.error.max((open.value - sum.value).abs());
        }
        sum.is_dark
    }

    /// The integral over a cell by a fine rule, after three before it or after the one that is known with its constants; whether no
    /// node sees anything.
    fn by_many(&mut self, open: &mut Open, view: &CellView, known: Option<(f64, [f64; 3])>) -> bool {
        let smoothness = self.smoothness(&open.cell, view);
        let first = if known.is_some() { open.order } else { open.order - 2 };
        (open.value, open.constants) =
            known.unwrap_or_else(|| (self.product(&open.cell, first - 1, view).value, [0.0; 3]));
        let mut is_dark = false;
        for order in first..=open.order {
            let sum = self.product(&open.cell, order, view);
            open.constants.rotate_left(1);
            open.constants[2] = (sum.value - open.value).abs() / smoothness.rate(order - 1);
            (open.value, is_dark) = (sum.value, sum.is_dark);
        }
        let constant = SURE * open.constants.into_iter().fold(0.0, f64::max);
        open.error = constant * smoothness.rate(open.order);
        open.last = constant * smoothness.rate(RULES.len() - 1);
        is_dark
    }

    fn smoothness(&self, cell: &Cell, view: &CellView) -> Smoothness {
        if view.is_cut && self.is_skew() && self.eye.shadows_cross(cell) {
            Smoothness::Bends
        } else {
            Smoothness::Analytic { apart: view.apart }
        }
    }

    /// What some of a cell might see though its nodes do not.
    fn unseen(&mut self, cell: &Cell) -> f64 {
        let corners = if cell[2] == cell[3] { &cell[..3] } else { &cell[..] };
        self.eye.left_open(corners, self.normal, &self.target, self.occluders) * area(cell)
    }

    /// The integral by a rule: of what is hidden where the rest is known, else of what is seen.
    fn product(&mut self, cell: &Cell, order: usize, view: &CellView) -> OnCell {
        let is_part = view.focus == Focus::Part;
        let mut sum = OnCell { value: 0.0, is_joint: false, is_dark: is_part };
        for (point, weight) in nodes(cell, RULES[order]) {
            let is_whole_asked = sum.is_dark || !is_part || self.unhidden.is_none();
            let seen = self.eye.look_past(point, self.normal, &self.target, self.occluders, is_whole_asked);
            sum.value += weight * self.part(seen, view.focus);
            sum.is_joint |= seen.is_joint;
            sum.is_dark &= seen.whole - seen.hidden <= DARK * seen.whole;
            self.evaluations += 1;
        }
        sum
    }

    /// What of the factor from a node counts.
    fn part(&self, seen: Seen, focus: Focus) -> f64 {
        match (focus, self.unhidden.is_some()) {
            (Focus::Part, true) => seen.hidden,
            (Focus::Part, false) => seen.whole - seen.hidden,
            _ => seen.whole,
        }
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
