//! The form factor from the points of a source to a target past occluders: what cubature integrates.
use super::clip::before;
use super::estimate::{CellView, RULES, Smoothness};
use super::events::{Event, are_skew, events};
use super::patch::Patch;
use super::plan::Errors;
use super::point::{Eye, Focus, Near, Seen};
use super::uncut::{away_from, away_from_surface, errors};
use crate::numeric::gauss::RULE_2;
use crate::numeric::rounding::rounding_of;
use crate::scene::surfaces::Surface;
use crate::shapes::cell::{Cell, area, fan, nodes};
use glam::DVec3;
use std::cell::OnceCell;

/// The form factor from the points of a source to a target.
#[derive(Debug)]
pub(super) struct Integrand<'p> {
    normal: DVec3,
    /// What of the target is before the source's plane.
    target: Vec<Vec<DVec3>>,
    to: &'p Surface,
    pub(super) occluders: &'p [Near<'p>],
    /// What share of a factor counts as nothing.
    dark: f64,
    /// Whether three edges in three directions may open a gap where no vertex is.
    is_skew: OnceCell<bool>,
    eye: &'p mut Eye,
    /// Whether the integral with nothing in between is known, so that what is hidden is left to be integrated.
    pub(super) is_rest_known: bool,
    pub(super) evaluations: u64,
}

/// What a rule says about a cell.
pub(super) struct OnCell {
    pub(super) value: f64,
    /// Whether shadows overlap.
    pub(super) is_joint: bool,
    /// Whether no node sees anything.
    pub(super) is_dark: bool,
}

/// What no node sees more of than this share counts as nothing: roundings of what is hidden, with those of coordinates by the smaller of
/// the two.
const DARK: f64 = 1e-13;

impl<'p> Integrand<'p> {
    pub(super) fn new(from: &Surface, to: &'p Surface, occluders: &'p [Near<'p>], eye: &'p mut Eye) -> Self {
        Self {
            normal: from.face[1],
            target: before(&to.pieces, from.face),
            to,
            occluders,
            dark: DARK + rounding_of([from.middle, to.middle]) / from.radius.min(to.radius),
            is_skew: OnceCell::new(),
            eye,
            is_rest_known: false,
            evaluations: 0,
        }
    }

    /// Whether nothing of the target is before the source's plane.
    pub(super) fn is_nothing(&self) -> bool {
        self.target.is_empty()
    }

    /// The events on a patch, and whether they are all.
    pub(super) fn events(&self, patch: &Patch) -> (Vec<Event>, bool) {
        events(patch, &self.target, self.occluders)
    }

    /// What rules may err by on a cell without cuts, as a share of what it saw with nothing in between, `mean` by area.
    pub(super) fn errors_uncut(&self, cell: &Cell, mean: f64) -> Errors {
        let [skewness, _] = self.shape(cell);
        let apart = if self.is_rest_known {
            f64::INFINITY
        } else {
            2.0 * away_from_surface(self.to, cell) / longest_side(cell)
        };
        errors(cell, [skewness, apart], mean, self.to, self.occluders)
    }

    pub(super) fn is_skew(&self) -> bool {
        *self.is_skew.get_or_init(|| are_skew(self.to, self.occluders))
    }

    /// The integral over a convex piece of the source with nothing in between, by a rule of few nodes.
    pub(super) fn roughly(&mut self, piece: &[DVec3]) -> f64 {
        let cells = fan(piece);
        let nodes = cells.iter().flat_map(|cell| nodes(cell, &RULE_2));
        nodes.map(|(point, weight)| weight * self.eye.look(point, self.normal, &self.target, &[]).whole).sum()
    }

    /// How far a cell is at least from what it looks at. What is hidden is behind an occluder.
    fn away(&self, cell: &Cell) -> f64 {
        let to_occluders = self.occluders.iter().map(|occluder| away_from(occluder, cell));
        let to_target = if self.is_rest_known { f64::INFINITY } else { away_from_surface(self.to, cell) };
        to_occluders.fold(to_target, f64::min)
    }

    /// How a cell sees the target, all events on it cut or not.
    pub(super) fn view(&mut self, cell: &Cell, is_cut: bool) -> CellView {
        if !is_cut {
            self.eye.face(cell, &self.target, self.occluders);
            return CellView { focus: Focus::Part, is_cut, skewness: 1.0, apart: 0.0 };
        }
        let focus = self.eye.focus(cell, &self.target, self.occluders);
        let [skewness, apart] = self.shape(cell);
        CellView { focus, is_cut, skewness, apart }
    }

    /// How far a cell is from a parallelogram, and from what it looks at.
    pub(super) fn shape(&self, cell: &Cell) -> [f64; 2] {
        let [a, b, c, d] = *cell;
        let longest = longest_side(cell);
        [(a - b + c - d).length() / longest, 2.0 * self.away(cell) / longest]
    }

    /// What a cell must see to add nothing.
    pub(super) fn adds_nothing(&self) -> Focus {
        if self.is_rest_known { Focus::All } else { Focus::Nothing }
    }

    pub(super) fn smoothness(&self, cell: &Cell, view: &CellView) -> Smoothness {
        if view.is_cut && self.is_skew() && self.eye.shadows_cross(cell) {
            Smoothness::Bends
        } else {
            Smoothness::Analytic { apart: view.apart }
        }
    }

    /// What some of a cell might see though its nodes do not.
    pub(super) fn unseen(&mut self, cell: &Cell) -> f64 {
        let corners = if cell[2] == cell[3] { &cell[..3] } else { &cell[..] };
        self.eye.left_open(corners, self.normal, &self.target, self.occluders) * area(cell)
    }

    /// The integral by a rule: of what is hidden where the rest is known, else of what is seen.
    pub(super) fn product(&mut self, cell: &Cell, order: usize, view: &CellView) -> OnCell {
        let is_part = view.focus == Focus::Part;
        let mut sum = OnCell { value: 0.0, is_joint: false, is_dark: is_part };
        for (point, weight) in nodes(cell, RULES[order]) {
            let is_whole_asked = sum.is_dark || !is_part || !self.is_rest_known;
            let seen = self.eye.look_past(point, self.normal, &self.target, self.occluders, is_whole_asked);
            sum.value += weight * self.part(seen, view.focus);
            sum.is_joint |= seen.is_joint;
            sum.is_dark &= seen.whole - seen.hidden <= self.dark * seen.whole;
            self.evaluations += 1;
        }
        sum
    }

    /// What of the factor from a node counts.
    fn part(&self, seen: Seen, focus: Focus) -> f64 {
        match (focus, self.is_rest_known) {
            (Focus::Part, true) => seen.hidden,
            (Focus::Part, false) => seen.whole - seen.hidden,
            _ => seen.whole,
        }
    }
}

fn longest_side([a, b, c, d]: &Cell) -> f64 {
    [*b - *a, *c - *b, *d - *c, *a - *d].map(DVec3::length).into_iter().fold(0.0, f64::max)
}
