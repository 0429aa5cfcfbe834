//! Pairs that are hidden in part: cubature on cells that are cut where the view changes its shape.
use super::events::{Patch, cut, events};
use super::integral::{Allowed, Integral, least_whole};
use super::point::{Eye, Focus, Near, Seen};
use crate::numeric::gauss::{RULE_1, RULE_2, RULE_3, RULE_4, RULE_6, RULE_8, RULE_12};
use crate::scene::occluder::Face;
use crate::scene::surfaces::{Surface, area as area_of};
use crate::shapes::cell::{Cell, area, fan, halves, nodes};
use glam::DVec3;
use std::{cmp::Ordering, collections::BinaryHeap, f64::consts::PI};

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
    is_skew: bool,
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
    open: BinaryHeap<Open>,
    /// The sums over the open cells.
    value: f64,
    error: f64,
    evaluations: u64,
    count: usize,
}

/// A cell to be refined, the one with the largest error first.
#[derive(Debug)]
struct Open {
    cell: Cell,
    value: f64,
    error: f64,
    /// What cuts that were not made may change, if events were cut.
    left_out: Option<f64>,
    /// Its rule's place in the list.
    order: usize,
    /// The values by the rule before and by this one, where this one is fine.
    values: [f64; 2],
    /// What the finest rule may leave.
    last: f64,
    number: usize,
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        self.error.total_cmp(&other.error).then(other.number.cmp(&self.number))
    }
}

/// Rules by order.
const RULES: [&[[f64; 2]]; 7] = [&RULE_1, &RULE_2, &RULE_3, &RULE_4, &RULE_6, &RULE_8, &RULE_12];

/// From this place on differences to the two rules before say what a rule may err by.
const FINE: usize = 4;

/// What a rule may err by on a cell, as a share of what it were with nothing in between, by the cell's radius over the distance to what it looks at.
///
/// What is hidden in part is a polynomial of degree 2 where planes are parallel and nearly one elsewhere: each order more
/// takes away one or two digits. The constants are three times the errors that 99 of 100 cells stayed below.
fn error(focus: Focus, order: usize, ratio: f64) -> f64 {
    if focus == Focus::Part {
        return [0.3, 0.06 * ratio, 3e-3 * ratio.powi(2), 3e-4 * ratio.powi(3), 3e-6 * ratio.powi(4)]
            [order.min(FINE)];
    }
    // A single node says little where a plane cuts the polygons off.
    if order == 0 { 5.0 * ratio * ratio } else { ratio.powi(2 * [1, 2, 3, 4, 6, 8, 12][order]) }
}

/// What a fine rule leaves, by its value and those of the two rules before.
///
/// Where the integrand is analytic at all points of an ellipse around the foci -1 and 1 with semiaxes that add to r, n nodes err by less than
/// C r^(-2n) [Trefethen, Approximation Theory and Approximation Practice, theorem 19.3]. So each difference says what C is, as
/// that of the coarser one's error; the larger counts, as one alone may be small by chance, eight times.
fn left(values: [f64; 3], order: usize, rate: impl Fn(usize, usize) -> f64) -> f64 {
    let beyond = |before: usize| rate(before, order);
    let [coarse, middle, fine] = values;
    SURE * ((middle - coarse).abs() * beyond(order - 2)).max((fine - middle).abs() * beyond(order - 1))
}

/// The same where shadows' edges may cross on an edge: there three edges seem to meet, and along a curve the integrand's second
/// derivatives jump. A jump in the k-th derivative leaves errors that fall as n^-(k + 1) [the same, theorem 7.2].
fn rate_of_bends(before: usize, order: usize) -> f64 {
    (RULES[before].len() as f64 / RULES[order].len() as f64).powi(3)
}

/// What a rule leaves of the error of one before, by how far a cell is from what it looks at.
fn rate(apart: f64, before: usize, order: usize) -> f64 {
    let step = (apart + apart.hypot(1.0)).powi(-2);
    step.powi(i32::try_from(RULES[order].len() - RULES[before].len()).unwrap_or(i32::MAX))
}

/// By so much what differences say is raised.
const SURE: f64 = 8.0;

/// The share of the tolerance that any cut which is not made may take.
const UNCUT: f64 = 1e-3;

