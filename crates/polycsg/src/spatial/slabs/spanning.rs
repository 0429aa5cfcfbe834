//! The edges that span a slab: which of them are its rungs, which follow one, and what else comes near them.

use super::order::Order;
use super::segments::{Line, NONE, RankedSegment, Slab, SpanningSegment};
use super::{FEW, SlabDecomposition};
use crate::base::id::index;
use std::ops::Range;

impl SlabDecomposition {
    /// Takes the open edges that span a slab, and sorts them by their heights.
    pub(super) fn sort_out_spans(&mut self, slab: Slab, start: usize) {
        let mut kept = start;
        for i in start..self.open.len() {
            let bar = self.open[i];
            if bar.ranks[0] <= slab[0] && slab[1] <= bar.ranks[1] {
                let line = self.line(bar, slab);
                let heights = slab.map(|rank| self.height(bar.ranks, line, rank));
                self.spans.push(SpanningSegment { heights, line, bar });
            } else {
                self.open[kept] = bar;
                kept += 1;
            }
        }
        self.open.truncate(kept);
        self.sort_spans(slab);
    }

    /// Sorts keys, which are smaller than spans; then exactly what heights do not tell apart, unless all that comes near is
    /// asked for.
    fn sort_spans(&mut self, slab: Slab) {
        let SlabDecomposition { spans, rungs, keys, ends, slack, reach, .. } = self;
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
        let order = Order { ends, slack: *slack, is_exact: *reach == 0.0 };
        if order.is_exact {
            let is_tied =
                |a: &SpanningSegment, b: &SpanningSegment| b.heights[0] - a.heights[0] <= order.slack;
            for tied in spans.chunk_by_mut(is_tied).filter(|tied| tied.len() > 1) {
                tied.sort_by(|a, b| order.compare(a, b, slab));
            }
        }
    }

