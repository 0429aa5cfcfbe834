//! The edges that span a slab: which of them are its stairs, which are coincident with a stair, and what else meets them.

use super::order::Order;
use super::segments::{Line, NONE, RankedSegment, Slab, SpanningSegment};
use super::{FEW, SlabDecomposition};
use crate::base::id::index;
use std::ops::Range;

impl SlabDecomposition {
    /// Takes the open edges that span a slab, and sorts them by their heights.
    pub(super) fn sort_out_spanning(&mut self, slab: Slab, start: usize) {
        let mut kept = start;
        for i in start..self.open.len() {
            let segment = self.open[i];
            if segment.ranks[0] <= slab[0] && slab[1] <= segment.ranks[1] {
                let line = self.line(segment, slab);
                let heights = slab.map(|rank| self.height(segment.ranks, line, rank));
                self.spanning.push(SpanningSegment { heights, line, segment });
            } else {
                self.open[kept] = segment;
                kept += 1;
            }
        }
        self.open.truncate(kept);
        self.sort_spanning(slab);
    }

    /// Sorts keys, which are smaller than spanning segments. What heights do not tell apart is then sorted exactly, unless all
    /// that comes near is asked for.
    fn sort_spanning(&mut self, slab: Slab) {
        let SlabDecomposition { spanning, stairs, keys, ends, slack, reach, .. } = self;
        keys.clear();
        keys.extend(spanning.iter().zip(0..).map(|(span, place)| (span.heights[0], place)));
        keys.sort_unstable_by(|a, b| {
            a.0.total_cmp(&b.0).then_with(|| {
                let [a, b] = [a, b].map(|key| &spanning[key.1 as usize]);
                let by_heights = a.heights[1].total_cmp(&b.heights[1]);
                by_heights.then_with(|| a.line.order(&b.line)).then(a.segment.id.cmp(&b.segment.id))
            })
        });
        stairs.clear();
        stairs.extend(keys.iter().map(|key| spanning[key.1 as usize]));
        std::mem::swap(spanning, stairs);
        let order = Order { ends, slack: *slack, is_exact: *reach == 0.0 };
        if order.is_exact {
            let is_tied =
                |a: &SpanningSegment, b: &SpanningSegment| b.heights[0] - a.heights[0] <= order.slack;
            for tied in spanning.chunk_by_mut(is_tied).filter(|tied| tied.len() > 1) {
                tied.sort_by(|a, b| order.compare(a, b, slab));
            }
        }
    }

    /// Moves as many spanning segments as may be, none of which meets another, to the stairs.
    ///
    /// The segments are in order at the left side. Those that are in order at the right side, too, are an increasing
    /// subsequence; the longest one is found by patience sorting: `tops` has for each length the segment that ends a sequence
    /// of that length lowest at the right side, `before` the segment that precedes each in its sequence.
    pub(super) fn choose_stairs(&mut self, slab: Slab) {
        let SlabDecomposition { spanning, stairs, tops, before, .. } = self;
        let order = Order { ends: &self.ends, slack: self.slack, is_exact: self.reach == 0.0 };
        tops.clear();
        before.clear();
        for (i, span) in spanning.iter().enumerate() {
            let pile = tops.partition_point(|&top| order.is_below(&spanning[top as usize], span, 1, slab));
            let below = pile.checked_sub(1).map_or(NONE, |pile| tops[pile]);
            let fits = below == NONE || {
                let below = &spanning[below as usize];
                order.is_below(below, span, 0, slab) && order.is_below(below, span, 1, slab)
            };
            before.push(below);
            if fits {
                match tops.get_mut(pile) {
                    // Of two as close together as not to be told apart, the lower one leaves more room.
                    Some(top) if order.is_exact || span.heights[1] < spanning[*top as usize].heights[1] => {
                        *top = index(i);
                    }
                    Some(_) => {}
                    None => tops.push(index(i)),
                }
            }
        }
        stairs.clear();
        let mut next = tops.last().copied().unwrap_or(NONE);
        while next != NONE {
            stairs.push(spanning[next as usize]);
            spanning[next as usize].segment.id = NONE;
            next = before[next as usize];
        }
        stairs.reverse();
        spanning.retain(|span| span.segment.id != NONE);
        self.find_fans();
    }

