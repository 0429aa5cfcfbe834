//! Monotone chains: consecutive edges of a ring that all lead to the right, to the left, upward or downward, with their boxes.
//!
//! ```text
//!        ______            Lexicographically monotone: to the right, x never turns back (upright edges lead upward or
//!   ____/  |   \___        downward, all of a chain the same way). So the edges of one chain meet in their common ends
//!   chain 1|   chain 2     only, and of two chains only what lies in both boxes meets.
//! ```

use super::strips::boxes_meet;
use crate::base::corners::corners;
use crate::base::meter::{Meter, Refusal};
use crate::base::threads::{Threads, ranges};
use crate::predicates::{Segment, lexicographic};
use glam::DVec2;
use std::{cmp::Ordering, ops::Range};

/// More edges make a chain's box too large to prune anything.
pub(crate) const LONGEST: u32 = 16;

/// Of so few points each edge is a chain.
const FEW: usize = 12;

/// So many edges are a run.
const RUN: u32 = 8;

/// A chain ends where its box would have more than so many times the area of its edges' boxes: at the corner of a
/// rectangle.
const WIDEST: f64 = 32.0;

/// A run of edges and its box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MonotoneChain {
    /// The slots of its points, in the order of the ring.
    first: u32,
    last: u32,
    /// Whether it leads to the right or the left, and upward or downward, where it is monotone so.
    ways: [Option<bool>; 2],
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
}

impl MonotoneChain {
    /// The number of its edges.
    #[inline]
    pub(crate) fn len(&self) -> u32 {
        self.last - self.first
    }

    /// The edges, each as an index and directed to the right, whose left ends lie at or left of `x` and whose right ends lie
    /// right of it.
    #[inline]
    pub(crate) fn edges_at(&self, points: &[DVec2], x: f64) -> impl Iterator<Item = (u32, Segment)> {
        let ends = points[self.first as usize..=self.last as usize].windows(2);
        (self.first..).zip(ends).filter_map(move |(edge, ends)| {
            let (left, right) = if ends[0].x < ends[1].x { (ends[0], ends[1]) } else { (ends[1], ends[0]) };
            (left.x <= x && x < right.x).then_some((edge, [left, right]))
        })
    }

    /// Calls `visit` for each edge of this chain and each of another whose boxes meet; those of the chains do.
    #[inline]
    pub(crate) fn meet(&self, other: &MonotoneChain, points: &[DVec2], mut visit: impl FnMut(u32, u32)) {
        if self.len() == 1 && other.len() == 1 {
            return visit(self.first, other.first);
        }
        for (chain, next) in [(self, other), (other, self)] {
            if chain.goes_on_in(next, points) {
                return visit(chain.last - 1, next.first);
            }
        }
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        let (mut these, those) =
            (self.edges_within(points, low, high), other.edges_within(points, low, high));
        while these != 0 {
            let e = self.first + these.trailing_zeros();
            these &= these - 1;
            let around = bounds(points[e as usize], points[e as usize + 1]);
            let mut left = those;
            while left != 0 {
                let f = other.first + left.trailing_zeros();
                left &= left - 1;
                if boxes_meet(bounds(points[f as usize], points[f as usize + 1]), around) {
                    visit(e, f);
                }
            }
        }
    }

    /// Whether another chain leads on from the end of this one, the edges there too: then only these two edges meet.
    #[inline]
    fn goes_on_in(&self, next: &MonotoneChain, points: &[DVec2]) -> bool {
        let leads_on = |edge: u32| {
            let step = points[edge as usize + 1] - points[edge as usize];
            [step.x != 0.0, step.y != 0.0]
        };
        self.last == next.first && {
            let (before, behind) = (leads_on(self.last - 1), leads_on(next.first));
            let goes_on = |way: usize| self.ways[way].is_some() && self.ways[way] == next.ways[way];
            [0, 1].iter().any(|&way| goes_on(way) && before[way] && behind[way])
        }
    }

