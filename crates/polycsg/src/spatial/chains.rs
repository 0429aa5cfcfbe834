//! Monotone chains: consecutive edges of a ring that all lead to the right, to the left, upward or downward, with their boxes.
//!
//! ```text
//!        ______            Lexicographically monotone: to the right, x never turns back (upright edges lead upward or
//!   ____/  |   \___        downward, all of a chain the same way). So the edges of one chain meet in their common ends
//!   chain 1|   chain 2     only, and of two chains only what lies in both boxes meets.
//! ```

use crate::predicates::{Segment, lexicographic};
use glam::DVec2;
use std::{cmp::Ordering, ops::Range};

/// More edges make a chain's box too large to prune anything.
pub(crate) const LONGEST: u32 = 16;

/// So many edges are a run.
const RUN: u32 = 8;

/// A chain ends where its box would have more than so many times the area of its edges' boxes: at the corner of a
/// rectangle. Among few points anything is quick.
const WIDEST: f64 = 32.0;
const FEW: usize = 64;

/// A run of edges and its box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MonotoneChain {
    /// The slots of its points, in the order of the ring.
    first: u32,
    last: u32,
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
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        let (mut these, those) =
            (self.edges_within(points, low, high), other.edges_within(points, low, high));
        while these != 0 {
            let e = self.first + these.trailing_zeros();
            these &= these - 1;
            let (low, high) = bounds(points[e as usize], points[e as usize + 1]);
            let mut left = those;
            while left != 0 {
                let f = other.first + left.trailing_zeros();
                left &= left - 1;
                if meets(points[f as usize], points[f as usize + 1], low, high) {
                    visit(e, f);
                }
            }
        }
    }

    /// The edges whose boxes meet a box, as bits in the order of the ring.
    #[inline]
    fn edges_within(&self, points: &[DVec2], low: DVec2, high: DVec2) -> u32 {
        if self.len() == 1 {
            return 1;
        }
        let ends = points[self.first as usize..=self.last as usize].windows(2);
        (0..).zip(ends).fold(0, |edges, (i, ends)| edges | u32::from(meets(ends[0], ends[1], low, high)) << i)
    }
}

/// The box around two points.
#[inline]
fn bounds(a: DVec2, b: DVec2) -> (DVec2, DVec2) {
    (a.min(b), a.max(b))
}

/// Whether the box around two points meets another one.
#[inline]
fn meets(a: DVec2, b: DVec2, low: DVec2, high: DVec2) -> bool {
    let (left, right) = if a.x < b.x { (a.x, b.x) } else { (b.x, a.x) };
    let (bottom, top) = if a.y < b.y { (a.y, b.y) } else { (b.y, a.y) };
    (left <= high.x) & (right >= low.x) & (bottom <= high.y) & (top >= low.y)
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
    pub(crate) fn build(&mut self, points: &[DVec2], rings: impl Iterator<Item = Range<u32>>) {
        self.cut(points, rings, LONGEST);
    }

    /// Makes each edge a chain.
    pub(crate) fn cut_to_edges(&mut self, points: &[DVec2], rings: impl Iterator<Item = Range<u32>>) {
        self.cut(points, rings, 1);
    }

    /// Cuts rings into runs that need not be monotone: enough for vertical rays.
    pub(crate) fn cut_to_runs(&mut self, points: &[DVec2], rings: impl Iterator<Item = Range<u32>>) {
        self.chains.clear();
        for slots in rings {
            let end = slots.end - 1;
            for first in (slots.start..end).step_by(RUN as usize) {
                let last = end.min(first + RUN);
                let around = |(low, high): (DVec2, DVec2), &p: &DVec2| (low.min(p), high.max(p));
                let run = &points[first as usize..=last as usize];
                let (low, high) = run.iter().fold((DVec2::MAX, DVec2::MIN), around);
                self.chains.push(MonotoneChain { first, last, low, high });
            }
        }
    }

    fn cut(&mut self, points: &[DVec2], rings: impl Iterator<Item = Range<u32>>, longest: u32) {
        self.chains.clear();
        self.leftmost.clear();
        for slots in rings {
            self.add_ring(points, slots, longest);
        }
    }

    /// The number of chains.
    pub(crate) fn len(&self) -> usize {
        self.chains.len()
    }

    /// The lower left and upper right corner of each chain's box.
    pub(crate) fn boxes(&self) -> impl Iterator<Item = [DVec2; 2]> + Clone + '_ {
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
        let largest = |size: f64, p: DVec2| p.abs().max_element().max(size);
        self.chains.iter().flat_map(|chain| [chain.low, chain.high]).fold(0.0, largest)
    }

    fn add_ring(&mut self, points: &[DVec2], slots: Range<u32>, longest: u32) {
        let (mut start, last) = (slots.start, slots.end - 1);
        let mut leftmost = start;
        while start < last {
            let (chain, left) = longest_chain(points, start, last.min(start + longest));
            if lexicographic(points[left as usize], points[leftmost as usize]) == Ordering::Less {
                leftmost = left;
            }
            self.chains.push(chain);
            start = chain.last;
        }
        let is_repeated = leftmost == last && points[last as usize] == points[slots.start as usize];
        self.leftmost.push(if is_repeated { slots.start } else { leftmost });
    }
}

/// Whether an edge leads to the right rather than the left, and upward rather than downward.
#[inline]
fn ways(step: DVec2) -> [bool; 2] {
    let DVec2 { x, y } = step;
    [(x > 0.0) | ((x == 0.0) & (y > 0.0)), (y > 0.0) | ((y == 0.0) & (x > 0.0))]
}

/// The longest chain from a slot on that does not go beyond another slot, and its lexicographically smallest slot.
#[inline]
fn longest_chain(points: &[DVec2], first: u32, end: u32) -> (MonotoneChain, u32) {
    let widest = if points.len() > FEW { WIDEST } else { f64::INFINITY };
    let (a, mut b) = (points[first as usize], points[first as usize + 1]);
    // The sign of a difference of doubles is that of the exact one.
    let [rightward, upward] = ways(b - a);
    let mut turned = [false; 2];
    let (mut low, mut high) = bounds(a, b);
    let area = |sides: DVec2| (sides.x * sides.y).abs();
    let mut areas = area(b - a);
    let mut last = first + 1;
    while last < end {
        let c = points[last as usize + 1];
        let way = ways(c - b);
        let turns = [turned[0] | (way[0] != rightward), turned[1] | (way[1] != upward)];
        areas += area(c - b);
        let around = (low.min(c), high.max(c));
        if turns == [true; 2] || area(around.1 - around.0) > widest * areas {
            break;
        }
        ((low, high), b, turned) = (around, c, turns);
        last += 1;
    }
    let by_place = |v: &u32, w: &u32| lexicographic(points[*v as usize], points[*w as usize]);
    let left = match (turned[0], rightward) {
        (true, _) => (first..=last).min_by(by_place).unwrap_or(first),
        (false, true) => first,
        (false, false) => last,
    };
    (MonotoneChain { first, last, low, high }, left)
}
