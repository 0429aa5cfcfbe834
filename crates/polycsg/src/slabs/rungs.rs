//! The edges that span a slab: which of them are its rungs, which follow one, and what else comes near them.

use super::heights::Line;
use super::{Bar, FEW, NONE, Slab, Slabs};
use crate::predicates::{Side, side};
use crate::truth::index;
use glam::DVec2;
use std::ops::Range;

/// An edge from side to side of a slab: its heights there, and whether they are its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) heights: [f64; 2],
    pub(super) line: Line,
    pub(super) bar: Bar,
    is_end: [bool; 2],
}

impl Slabs {
    /// Takes the open edges that span a slab, and sorts them by their heights.
    pub(super) fn sort_out_spans(&mut self, slab: Slab, start: usize) {
        let mut kept = start;
        for i in start..self.open.len() {
            let bar = self.open[i];
            if bar.ranks[0] <= slab[0] && slab[1] <= bar.ranks[1] {
                let line = self.line(bar, slab);
                let heights = slab.map(|rank| self.height(bar.ranks, line, rank));
                let is_end = [0, 1].map(|side| bar.ranks[side] == slab[side]);
                self.spans.push(Span { heights, line, bar, is_end });
            } else {
                self.open[kept] = bar;
                kept += 1;
            }
        }
        self.open.truncate(kept);
        self.sort_spans();
    }

    /// Sorts keys, which are smaller than spans.
    fn sort_spans(&mut self) {
        let Slabs { spans, rungs, keys, .. } = self;
        keys.clear();
        keys.extend(spans.iter().zip(0..).map(|(span, place)| (span.heights[0], place)));
        keys.sort_unstable_by(|a, b| {
            a.0.total_cmp(&b.0).then_with(|| {
                let [a, b] = [a, b].map(|key| &spans[key.1 as usize]);
                let by_heights = a.heights[1].total_cmp(&b.heights[1]);
                by_heights.then_with(|| a.line.order(&b.line)).then(a.bar.id.cmp(&b.bar.id))
            })
        });
        rungs.clear();
        rungs.extend(keys.iter().map(|key| spans[key.1 as usize]));
        std::mem::swap(spans, rungs);
    }

    /// Moves as many spans as may be, none of which meets another, to the rungs: the longest increasing subsequence by
    /// patience sorting.
    pub(super) fn choose_rungs(&mut self) {
        let Slabs { spans, rungs, tops, before, .. } = self;
        let order = Order { ends: &self.ends, slack: self.slack };
        tops.clear();
        before.clear();
        for (i, span) in spans.iter().enumerate() {
            let pile = tops.partition_point(|&top| order.is_below(&spans[top as usize], span, 1));
            let below = pile.checked_sub(1).map_or(NONE, |pile| tops[pile]);
            let fits = below == NONE || {
                let below = &spans[below as usize];
                order.is_below(below, span, 0) && order.is_below(below, span, 1)
            };
            before.push(below);
            if fits {
                match tops.get_mut(pile) {
                    Some(top) => *top = index(i),
                    None => tops.push(index(i)),
                }
            }
        }
        rungs.clear();
        let mut next = tops.last().copied().unwrap_or(NONE);
        while next != NONE {
            rungs.push(spans[next as usize]);
            spans[next as usize].bar.id = NONE;
            next = before[next as usize];
        }
        rungs.reverse();
        spans.retain(|span| span.bar.id != NONE);
        self.find_fans();
    }

    /// Takes the spans that follow a rung.
    pub(super) fn sort_out_followers(&mut self) {
        let Slabs { spans, rungs, followers, slack, .. } = self;
        followers.clear();
        spans.retain(|span| {
            let at = rungs.partition_point(|rung| rung.heights[0] + *slack < span.heights[0]);
            let is_near =
                |rung: &Span, side: usize| (rung.heights[side] - span.heights[side]).abs() <= *slack;
            let near = rungs[at..].iter().take_while(|rung| is_near(rung, 0));
            // Of a fan all are near there: those that end alike and are near on the other side are few.
            let mut near = near.take(FEW).zip(at..);
            let found = near.find(|(rung, _)| rung.is_end == span.is_end && is_near(rung, 1));
            followers.extend(found.map(|(_, place)| (place, span.bar)));
            found.is_none()
        });
        followers.sort_unstable_by_key(|&(place, bar)| (place, bar.id));
    }

    /// Finds the pairs of followers and rungs, and of followers of one rung or of rungs near one another, that may meet in
    /// a slab.
    pub(super) fn compare_followers(&mut self, slab: Slab) {
        for i in 0..self.followers.len() {
            self.compare(self.followers[i].1, slab, false);
        }
        for (i, &(place, e)) in self.followers.iter().enumerate() {
            let [left, right] = self.rungs[place].heights;
            let are_near = |other: usize| {
                let heights = self.rungs[other].heights;
                heights[0] - left <= 3.0 * self.slack || heights[1] - right <= 3.0 * self.slack
            };
            for &(_, f) in self.followers[i + 1..].iter().take_while(|(other, _)| are_near(*other)) {
                if self.may_meet(e, f, slab) {
                    self.found.add(std::iter::once([e.id, f.id]));
                }
            }
        }
    }