    /// The edges whose boxes meet a box, as bits in the order of the ring.
    #[inline]
    fn edges_within(&self, points: &[DVec2], low: DVec2, high: DVec2) -> u32 {
        // Looking at two takes as long as comparing them.
        if self.len() <= 2 {
            return (1 << self.len()) - 1;
        }
        let ends = points[self.first as usize..=self.last as usize].windows(2);
        let meets = |ends: &[DVec2]| u32::from(boxes_meet(bounds(ends[0], ends[1]), [low, high]));
        ends.rev().fold(0, |edges, ends| edges << 1 | meets(ends))
    }
}

/// The box around two points.
#[inline]
fn bounds(a: DVec2, b: DVec2) -> [DVec2; 2] {
    [a.min(b), a.max(b)]
}

/// The chains of rings, ring by ring.
#[derive(Debug, Default)]
pub(crate) struct MonotoneChains {
    chains: Vec<MonotoneChain>,
    /// Per ring its lexicographically smallest vertex.
    leftmost: Vec<u32>,
}

impl MonotoneChains {
    /// Cuts rings into chains; each ring is a span of slots, the last one its first point again.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn build(
        &mut self,
        points: &[DVec2],
        rings: impl Iterator<Item = Range<u32>>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.cut(points, rings, if points.len() <= FEW { 1 } else { LONGEST }, meter)
    }

    /// Makes each edge a chain.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn cut_to_edges(
        &mut self,
        points: &[DVec2],
        rings: impl Iterator<Item = Range<u32>>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.cut(points, rings, 1, meter)
    }

    /// Cuts rings into runs that need not be monotone: enough for vertical rays.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn cut_to_runs(
        &mut self,
        points: &[DVec2],
        rings: impl Iterator<Item = Range<u32>>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.chains.clear();
        let mut tally = meter.tally();
        for slots in rings {
            let end = slots.end - 1;
            for first in (slots.start..end).step_by(RUN as usize) {
                let last = end.min(first + RUN);
                let [low, high] = corners(&points[first as usize..=last as usize]);
                self.chains.push(MonotoneChain { first, last, ways: [None; 2], low, high });
                tally.add(1)?;
            }
        }
        Ok(())
    }

    fn cut(
        &mut self,
        points: &[DVec2],
        mut rings: impl Iterator<Item = Range<u32>>,
        longest: u32,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.chains.clear();
        self.leftmost.clear();
        let threads = Threads::for_edges(points.len());
        if !threads.are_many() {
            let mut counted = 0;
            return rings.try_for_each(|slots| self.add_ring(points, slots, longest, meter, &mut counted));
        }
        let rings: Vec<Range<u32>> = rings.collect();
        let parts = threads.map(ranges(rings.len()), |part| {
            let (mut own, mut counted) = (MonotoneChains::default(), 0);
            for slots in &rings[part] {
                own.add_ring(points, slots.clone(), longest, meter, &mut counted)?;
            }
            Ok(own)
        });
        for part in parts {
            let part = part?;
            self.chains.extend(part.chains);
            self.leftmost.extend(part.leftmost);
        }
        Ok(())
    }

    /// The number of chains.
    pub(crate) fn len(&self) -> usize {
        self.chains.len()
    }

    /// The lower left and upper right corner of each chain's box.
    pub(crate) fn boxes(&self) -> impl ExactSizeIterator<Item = [DVec2; 2]> + Clone + '_ {
        self.chains.iter().map(|chain| [chain.low, chain.high])
    }

    /// All edges.
    pub(crate) fn edges(&self) -> impl Iterator<Item = u32> + '_ {
        self.chains.iter().flat_map(|chain| chain.first..chain.last)
    }

    #[inline]
    pub(crate) fn chain(&self, chain: u32) -> &MonotoneChain {
        &self.chains[chain as usize]
    }

    /// The lexicographically smallest vertex of a ring, the first if there are several.
    pub(crate) fn leftmost(&self, ring: u32) -> u32 {
        self.leftmost[ring as usize]
    }

    /// The largest absolute coordinate.
    pub(crate) fn size(&self) -> f64 {
        let larger = |size: DVec2, chain: &MonotoneChain| size.max(chain.low.abs()).max(chain.high.abs());
        self.chains.iter().fold(DVec2::ZERO, larger).max_element()
    }

    fn add_ring(
        &mut self,
        points: &[DVec2],
        slots: Range<u32>,
        longest: u32,
        meter: &Meter<'_>,
        counted: &mut usize,
    ) -> Result<(), Refusal> {
        if longest == 1 {
            self.add_edges(points, slots);
            return meter.spend_up_to(self.chains.len(), counted);
        }
        let (mut start, last) = (slots.start, slots.end - 1);
        let mut leftmost = start;
        while start < last {
            let (chain, left) = longest_chain(points, start, last.min(start + longest));
            if lexicographic(points[left as usize], points[leftmost as usize]) == Ordering::Less {
                leftmost = left;
            }
            self.chains.push(chain);
            start = chain.last;
            meter.spend_up_to(self.chains.len(), counted)?;
        }
        let is_repeated = leftmost == last && points[last as usize] == points[slots.start as usize];
        self.leftmost.push(if is_repeated { slots.start } else { leftmost });
        Ok(())
    }

    /// Adds each edge of a ring as a chain of its own, which asks for no ways.
    fn add_edges(&mut self, points: &[DVec2], slots: Range<u32>) {
        let (mut leftmost, mut smallest) = (slots.start, points[slots.start as usize]);
        let ends = points[slots.start as usize..slots.end as usize].windows(2);
        self.chains.reserve(slots.len());
        for (first, ends) in (slots.start..).zip(ends) {
            let [low, high] = bounds(ends[0], ends[1]);
            if lexicographic(ends[1], smallest) == Ordering::Less {
                (leftmost, smallest) = (first + 1, ends[1]);
            }
            self.chains.push(MonotoneChain { first, last: first + 1, ways: [None; 2], low, high });
        }
        self.leftmost.push(leftmost);
    }
}

