//! Which of two edges is the lower one: where heights do not tell, the sides of their ends do.

use super::segments::{ClippedSegment, RankedSegment, Slab};
use crate::predicates::{Segment, Side, crossing_x_order, side};
use glam::DVec2;
use std::cmp::Ordering;

/// What tells where edges are.
pub(super) struct Order<'a> {
    pub(super) ends: &'a [DVec2],
    pub(super) slack: f64,
    /// Whether edges that come near one another and do not meet have an order.
    pub(super) is_exact: bool,
}

impl Order<'_> {
    /// The order of two spanning segments at a slab's left side, and where they meet there, at its right one.
    pub(super) fn compare(&self, a: &ClippedSegment, b: &ClippedSegment, slab: Slab) -> Ordering {
        let [low, high] = [a, b].map(|span| span.heights[0]);
        if (low - high).abs() > self.slack {
            return low.total_cmp(&high);
        }
        let [left, right] = slab.map(|rank| move || self.at(a.segment, b.segment, rank));
        left().then_with(right).then(a.segment.id.cmp(&b.segment.id))
    }

    /// Whether a span lies below another one at a side of their slab, or may do so and shares its end there or beyond.
    #[inline]
    pub(super) fn is_below(&self, a: &ClippedSegment, b: &ClippedSegment, side: usize, slab: Slab) -> bool {
        let (low, high) = (a.heights[side], b.heights[side]);
        low + self.slack < high
            || (low <= high + self.slack && self.is_just_below(a.segment, b.segment, side, slab))
    }

    /// The same of spanning segments that heights do not tell apart. Where they share an end, their order is that at their
    /// other ends.
    fn is_just_below(&self, a: RankedSegment, b: RankedSegment, side: usize, slab: Slab) -> bool {
        let shares = |side: usize| a.ranks[side] == b.ranks[side];
        shares(side)
            || (shares(1 - side) && self.to_point(a, b.ranks[side]) == Ordering::Less)
            || (self.is_exact && self.at(a, b, slab[side]) == Ordering::Less)
    }

    /// The order of two edges over a rank that both reach, none of them vertical; equal where they meet there.
    ///
    /// From the first end that both reach to the last one, edges are in one order, unless they cross; then they are in one
    /// order on either side of the crossing.
    pub(super) fn at(&self, a: RankedSegment, b: RankedSegment, rank: u32) -> Ordering {
        let x = self.ends[rank as usize].x;
        let is_at = |end: u32| self.ends[end as usize].x == x;
        let is_first = is_at(a.ranks[0].max(b.ranks[0]));
        let is_last = is_at(a.ranks[1].min(b.ranks[1]));
        let first = if is_last && !is_first { Ordering::Equal } else { self.at_end(a, b, 0) };
        let last = if is_first { Ordering::Equal } else { self.at_end(a, b, 1) };
        let differ = first == last.reverse() && first != Ordering::Equal;
        if differ {
            let [e, f] = [a, b].map(|segment| self.ends_of(segment));
            return match crossing_x_order(e, f, x) {
                Ordering::Less => last,
                Ordering::Equal => Ordering::Equal,
                Ordering::Greater => first,
            };
        }
        first.then(last)
    }

    /// The order of two edges where the later one starts, or the earlier one ends.
    fn at_end(&self, a: RankedSegment, b: RankedSegment, side: usize) -> Ordering {
        let [own, other] = [a, b].map(|segment| segment.ranks[side]);
        match (own == other, (own < other) == (side == 0)) {
            (true, _) => Ordering::Equal,
            (_, true) => self.to_point(a, other),
            (_, false) => self.to_point(b, own).reverse(),
        }
    }

    /// Whether an edge goes below a point, through it or above it.
    pub(super) fn to_point(&self, segment: RankedSegment, rank: u32) -> Ordering {
        let [a, b] = self.ends_of(segment);
        match side(a, b, self.ends[rank as usize]) {
            Side::Left => Ordering::Less,
            Side::On => Ordering::Equal,
            Side::Right => Ordering::Greater,
        }
    }

    fn ends_of(&self, segment: RankedSegment) -> Segment {
        segment.ranks.map(|rank| self.ends[rank as usize])
    }
}
