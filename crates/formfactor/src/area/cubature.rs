//! Pairs that are hidden in part: cubature on cells that are cut where the view changes its shape.
use super::events::{cut, events};
use super::pair::{Allowed, Integral};
use super::point::{Eye, Seen};
use crate::numeric::gauss::{GAUSS_4, RULE_1, RULE_2, RULE_3, RULE_6};
use crate::scene::occluder::{Face, Occluder};
use crate::scene::surfaces::{Owner, Surface, area as area_of};
use crate::shapes::cell::{Cell, area, fan, halves, nodes};
use glam::DVec3;
use std::{cmp::Ordering, collections::BinaryHeap};

/// The form factor from the points of a source to a target.
#[derive(Debug)]
pub(super) struct Cubature<'p> {
    normal: DVec3,
    /// What of the two is before the other's plane.
    source: Vec<Vec<DVec3>>,
    target: Vec<Vec<DVec3>>,
    to: &'p Surface,
    occluders: &'p [Occluder],
    /// Whether occluders of more than one owner may leave gaps between them.
    is_joint: bool,
    eye: &'p mut Eye,
    size: f64,
    /// The integral with nothing in between, roughly.
    whole: f64,
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
    /// Whether all events were cut, and its rule's place in the list.
    is_smooth: bool,
    order: usize,
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
const RULES: [(&[[f64; 2]], i32); 5] = [(&RULE_1, 1), (&RULE_2, 2), (&RULE_3, 3), (&GAUSS_4, 4), (&RULE_6, 6)];

/// A rule of n nodes a side errs by this times the 2n-th power of the cell's radius over the distance to what it looks at.
const ERROR: f64 = 0.5;

/// At most so many pieces by events; a cell is halved so often before they are given up.
const MOST_CUTS: usize = 64;
const BLIND_HALVINGS: u32 = 4;

impl<'p> Cubature<'p> {
    pub(super) fn new(from: &Surface, to: &'p Surface, owners: &[Owner], occluders: &'p [Occluder], eye: &'p mut Eye) -> Self {
        let source = before(&from.pieces, to.face);
        let size = source.iter().map(|piece| area_of(piece)).sum();
        Self {
            normal: from.face[1],
            source,
            target: before(&to.pieces, from.face),
            to,
            occluders,
            is_joint: owners.windows(2).any(|pair| pair[0] != pair[1]),
            eye,
            size,
            whole: 0.0,
            value: 0.0,
            error: 0.0,
            open: BinaryHeap::new(),
            evaluations: 0,
            count: 0,
        }
    }

    pub(super) fn integrate(mut self, allowed: &Allowed, is_cancelled: &(impl Fn() -> bool + ?Sized)) -> Option<Integral> {
        if self.source.is_empty() || self.target.is_empty() {
            return Some(Integral::default());
        }
        self.whole = self.unhidden() * self.size;
        let whole = self.whole;
        let tolerance = allowed.error(0.0, whole);
        for piece in std::mem::take(&mut self.source) {
            self.begin(piece, whole, tolerance);
        }
        while self.evaluations < allowed.evaluations {
            if is_cancelled() {
                return None;
            }
            let tolerance = allowed.error(self.value, whole);
            if self.error <= tolerance {
                break;
            }
            let Some(worst) = self.open.pop() else { break };
            self.value -= worst.value;
            self.error -= worst.error;
            self.refine(&worst, tolerance);
        }
        let (value, error) = self.sum();
        Some(Integral { value: value.max(0.0), error, evaluations: self.evaluations })
    }

    /// The form factor to the target with nothing in between, from a point of the source.
    fn unhidden(&mut self) -> f64 {
        let corners = &self.source[0];
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        self.eye.look(middle, self.normal, &self.target, &[]).whole
    }

    /// Cuts a piece of the source at events, and integrates over what comes of it.
    fn begin(&mut self, piece: Vec<DVec3>, whole: f64, tolerance: f64) {
        let mut coarse = vec![(piece, BLIND_HALVINGS)];
        while let Some((piece, halvings)) = coarse.pop() {
            let share = area_of(&piece) / self.size;
            let (events, are_all) = events(&piece, &self.target, self.occluders);
            let worth = |part: f64| {
                let part = part / self.size;
                4.0 * part * part * whole > tolerance * share.min(1.0)
            };
            match cut(piece.clone(), &events, MOST_CUTS, worth) {
                Some(parts) if are_all => {
                    let cells: Vec<Cell> = parts.iter().flat_map(|part| fan(part)).collect();
                    cells.into_iter().for_each(|cell| self.add(cell, whole, tolerance, true, 0));
                }
                _ if halvings > 0 => {
                    let parts = fan(&piece).into_iter().flat_map(halves);
                    coarse.extend(parts.map(|part| (part.to_vec(), halvings - 1)));
                }
                _ => fan(&piece).into_iter().for_each(|cell| self.add(cell, whole, tolerance, false, 2)),
            }
        }
    }