    /// Moves as many spans as may be, none of which meets another, to the rungs: the longest increasing subsequence by
    /// patience sorting.
    pub(super) fn choose_rungs(&mut self, slab: Slab) {
        let SlabDecomposition { spans, rungs, tops, before, .. } = self;
        let order = Order { ends: &self.ends, slack: self.slack, is_exact: self.reach == 0.0 };
        tops.clear();
        before.clear();
        for (i, span) in spans.iter().enumerate() {
            let pile = tops.partition_point(|&top| order.is_below(&spans[top as usize], span, 1, slab));
            let below = pile.checked_sub(1).map_or(NONE, |pile| tops[pile]);
            let fits = below == NONE || {
                let below = &spans[below as usize];
                order.is_below(below, span, 0, slab) && order.is_below(below, span, 1, slab)
            };
            before.push(below);
            if fits {
                match tops.get_mut(pile) {
                    // Of two as close together as not to be told apart, the lower one leaves more room.
                    Some(top) if order.is_exact || span.heights[1] < spans[*top as usize].heights[1] => {
                        *top = index(i);
                    }
                    Some(_) => {}
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
    pub(super) fn sort_out_followers(&mut self, slab: Slab) {
        let mut spans = std::mem::take(&mut self.spans);
        self.followers.clear();
        spans.retain(|span| {
            let followed = self.followed(span, slab);
            self.followers.extend(followed.map(|place| (place, span.bar)));
            followed.is_none()
        });
        self.spans = spans;
        self.followers.sort_unstable_by_key(|&(place, bar)| (place, bar.id));
    }

    /// The rung that a span follows: one that ends alike and is near at both sides or, where spans have an exact order, on
    /// its line.
    fn followed(&self, span: &SpanningSegment, slab: Slab) -> Option<usize> {
        let order = self.order();
        let is_near = |rung: &SpanningSegment| {
            let is_tied = |side: usize| (rung.heights[side] - span.heights[side]).abs() <= self.slack;
            let is_on = |&rank: &u32| order.at(rung.bar, span.bar, rank).is_eq();
            is_tied(0) && is_tied(1) && (!order.is_exact || slab.iter().all(is_on))
        };
        let left = self.near(span.bar, span.line, 0, slab, None);
        if left.is_empty() {
            return None;
        }
        let right = self.near(span.bar, span.line, 1, slab, Some(left.start));
        let near = left.start.max(right.start)..left.end.min(right.end);
        let ends_alike = |rung: RankedSegment| {
            [0, 1].iter().all(|&side| self.ends_at(rung, side, slab) == self.ends_at(span.bar, side, slab))
        };
        let follows = |&place: &usize| ends_alike(self.rungs[place].bar) && is_near(&self.rungs[place]);
        near.take(FEW).find(follows)
    }

    /// Whether an edge ends at a side of a slab: where there is an exact order, at its abscissa, so that of edges on one line
    /// both end there or none.
    fn ends_at(&self, bar: RankedSegment, side: usize, slab: Slab) -> bool {
        let (end, at) = (bar.ranks[side], slab[side]);
        end == at || (self.reach == 0.0 && self.ends[end as usize].x == self.ends[at as usize].x)
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
                let is_near = heights[0] - left <= 3.0 * self.slack || heights[1] - right <= 3.0 * self.slack;
                other == place || (is_near && self.reach > 0.0)
            };
            for &(_, f) in self.followers[i + 1..].iter().take_while(|(other, _)| are_near(*other)) {
                if self.may_meet(e, f, slab) {
                    self.found.add(std::iter::once([e.id, f.id]), true);
                }
            }
        }
    }

    /// Finds the rungs, and if asked for their followers, that an edge may meet in a slab.
    pub(super) fn compare(&mut self, bar: RankedSegment, slab: Slab, with_followers: bool) {
        let line = self.line(bar, slab);
        let left = self.near(bar, line, 0, slab, None);
        // Most edges meet none, and are between the same two all the way.
        let right = self.near(bar, line, 1, slab, Some(left.start));
        self.compare_near(bar, left.clone(), 0, slab, with_followers);
        self.compare_near(bar, right.clone(), 1, slab, with_followers);
        let crossed = if left.end < right.start { left.end..right.start } else { right.end..left.start };
        self.add_rungs(bar, crossed.clone(), false);
        if with_followers {
            self.add_followers(bar, crossed, false);
        }
    }

    /// Takes the rungs near an edge at a side, but for fans that start or end with the edge: these do not meet it there.
    #[inline]
    fn compare_near(
        &mut self,
        bar: RankedSegment,
        near: Range<usize>,
        side: usize,
        slab: Slab,
        with_followers: bool,
    ) {
        let mut start = near.start;
        while start < near.end {
            let rung = self.rungs[start].bar;
            let end = near.end.min(self.fans[start][side] as usize);
            let is_shared = rung.ranks[side] == bar.ranks[side];
            if !is_shared {
                self.add_rungs(bar, start..end, true);
            }
            // Where a fan ends with the edge, so do its followers.
            if with_followers && !(is_shared && self.ends_at(rung, side, slab)) {
                self.add_followers(bar, start..end, true);
            }
            start = end;
        }
    }

    fn add_rungs(&mut self, bar: RankedSegment, rungs: Range<usize>, is_near: bool) {
        if rungs.start < rungs.end {
            let SlabDecomposition { rungs: all, found, ends, reach, .. } = self;
            let meets = |other: &RankedSegment| other.meets(bar, ends, *reach);
            let others = all[rungs].iter().map(|rung| rung.bar);
            found.add(others.filter(meets).map(|other| [bar.id, other.id]), is_near);
        }
    }

    fn add_followers(&mut self, bar: RankedSegment, rungs: Range<usize>, is_near: bool) {
        if rungs.start < rungs.end && !self.followers.is_empty() {
            let SlabDecomposition { followers, found, ends, reach, .. } = self;
            let first = followers.partition_point(|&(place, _)| place < rungs.start);
            let others = followers[first..].iter().take_while(|&&(place, _)| place < rungs.end);
            let meets = |other: &RankedSegment| other.meets(bar, ends, *reach);
            found.add(others.map(|&(_, other)| other).filter(meets).map(|other| [bar.id, other.id]), is_near);
        }
    }

    /// Of the place where an edge enters or leaves a slab or ends in it, the rungs that may go through it.
    #[inline]
    fn near(
        &self,
        bar: RankedSegment,
        line: Line,
        side: usize,
        slab: Slab,
        guess: Option<usize>,
    ) -> Range<usize> {
        let rank = bar.ranks[side].clamp(slab[0], slab[1]);
        let height = self.height(bar.ranks, line, rank);
        let at = |rung: &SpanningSegment| {
            if rank == slab[side] { rung.heights[side] } else { self.height_inside(rung, rank) }
        };
        // Followers are within one slack of their rung, and may touch within one more.
        let is_below = |rung: &SpanningSegment| at(rung) + 3.0 * self.slack < height;
        let may_touch = |rung: &SpanningSegment| at(rung) <= height + 3.0 * self.slack;
        let fits = |&guess: &usize| {
            self.rungs[..guess].last().is_none_or(is_below) && !self.rungs.get(guess).is_some_and(is_below)
        };
        let first = guess.filter(fits).unwrap_or_else(|| self.rungs.partition_point(is_below));
        match self.rungs.get(first) {
            Some(rung) if may_touch(rung) => {
                let near = first..first + self.rungs[first..].partition_point(may_touch);
                if near.len() > FEW && self.reach == 0.0 { self.touched(bar, rank, near) } else { near }
            }
            _ => first..first,
        }
    }

    /// Of the rungs near the place where an edge has a rank, those that it touches there, or an empty range between those
    /// below it and those above.
    #[cold]
    fn touched(&self, bar: RankedSegment, rank: u32, near: Range<usize>) -> Range<usize> {
        let order = self.order();
        let [a, b] = self.segment(bar);
        let is_point = bar.ranks.contains(&rank) || a.x == b.x;
        let place = |rung: &SpanningSegment| {
            if is_point { order.to_point(rung.bar, rank) } else { order.at(rung.bar, bar, rank) }
        };
        let rungs = &self.rungs[near.clone()];
        let below = rungs.partition_point(|rung| place(rung).is_lt());
        let on = rungs[below..].partition_point(|rung| place(rung).is_eq());
        near.start + below..near.start + below + on
    }

    pub(super) fn order(&self) -> Order<'_> {
        Order { ends: &self.ends, slack: self.slack, is_exact: self.reach == 0.0 }
    }

    /// Finds for each rung where those end that come after it and share its left end, or its right one.
    fn find_fans(&mut self) {
        let SlabDecomposition { rungs, fans, .. } = self;
        fans.clear();
        fans.resize(rungs.len(), [index(rungs.len()); 2]);
        for i in (1..rungs.len()).rev() {
            for side in [0, 1] {
                let is_shared = rungs[i - 1].bar.ranks[side] == rungs[i].bar.ranks[side];
                fans[i - 1][side] = if is_shared { fans[i][side] } else { index(i) };
            }
        }
    }
}