/// The share of the tolerance that any cell may take at first.
const START: f64 = 0.1;

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
            is_skew: are_skew(to, occluders),
            most: most(from, to),
            eye,
            size,
            unhidden: None,
            whole: 0.0,
            scale: 0.0,
            least: least_whole(from, to),
            tolerance: 0.0,
            value: 0.0,
            error: 0.0,
            open: BinaryHeap::new(),
            evaluations: 0,
            count: 0,
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
        self.error = unhidden.map_or(0.0, |unhidden| unhidden.error);
        self.tolerance = allowed.error(self.whole, self.whole.max(self.least));
        for piece in std::mem::take(&mut self.source) {
            self.begin(&piece);
        }
        while self.evaluations < allowed.evaluations {
            if is_cancelled() {
                return None;
            }
            self.tolerance = allowed.error(self.seen(self.value), self.whole.max(self.least));
            if self.error <= self.tolerance {
                break;
            }
            if self.open.peek().is_none_or(|worst| worst.error == 0.0) {
                break;
            }
            let Some(worst) = self.open.pop() else { break };
            self.value -= worst.value;
            self.error -= worst.error;
            self.refine(&worst);
        }
        let (value, error) = self.sum();
        Some(Integral { value: self.seen(value), error, evaluations: self.evaluations })
    }

    /// What is seen, given the sum over the cells.
    fn seen(&self, sum: f64) -> f64 {
        self.unhidden.map_or(sum, |unhidden| unhidden.value - sum).max(0.0)
    }

    /// The form factor to the target with nothing in between, from a point of the source.
    fn middling(&mut self) -> f64 {
        let corners = &self.source[0];
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        self.eye.look(middle, self.normal, &self.target, &[]).whole
    }

    /// Cuts a piece of the source at events, and integrates over what comes of it.
    fn begin(&mut self, piece: &[DVec3]) {
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

    /// How far a cell is at least from what it looks at, by half of its longest side.
    fn apart(&self, cell: &Cell) -> f64 {
        let middle = (cell[0] + cell[1] + cell[2] + cell[3]) / 4.0;
        let radius = cell.iter().map(|p| p.distance_squared(middle)).fold(0.0, f64::max).sqrt();
        let away = |at: DVec3, size: f64| middle.distance(at) - size - radius;
        let above =
            |[on, normal]: &Face| cell.iter().map(|p| normal.dot(*p - *on)).fold(f64::INFINITY, f64::min);
        let to_target = away(self.to.middle, self.to.radius).max(above(&self.to.face));
        let to_occluder = |o: &Near| {
            let plane = o.faces.iter().map(above).fold(f64::NEG_INFINITY, f64::max);
            away(o.middle, o.radius).max(plane)
        };
        let nearest = self.occluders.iter().map(to_occluder).fold(to_target, f64::min);
        let sides = cell.iter().zip(cell.iter().cycle().skip(1)).map(|(a, b)| a.distance(*b));
        2.0 * nearest.max(0.0) / sides.fold(0.0, f64::max)
    }

    /// Integrates over a cell with the cheapest rule from `least` on that seems good enough.
    fn add(&mut self, cell: Cell, left_out: Option<f64>, least: usize, known: Option<[f64; 2]>) {
        let is_smooth = left_out.is_some();
        let share = area(&cell) / self.size;
        if share == 0.0 {
            return;
        }
        let focus = if is_smooth { self.eye.focus(&cell, &self.target, self.occluders) } else { Focus::Part };
        if focus == self.adds_nothing() {
            let error = left_out.unwrap_or(0.0);
            let values = [0.0; 2];
            self.push(Open { cell, value: 0.0, error, left_out, order: 0, values, last: 0.0, number: 0 });
            return;
        }
        let apart = if is_smooth { self.apart(&cell) } else { 0.0 };
        let ratio = 1.0 / apart.max(0.25);
        let allowed = self.tolerance * (share / 2.0).max(START);
        let flat = if cell[2] == cell[3] { 1.0 / ratio.min(1.0) } else { 1.0 };
        let a_priori = |order: usize| flat * share * self.scale * error(focus, order, ratio);
        let order = (least..FINE).find(|order| a_priori(*order) <= allowed).unwrap_or(FINE.max(least));
        let mut error = a_priori(order);
        let (mut value, seen) = self.product(&cell, order, focus, is_smooth);
        let (mut values, mut last) = ([value; 2], 0.0);
        if order >= FINE {
            let [coarse, middle] = known
                .unwrap_or_else(|| [2, 1].map(|back| self.product(&cell, order - back, focus, is_smooth).0));
            values[0] = middle;
            let may_bend = self.is_skew && self.eye.shadows_cross(&cell);
            let rate = |before, order| if may_bend { rate_of_bends(before, order) } else { rate(apart, before, order) };
            error = left([coarse, middle, value], order, rate);
            last = error * rate(order, RULES.len() - 1);
        } else if seen.is_joint || !is_smooth || ratio > 0.5 {
            let (finer, _) = self.product(&cell, order + 1, focus, is_smooth);
            error = error.max((finer - value).abs());
            value = finer;
        }
        let is_dark = focus == Focus::Part && seen.whole - seen.hidden <= 1e-13 * seen.whole;
        if is_dark && (self.is_skew || !is_smooth) {
            error = error.max(self.unseen(&cell));
        }
        error += left_out.unwrap_or(0.0);
        self.push(Open { cell, value, error, left_out, order, values, last, number: 0 });
    }

    /// What a cell must see to add nothing.
    fn adds_nothing(&self) -> Focus {
        if self.unhidden.is_some() { Focus::All } else { Focus::Nothing }
    }

    fn push(&mut self, mut cell: Open) {
        self.value += cell.value;
        self.error += cell.error;
        self.count += 1;
        cell.number = self.count;
        self.open.push(cell);
    }

    /// What some of a cell might see though its nodes do not.
    fn unseen(&mut self, cell: &Cell) -> f64 {
        let corners = if cell[2] == cell[3] { &cell[..3] } else { &cell[..] };
        self.eye.left_open(corners, self.normal, &self.target, self.occluders) * area(cell)
    }

    /// The integral by a rule: of what is hidden where the rest is known, else of what is seen.
    fn product(&mut self, cell: &Cell, order: usize, focus: Focus, is_smooth: bool) -> (f64, Seen) {
        let is_split = self.unhidden.is_some();
        let part = |seen: Seen| match (focus, is_split) {
            (Focus::Part, true) => seen.hidden,
            (Focus::Part, false) => seen.whole - seen.hidden,
            _ => seen.whole,
        };
        let mut all = Seen::default();
        let mut value = 0.0;
        for (point, weight) in nodes(cell, RULES[order]) {
            let seen = if is_smooth {
                self.eye.look_past(point, self.normal, &self.target, self.occluders)
            } else {
                self.eye.look(point, self.normal, &self.target, self.occluders)
            };
            value += weight * part(seen);
            all.whole += seen.whole;
            all.hidden += seen.hidden;
            all.is_joint |= seen.is_joint;
            self.evaluations += 1;
        }
        (value, all)
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
            let known = (worst.order >= FINE).then_some(worst.values);
            self.add(worst.cell, Some(left_out), worst.order + 1, known);
            return;
        }
        halves(worst.cell).into_iter().for_each(|half| self.add(half, Some(left_out), 2, None));
    }

    /// The cells in the order in which they came about.
    fn sum(&self) -> (f64, f64) {
        let mut parts: Vec<(usize, f64)> = self.open.iter().map(|open| (open.number, open.value)).collect();
        parts.sort_unstable_by_key(|part| part.0);
        let error: f64 = self.open.iter().map(|open| open.error).sum();
        (parts.iter().map(|part| part.1).sum(), error + self.unhidden.map_or(0.0, |unhidden| unhidden.error))
    }
}