    /// How far it is at least to what a cell looks at, by the cell's radius.
    fn ratio(&self, cell: &Cell) -> f64 {
        let middle = (cell[0] + cell[1] + cell[2] + cell[3]) / 4.0;
        let radius = cell.iter().map(|p| p.distance_squared(middle)).fold(0.0, f64::max).sqrt();
        let away = |at: DVec3, size: f64| middle.distance(at) - size;
        let above = |[on, normal]: &Face| normal.dot(middle - *on);
        let to_target = away(self.to.middle, self.to.radius).max(above(&self.to.face));
        let to_occluder = |o: &Occluder| {
            let plane = o.faces.iter().map(above).fold(f64::NEG_INFINITY, f64::max);
            away(o.middle, o.radius).max(plane)
        };
        let nearest = self.occluders.iter().map(to_occluder).fold(to_target, f64::min);
        radius / nearest.max(radius / 4.0)
    }

    /// Integrates over a cell with the cheapest rule from `least` on that seems good enough.
    fn add(&mut self, cell: Cell, whole: f64, tolerance: f64, is_smooth: bool, least: usize) {
        let share = area(&cell) / self.size;
        if share == 0.0 {
            return;
        }
        let ratio = self.ratio(&cell);
        let a_priori = |order: usize| ERROR * share * whole * ratio.powi(2 * RULES[order].1);
        let order = (least..RULES.len()).find(|order| a_priori(*order) <= tolerance * share / 2.0);
        let order = order.unwrap_or(least.max(2));
        let (mut value, seen) = self.product(&cell, RULES[order].0);
        let mut error = a_priori(order);
        if seen.is_joint || !is_smooth || ratio > 0.5 {
            let (finer, _) = self.product(&cell, RULES[(order + 1).min(4)].0);
            error = error.min(value.max(finer)).max((finer - value).abs());
            value = finer;
        }
        if self.is_joint && seen.whole - seen.hidden <= 1e-13 * seen.whole {
            error = error.max(self.unseen(&cell));
        }
        self.value += value;
        self.error += error;
        self.count += 1;
        self.open.push(Open { cell, value, error, is_smooth, order, number: self.count });
    }

    /// What some of a cell might see though its nodes do not.
    fn unseen(&mut self, cell: &Cell) -> f64 {
        let corners = if cell[2] == cell[3] { &cell[..3] } else { &cell[..] };
        self.eye.left_open(corners, self.normal, &self.target, self.occluders) * area(cell)
    }

    fn product(&mut self, cell: &Cell, rule: &[[f64; 2]]) -> (f64, Seen) {
        let mut all = Seen::default();
        let mut value = 0.0;
        for (point, weight) in nodes(cell, rule) {
            let seen = self.eye.look(point, self.normal, &self.target, self.occluders);
            value += weight * (seen.whole - seen.hidden);
            all.whole += seen.whole;
            all.hidden += seen.hidden;
            all.is_joint |= seen.is_joint;
            self.evaluations += 1;
        }
        (value, all)
    }

    fn refine(&mut self, worst: &Open, tolerance: f64) {
        let whole = self.whole;
        for half in halves(worst.cell) {
            if worst.is_smooth {
                self.add(half, whole, tolerance, true, worst.order.min(2));
            } else {
                let (events, are_all) = events(&half, &self.target, self.occluders);
                match cut(half.to_vec(), &events, MOST_CUTS, |part| part > 1e-9 * self.size) {
                    Some(parts) if are_all => {
                        let cells: Vec<Cell> = parts.iter().flat_map(|part| fan(part)).collect();
                        cells.into_iter().for_each(|cell| self.add(cell, whole, tolerance, true, worst.order.min(2)));
                    }
                    _ => self.add(half, whole, tolerance, false, worst.order.min(2)),
                }
            }
        }
    }

    /// The cells in the order in which they came about.
    fn sum(&self) -> (f64, f64) {
        let mut parts: Vec<(usize, f64)> = self.open.iter().map(|open| (open.number, open.value)).collect();
        parts.sort_unstable_by_key(|part| part.0);
        (parts.iter().map(|part| part.1).sum(), self.open.iter().map(|open| open.error).sum())
    }
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
