//! The edges that span a slab: which of them are its rungs, which follow one, and what else comes near them.

use super::heights::Line;
use super::{Bar, FEW, NONE, Slab, Slabs};
use crate::predicates::Segment;
use crate::truth::index;
use std::ops::Range;

/// An edge from side to side of a slab: its heights there, and whether they are its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) heights: [f64; 2],
    pub(super) line: Line,
    pub(super) bar: Bar,
    pub(super) is_end: [bool; 2],
}

impl Slabs {
    /// Takes the open edges that span a slab, and sorts them by their heights.
    pub(super) fn sort_out_spans(&mut self, slab: Slab, start: usize) {
        let mut kept = start;
        for i in start..self.open.len() {
            let bar = self.open[i];
            if bar.ranks[0] <= slab[0] && slab[1] <= bar.ranks[1] {
                let line = self.line(bar);
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
            let rest = |key: &(f64, u32)| {
                let span = &spans[key.1 as usize];
                (span.heights[1], span.bar.id)
            };
            let by_rest = || {
                let (a, b) = (rest(a), rest(b));
                a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
            };
            a.0.total_cmp(&b.0).then_with(by_rest)
        });
        rungs.clear();
        rungs.extend(keys.iter().map(|key| spans[key.1 as usize]));
        std::mem::swap(spans, rungs);
    }

    /// Moves as many spans as may be, none of which meets another, to the rungs: the longest increasing subsequence by
    /// patience sorting.
    pub(super) fn choose_rungs(&mut self) {
        let Slabs { spans, rungs, tops, before, slack, .. } = self;
        tops.clear();
        before.clear();
        for (i, span) in spans.iter().enumerate() {
            let pile = tops.partition_point(|&top| is_below(&spans[top as usize], span, 1, *slack));
            let below = pile.checked_sub(1).map_or(NONE, |pile| tops[pile]);
            let fits = below == NONE || {
                let below = &spans[below as usize];
                is_below(below, span, 0, *slack) && is_below(below, span, 1, *slack)
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
        self.fans = [0, 1].map(|side| {
            let start = self.rungs.iter().position(|rung| rung.is_end[side]).unwrap_or(0);
            start..start + self.rungs[start..].iter().take_while(|rung| rung.is_end[side]).count()
        });
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
        let line = self.line(bar);
        let (near_left, left) = self.position(bar, line, 0, slab, None);
        // Most edges meet none, and are between the same two all the way.
        let (near_right, right) = self.position(bar, line, 1, slab, Some(left.start));
        let crossed = if left.end < right.start { left.end..right.start } else { right.end..left.start };
        let ends = bar.ranks.map(|rank| self.ends[rank as usize]);
        let any = |rungs: &Range<usize>| rungs.start < rungs.end;
        for rungs in near_left.into_iter().chain(near_right).chain([crossed]).filter(any) {
            let all = if with_followers { &self.followers[..] } else { &[] };
            let first = all.partition_point(|&(place, _)| place < rungs.start);
            let followers = all[first..].iter().take_while(|&&(place, _)| place < rungs.end);
            let near =
                self.rungs[rungs.clone()].iter().map(|rung| rung.bar).chain(followers.map(|&(_, bar)| bar));
            let meets =
                |other: &Bar| boxes_meet(ends, other.ranks.map(|rank| self.ends[rank as usize]), self.reach);
            self.found.add(near.filter(meets).map(|other| [bar.id, other.id]));
        }
    }

    /// Of the place where an edge enters or leaves a slab or ends in it, the rungs that may go through it, and those
    /// between which it lies; rungs that start or end in it with the edge count for the second only.
    fn position(
        &self,
        bar: Bar,
        line: Line,
        side: usize,
        slab: Slab,
        guess: Option<usize>,
    ) -> ([Range<usize>; 2], Range<usize>) {
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
        let last = match self.rungs.get(first) {
            Some(rung) if may_touch(rung) => first + self.rungs[first..].partition_point(may_touch),
            _ => first,
        };
        let fan = self.fans[side].clone();
        if bar.ranks[side] == slab[side] && !fan.is_empty() {
            ([first..fan.start, fan.end..last], fan)
        } else {
            ([first..last, 0..0], first..last)
        }
    }
}

/// Whether a span lies below another one at a side, or both end there in one point.
#[inline]
fn is_below(a: &Span, b: &Span, side: usize, slack: f64) -> bool {
    a.heights[side] + slack < b.heights[side] || (a.is_end[side] && b.is_end[side])
}

/// Whether the boxes of two edges, widened, meet: where all is within the heights' error, boxes still tell short edges
/// apart.
#[inline]
fn boxes_meet([a, b]: Segment, [c, d]: Segment, reach: f64) -> bool {
    let (low, high) = (a.min(b) - reach, a.max(b) + reach);
    low.cmple(c.max(d)).all() && high.cmpge(c.min(d)).all()
}