/// Whether edges run in three directions or more, with three convex shapes at least to have them.
///
/// What is seen begins as a point where a vertex meets an edge, or where edges of three shapes meet, or all along edges in one plane,
/// where vertices meet edges too.
fn are_skew(to: &Surface, occluders: &[Near]) -> bool {
    let mut known: Vec<DVec3> = Vec::new();
    let of_occluders = occluders.iter().flat_map(|o| o.ridges.iter().map(|ridge| ridge.ends));
    for [a, b] in of_occluders.chain(to.edges.iter().copied()) {
        let way = (b - a).normalize_or_zero();
        if known.iter().all(|other| other.cross(way).length_squared() > PARALLEL * PARALLEL) {
            known.push(way);
        }
    }
    occluders.len() > 1 && known.len() > 2
}

/// Edges count as parallel up to this sine of their angle.
const PARALLEL: f64 = 1e-9;

/// What no point factor from one surface to the other exceeds, by its size and the distance.
fn most(one: &Surface, other: &Surface) -> f64 {
    let away = one.middle.distance(other.middle) - one.radius - other.radius;
    let above = |from: &Surface, to: &Surface| to.face[1].dot(from.middle - to.face[0]) - from.radius;
    let away = away.max(above(one, other));
    if away > 0.0 { (other.area / (PI * away * away)).min(1.0) } else { 1.0 }
}

/// The parts of convex polygons before a plane.
fn before(pieces: &[Vec<DVec3>], [on, normal]: Face) -> Vec<Vec<DVec3>> {
    let height = |p: &DVec3| normal.dot(*p - on);
    let part = |piece: &Vec<DVec3>| {
        let mut kept = Vec::with_capacity(piece.len() + 1);
        for (a, b) in piece.iter().zip(piece.iter().cycle().skip(1)) {
            let (here, there) = (height(a), height(b));
            if here >= 0.0 {
                kept.push(*a);
            }
            if (here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0) {
                kept.push(*a + (*b - *a) * (here / (here - there)));
            }
        }
        kept
    };
    pieces.iter().map(part).filter(|kept| kept.len() > 2).collect()
}