    /// Takes the spanning segments that are coincident with a stair.
    pub(super) fn sort_out_coincident(&mut self, slab: Slab) {
        let mut spanning = std::mem::take(&mut self.spanning);
        self.coincident.clear();
        spanning.retain(|span| {
            let coincides_with = self.coincides_with(span, slab);
            self.coincident.extend(coincides_with.map(|place| (place, span.segment)));
            coincides_with.is_none()
        });
        self.spanning = spanning;
        self.coincident.sort_unstable_by_key(|&(place, segment)| (place, segment.id));
    }

    /// The stair that a spanning segment is coincident with: one that ends alike and is near at both sides or, where there is an
    /// exact order, on its line.
    fn coincides_with(&self, span: &SpanningSegment, slab: Slab) -> Option<usize> {
        let order = self.order();
        let is_near = |stair: &SpanningSegment| {
            let is_tied = |side: usize| (stair.heights[side] - span.heights[side]).abs() <= self.slack;
            let is_on = |&rank: &u32| order.at(stair.segment, span.segment, rank).is_eq();
            is_tied(0) && is_tied(1) && (!order.is_exact || slab.iter().all(is_on))
        };
        let left = self.near(span.segment, span.line, 0, slab, None);
        if left.is_empty() {
            return None;
        }
        let right = self.near(span.segment, span.line, 1, slab, Some(left.start));
        let near = left.start.max(right.start)..left.end.min(right.end);
        let ends_alike = |stair: RankedSegment| {
            [0, 1]
                .iter()
                .all(|&side| self.ends_at(stair, side, slab) == self.ends_at(span.segment, side, slab))
        };
        let follows = |&place: &usize| ends_alike(self.stairs[place].segment) && is_near(&self.stairs[place]);
        near.take(FEW).find(follows)
    }

    /// Whether an edge ends at a side of a slab: where there is an exact order, at its abscissa, so that of edges on one line
    /// both end there or none.
    fn ends_at(&self, segment: RankedSegment, side: usize, slab: Slab) -> bool {
        let (end, at) = (segment.ranks[side], slab[side]);
        end == at || (self.reach == 0.0 && self.ends[end as usize].x == self.ends[at as usize].x)
    }

    /// Finds the pairs that may meet in a slab of coincident segments and stairs, and of coincident segments of one stair or of
    /// stairs near one another.
    pub(super) fn compare_coincident(&mut self, slab: Slab) {
        for i in 0..self.coincident.len() {
            self.compare(self.coincident[i].1, slab, false);
        }
        for (i, &(place, e)) in self.coincident.iter().enumerate() {
            let [left, right] = self.stairs[place].heights;
            let are_near = |other: usize| {
                let heights = self.stairs[other].heights;
                let is_near = heights[0] - left <= 3.0 * self.slack || heights[1] - right <= 3.0 * self.slack;
                other == place || (is_near && self.reach > 0.0)
            };
            for &(_, f) in self.coincident[i + 1..].iter().take_while(|(other, _)| are_near(*other)) {
                if self.may_meet(e, f, slab) {
                    self.found.add(std::iter::once([e.id, f.id]), true);
                }
            }
        }
    }

    /// Finds the stairs, and if asked for their coincident segments, that an edge may meet in a slab.
    pub(super) fn compare(&mut self, segment: RankedSegment, slab: Slab, with_coincident: bool) {
        let line = self.line(segment, slab);
        let left = self.near(segment, line, 0, slab, None);
        // Most edges meet none, and are between the same two all the way.
        let right = self.near(segment, line, 1, slab, Some(left.start));
        self.compare_near(segment, left.clone(), 0, slab, with_coincident);
        self.compare_near(segment, right.clone(), 1, slab, with_coincident);
        let crossed = if left.end < right.start { left.end..right.start } else { right.end..left.start };
        self.add_stairs(segment, crossed.clone(), false);
        if with_coincident {
            self.add_coincident(segment, crossed, false);
        }
    }

    /// Takes the stairs near an edge at a side, but for fans that start or end with the edge: these do not meet it there.
    #[inline]
    fn compare_near(
        &mut self,
        segment: RankedSegment,
        near: Range<usize>,
        side: usize,
        slab: Slab,
        with_coincident: bool,
    ) {
        let mut start = near.start;
        while start < near.end {
            let stair = self.stairs[start].segment;
            let end = near.end.min(self.fans[start][side] as usize);
            let is_shared = stair.ranks[side] == segment.ranks[side];
            if !is_shared {
                self.add_stairs(segment, start..end, true);
            }
            // Where a fan ends with the edge, so do its coincident segments.
            if with_coincident && !(is_shared && self.ends_at(stair, side, slab)) {
                self.add_coincident(segment, start..end, true);
            }
            start = end;
        }
    }