    /// Finds the rungs, and if asked for their followers, that an edge may meet in a slab.
    pub(super) fn compare(&mut self, bar: Bar, slab: Slab, with_followers: bool) {
        let line = self.line(bar, slab);
        let near_left = self.position(bar, line, 0, slab, None);
        // Most edges meet none, and are between the same two all the way.
        let near_right = self.position(bar, line, 1, slab, Some(near_left.start));
        let left = self.compare_near(bar, near_left, 0, with_followers);
        let right = self.compare_near(bar, near_right, 1, with_followers);
        let crossed = if left.end < right.start { left.end..right.start } else { right.end..left.start };
        self.add_rungs(bar, crossed.clone());
        if with_followers {
            self.add_followers(bar, crossed);
        }
    }

    /// Finds which of the rungs near an edge at a side it may meet there; returns those between which it lies. Fans that
    /// start or end with the edge do not meet it there.
    #[inline]
    fn compare_near(
        &mut self,
        bar: Bar,
        near: Range<usize>,
        side: usize,
        with_followers: bool,
    ) -> Range<usize> {
        let mut between = near.clone();
        let mut start = near.start;
        while start < near.end {
            let Span { bar: rung, is_end, .. } = self.rungs[start];
            let fans = self.fans[start].map(|end| start..near.end.min(end as usize));
            let is_shared = rung.ranks[side] == bar.ranks[side];
            let end = if is_shared || fans[1 - side].len() <= fans[side].len() { side } else { 1 - side };
            let fan = fans[end].clone();
            start = fan.end;
            if !is_shared {
                let is_wide = fan.len() > FEW && self.reach == 0.0;
                let met = if is_wide { self.met_in_fan(bar, &fan, end, side) } else { fan.clone() };
                between.start = if fan.start < met.start { met.start } else { between.start };
                between.end = if met.end < fan.end { between.end.min(met.end) } else { between.end };
                self.add_rungs(bar, met);
            } else if is_end[side] {
                // So do its followers.
                continue;
            }
            if with_followers {
                self.add_followers(bar, fan);
            }
        }
        between
    }

    fn add_rungs(&mut self, bar: Bar, rungs: Range<usize>) {
        if rungs.start < rungs.end {
            let Slabs { rungs: all, found, ends, reach, .. } = self;
            let meets = |other: &Bar| other.meets(bar, ends, *reach);
            let others = all[rungs].iter().map(|rung| rung.bar);
            found.add(others.filter(meets).map(|other| [bar.id, other.id]));
        }
    }

    fn add_followers(&mut self, bar: Bar, rungs: Range<usize>) {
        if rungs.start < rungs.end && !self.followers.is_empty() {
            let Slabs { followers, found, ends, reach, .. } = self;
            let first = followers.partition_point(|&(place, _)| place < rungs.start);
            let others = followers[first..].iter().take_while(|&&(place, _)| place < rungs.end);
            let meets = |other: &Bar| other.meets(bar, ends, *reach);
            found.add(others.map(|&(_, other)| other).filter(meets).map(|other| [bar.id, other.id]));
        }
    }

    /// Of the place where an edge enters or leaves a slab or ends in it, the rungs that may go through it.
    fn position(&self, bar: Bar, line: Line, side: usize, slab: Slab, guess: Option<usize>) -> Range<usize> {
        let rank = bar.ranks[side].clamp(slab[0], slab[1]);
        let height = self.height(bar.ranks, line, rank);
        let at = |rung: &Span| {
            if rank == slab[side] { rung.heights[side] } else { self.height_inside(rung, rank) }
        };
        // Followers are within one slack of their rung, and may touch within one more.
        let is_below = |rung: &Span| at(rung) + 3.0 * self.slack < height;
        let may_touch = |rung: &Span| at(rung) <= height + 3.0 * self.slack;
        let fits = |&guess: &usize| {
            self.rungs[..guess].last().is_none_or(is_below) && !self.rungs.get(guess).is_some_and(is_below)
        };
        let first = guess.filter(fits).unwrap_or_else(|| self.rungs.partition_point(is_below));
        match self.rungs.get(first) {
            Some(rung) if may_touch(rung) => first..first + self.rungs[first..].partition_point(may_touch),
            _ => first..first,
        }
    }
}

/// What tells where spans are.
struct Order<'a> {
    ends: &'a [DVec2],
    slack: f64,
}

impl Order<'_> {
    /// Whether a span lies below another one at a side, or may do so and shares its end there or beyond; of spans that
    /// share their other ends, the exact order tells where heights do not.
    #[inline]
    fn is_below(&self, a: &Span, b: &Span, side: usize) -> bool {
        let (low, high) = (a.heights[side], b.heights[side]);
        let shares = |side: usize| a.bar.ranks[side] == b.bar.ranks[side];
        low + self.slack < high
            || (low <= high + self.slack
                && (shares(side) || (shares(1 - side) && self.is_exactly_below(a, b, side))))
    }

    /// Whether the end of a span at a side lies above another span that shares its other end.
    #[cold]
    fn is_exactly_below(&self, a: &Span, b: &Span, end: usize) -> bool {
        let [p, q] = a.bar.ranks.map(|rank| self.ends[rank as usize]);
        side(p, q, self.ends[b.bar.ranks[end] as usize]) == Side::Left
    }
}

impl Bar {
    /// Whether the boxes of two edges, widened, meet: where all is within the heights' error, boxes still tell short
    /// edges apart.
    #[inline]
    fn meets(self, other: Bar, ends: &[DVec2], reach: f64) -> bool {
        let [[a, b], [c, d]] = [self, other].map(|bar| bar.ranks.map(|rank| ends[rank as usize]));
        let (low, high) = (a.min(b) - reach, a.max(b) + reach);
        low.cmple(c.max(d)).all() && high.cmpge(c.min(d)).all()
    }
}