/// In bits whether an edge leads to the right rather than the left, and upward rather than downward.
#[inline]
fn ways(step: DVec2) -> u8 {
    let DVec2 { x, y } = step;
    u8::from((x > 0.0) | ((x == 0.0) & (y > 0.0))) | u8::from((y > 0.0) | ((y == 0.0) & (x > 0.0))) << 1
}

/// The longest chain from a slot on that does not go beyond another slot, and its lexicographically smallest slot.
#[inline]
fn longest_chain(points: &[DVec2], first: u32, end: u32) -> (MonotoneChain, u32) {
    let (a, mut b) = (points[first as usize], points[first as usize + 1]);
    // The sign of a difference of doubles is that of the exact one.
    let way = ways(b - a);
    let mut turned = 0;
    let [mut low, mut high] = bounds(a, b);
    let area = |sides: DVec2| (sides.x * sides.y).abs();
    let mut areas = area(b - a);
    let mut last = first + 1;
    for &c in &points[first as usize + 2..=end as usize] {
        let turns = turned | (ways(c - b) ^ way);
        let around = [low.min(c), high.max(c)];
        areas += area(c - b);
        if turns == 0b11 || area(around[1] - around[0]) > WIDEST * areas {
            break;
        }
        ([low, high], b, turned) = (around, c, turns);
        last += 1;
    }
    let by_place = |v: &u32, w: &u32| lexicographic(points[*v as usize], points[*w as usize]);
    let ways = [1, 2].map(|bit| (turned & bit == 0).then_some(way & bit != 0));
    let left = match ways[0] {
        None => (first..=last).min_by(by_place).unwrap_or(first),
        Some(true) => first,
        Some(false) => last,
    };
    (MonotoneChain { first, last, ways, low, high }, left)
}