    fn add_stairs(&mut self, segment: RankedSegment, stairs: Range<usize>, is_near: bool) {
        if stairs.start < stairs.end {
            let SlabDecomposition { stairs: all, found, ends, reach, .. } = self;
            let meets = |other: &RankedSegment| other.meets(segment, ends, *reach);
            let others = all[stairs].iter().map(|stair| stair.segment);
            found.add(others.filter(meets).map(|other| [segment.id, other.id]), is_near);
        }
    }

    fn add_coincident(&mut self, segment: RankedSegment, stairs: Range<usize>, is_near: bool) {
        if stairs.start < stairs.end && !self.coincident.is_empty() {
            let SlabDecomposition { coincident, found, ends, reach, .. } = self;
            let first = coincident.partition_point(|&(place, _)| place < stairs.start);
            let others = coincident[first..].iter().take_while(|&&(place, _)| place < stairs.end);
            let meets = |other: &RankedSegment| other.meets(segment, ends, *reach);
            found.add(
                others.map(|&(_, other)| other).filter(meets).map(|other| [segment.id, other.id]),
                is_near,
            );
        }
    }

    /// Of the place where an edge enters or leaves a slab or ends in it, the stairs that may go through it.
    #[inline]
    fn near(
        &self,
        segment: RankedSegment,
        line: Line,
        side: usize,
        slab: Slab,
        guess: Option<usize>,
    ) -> Range<usize> {
        let rank = segment.ranks[side].clamp(slab[0], slab[1]);
        let height = self.height(segment.ranks, line, rank);
        let at = |stair: &SpanningSegment| {
            if rank == slab[side] { stair.heights[side] } else { self.height_inside(stair, rank) }
        };
        // Coincident segments are within one slack of their stair, and may touch within one more.
        let is_below = |stair: &SpanningSegment| at(stair) + 3.0 * self.slack < height;
        let may_touch = |stair: &SpanningSegment| at(stair) <= height + 3.0 * self.slack;
        let fits = |&guess: &usize| {
            self.stairs[..guess].last().is_none_or(is_below) && !self.stairs.get(guess).is_some_and(is_below)
        };
        let first = guess.filter(fits).unwrap_or_else(|| self.stairs.partition_point(is_below));
        match self.stairs.get(first) {
            Some(stair) if may_touch(stair) => {
                let near = first..first + self.stairs[first..].partition_point(may_touch);
                if near.len() > FEW && self.reach == 0.0 { self.touched(segment, rank, near) } else { near }
            }
            _ => first..first,
        }
    }

    /// Of the stairs near the place where an edge has a rank, those that it touches there, or an empty range between those
    /// below it and those above.
    #[cold]
    fn touched(&self, segment: RankedSegment, rank: u32, near: Range<usize>) -> Range<usize> {
        let order = self.order();
        let [a, b] = self.ends_of(segment);
        let is_point = segment.ranks.contains(&rank) || a.x == b.x;
        let place = |stair: &SpanningSegment| {
            if is_point {
                order.to_point(stair.segment, rank)
            } else {
                order.at(stair.segment, segment, rank)
            }
        };
        let stairs = &self.stairs[near.clone()];
        let below = stairs.partition_point(|stair| place(stair).is_lt());
        let on = stairs[below..].partition_point(|stair| place(stair).is_eq());
        near.start + below..near.start + below + on
    }

    pub(super) fn order(&self) -> Order<'_> {
        Order { ends: &self.ends, slack: self.slack, is_exact: self.reach == 0.0 }
    }

    /// Finds for each stair where those end that come after it and share its left end, or its right one.
    fn find_fans(&mut self) {
        let SlabDecomposition { stairs, fans, .. } = self;
        fans.clear();
        fans.resize(stairs.len(), [index(stairs.len()); 2]);
        for i in (1..stairs.len()).rev() {
            for side in [0, 1] {
                let is_shared = stairs[i - 1].segment.ranks[side] == stairs[i].segment.ranks[side];
                fans[i - 1][side] = if is_shared { fans[i][side] } else { index(i) };
            }
        }
    }
}
