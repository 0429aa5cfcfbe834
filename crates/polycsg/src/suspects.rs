//! Pairs of edges so close, or so flat to one another, that rounding crossings may make their pieces meet.
//!
//! Rounding moves a crossing by less than `2 u M` (`u = 2^-53`, `M` the largest coordinate's size) and never out of its
//! edges' boxes. Say that two edges are *clear* of one another when either
//!
//! - all of one lies further than `4 u M` from the other's line, on one side; or
//! - they meet in one point only, at an angle with a sine of at least `2^-15`, and every other point where something
//!   happens on them (contact or end) lies further than `2^-36 M` from it along its edge, so further than
//!   `2^-15 · 2^-36 M = 4 u M` from the other edge.
//!
//! Then no two of their pieces can meet after rounding but in a vertex that they share: pieces that do not end in the
//! common point lie `4 u M` apart, and those that do keep different directions from it. All pairs of edges whose boxes
//! meet are looked at anyway; those that are not clear are noted here, by tests that err on the safe side. When no
//! piece of theirs meets another after rounding, nothing on the whole boundary does.

use crate::chains::LONGEST;
use crate::contacts::{Contact, Met, Partner};
use crate::edges::{Edges, Ring};
use crate::predicates::{Area, Parameter, Segment, doubled_area};

/// See the module's page.
#[derive(Debug, Default)]
pub(crate) struct Suspects {
    pairs: Vec<[u32; 2]>,
    /// `4 u M`, and `2^-36 M`.
    close: f64,
    gap: f64,
}

/// The least sine of an angle that is not flat.
const FLAT: f64 = f64::from_bits((1023 - 15) << 52);

impl Suspects {
    /// Starts over for coordinates up to a size.
    pub(crate) fn start(&mut self, size: f64) {
        self.pairs.clear();
        self.gap = size * f64::from_bits((1023 - 36) << 52);
        self.close = size * f64::from_bits((1023 - 51) << 52);
        // Where the margins themselves lose bits nothing is clear.
        if self.close < f64::MIN_POSITIVE {
            (self.gap, self.close) = (f64::INFINITY, f64::INFINITY);
        }
    }

    pub(crate) fn pairs(&self) -> &[[u32; 2]] {
        &self.pairs
    }

    pub(crate) fn add(&mut self, e: u32, f: u32) {
        self.pairs.push([e, f]);
    }

    /// Whether both of two ends lie on one side of a line through an edge, clear of it, by their areas.
    #[inline]
    pub(crate) fn are_apart(&self, edge: Segment, ends: [Area; 2]) -> bool {
        let margin = self.close * length_bound(edge);
        ends.iter().all(|area| area.value - area.error > margin)
            || ends.iter().all(|area| area.value + area.error < -margin)
    }

    /// Whether two edges cross clearly, by the areas of each one's ends against the other.
    #[inline]
    pub(crate) fn is_clear_crossing(
        &self,
        [e, f]: [Segment; 2],
        ends_of_f: [Area; 2],
        ends_of_e: [Area; 2],
    ) -> bool {
        let (of_e, of_f) = (length_bound(e), length_bound(f));
        let far = |areas: [Area; 2], length: f64| {
            let margin = self.gap * length;
            let beyond = |a: Area, b: Area| a.value - a.error > margin && b.value + b.error < -margin;
            beyond(areas[0], areas[1]) || beyond(areas[1], areas[0])
        };
        let steep = ends_of_f[0].value.abs() + ends_of_f[1].value.abs() > 2.0 * FLAT * of_e * of_f;
        steep && far(ends_of_f, of_e) && far(ends_of_e, of_f)
    }

    /// Two edges of a touch or a common end, the doubled area of the triangle between them.
    #[inline]
    pub(crate) fn is_steep(&self, e: Segment, f: Segment, area: Area) -> bool {
        area.value.abs() - area.error > FLAT * length_bound(e) * length_bound(f)
    }

    /// Looks at the contacts of one edge: at the gaps between them, and at what else of its ring is close to it.
    pub(crate) fn look_along(&mut self, edges: &Edges, contacts: &[Contact]) {
        let is_crossing =
            |contact: &Contact| matches!(contact.partner.met(), Met::FromLeft(_) | Met::FromRight(_));
        if !contacts.iter().any(is_crossing) {
            return;
        }
        let edge = contacts[0].edge;
        let ring = edges.ring(edge);
        let segment = edges.segment(edge);
        let least = self.gap / (segment[1] - segment[0]).abs().max_element();
        let close = |a: Parameter, b: Parameter| !(b.distance_from(a) > least);
        for pair in contacts.windows(2).filter(|pair| close(pair[0].at(), pair[1].at())) {
            self.add_group(edges, edge, [pair[0].partner, pair[1].partner]);
        }
        let (first, last) = (contacts[0], contacts[contacts.len() - 1]);
        if close(Parameter::START, first.at()) && first.partner.met() != Met::Start {
            self.add_group(edges, edge, [first.partner, Partner::vertex(edge)]);
        }
        if close(last.at(), Parameter::END) {
            self.add_group(edges, edge, [last.partner, Partner::vertex(ring.next(edge))]);
        }
        self.look_around(edges, ring, edge);
    }

    /// Notes all pairs of an edge and two things that meet it close together.
    fn add_group(&mut self, edges: &Edges, edge: u32, met: [Partner; 2]) {
        let mut group = vec![edge];
        for partner in met {
            match partner.met() {
                Met::FromLeft(f) | Met::FromRight(f) => group.push(f),
                Met::Vertex(v) => group.extend([v, edges.ring(v).previous(v)]),
                Met::Start => group.push(edges.ring(edge).previous(edge)),
            }
        }
        for (i, &e) in group.iter().enumerate() {
            self.pairs.extend(group[..i].iter().filter(|&&f| f != e).map(|&f| [e, f]));
        }
    }

    /// Notes what is close to an edge on both sides along its ring: its neighbours where they turn back sharply, and of
    /// those beyond, which may be in one chain with it and were not compared, those that are not apart from it.
    fn look_around(&mut self, edges: &Edges, ring: Ring, edge: u32) {
        let steps: [fn(Ring, u32) -> u32; 2] = [Ring::next, Ring::previous];
        let s = edges.segment(edge);
        for (step, corner) in steps.into_iter().zip([s[1], s[0]]) {
            let mut other = step(ring, edge);
            let t = edges.segment(other);
            let end = if t[0] == corner { t[1] } else { t[0] };
            let start = if s[0] == corner { s[1] } else { s[0] };
            let turns_back = (end - corner).dot(start - corner) > 0.0;
            if turns_back && !self.is_steep(s, t, doubled_area(corner, start, end)) {
                self.add(edge, other);
            }
            for _ in 0..LONGEST {
                other = step(ring, other);
                let t = edges.segment(other);
                let gap =
                    (t[0].x.min(t[1].x) - s[0].x.max(s[1].x)).max(s[0].x.min(s[1].x) - t[0].x.max(t[1].x));
                if other == edge || gap > self.close {
                    break;
                }
                let areas = |line: Segment, ends: Segment| ends.map(|p| doubled_area(line[0], line[1], p));
                if !self.are_apart(s, areas(s, t)) && !self.are_apart(t, areas(t, s)) {
                    self.add(edge, other);
                }
            }
        }
    }
}

/// Not less than the length, and less than 1.5 times it.
#[inline]
fn length_bound([a, b]: Segment) -> f64 {
    (b.x - a.x).abs() + (b.y - a.y).abs()
}
