//! The edges that span a slab: which of them are its stairs, which are coincident with a stair, and what else meets them.

use super::order::Order;
use super::segments::{ClippedSegment, RankedSegment, Slab};
use super::{FEW, SlabDecomposition};
use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, sort::sort};
use glam::DVec2;
use std::ops::Range;

impl SlabDecomposition {
    /// Sorts spanning segments whose heights at the left side do not tell them apart: exactly, unless all that comes near is
    /// asked for; those from one point by their other heights.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn sort_ties(&mut self, slab: Slab, meter: &Meter<'_>) -> Result<(), Refusal> {
        let SlabDecomposition { stairs, ends, slack, reach, .. } = self;
        let order = Order { ends, slack: *slack, is_exact: *reach == 0.0 };
        let is_tied = |a: &ClippedSegment, b: &ClippedSegment| b.heights[0] - a.heights[0] <= order.slack;
        for tied in stairs.chunk_by_mut(is_tied).filter(|tied| tied.len() > 1) {
            let compare = |a: &ClippedSegment, b: &ClippedSegment| {
                let by_height = |side: usize| a.heights[side].total_cmp(&b.heights[side]);
                match order.is_exact {
                    true => order.compare(a, b, slab),
                    false => by_height(0).then(by_height(1)).then(a.segment.id.cmp(&b.segment.id)),
                }
            };
            sort(tied, compare, meter)?;
        }
        Ok(())
    }

    /// Leaves of the stairs those of which none meets another, from below each that is above the last one; the rest are
    /// spanning segments still. Where all that comes near is asked for, each is higher than all but that one by more than
    /// the slack, at both sides.
    pub(super) fn choose_stairs(&mut self, slab: Slab) {
        let SlabDecomposition { spanning, stairs, fans, ends, slack, reach, .. } = self;
        let order = Order { ends, slack: *slack, is_exact: *reach == 0.0 };
        let (mut highest, mut last) = (DVec2::NEG_INFINITY, None);
        fans.clear();
        stairs.retain(|span| {
            let is_clear = order.is_exact || (highest + order.slack).cmplt(DVec2::from(span.heights)).all();
            let fits = last.as_ref().is_none_or(|last: &ClippedSegment| {
                is_clear && order.is_below(last, span, 0, slab) && order.is_below(last, span, 1, slab)
            });
            if fits {
                let before = last.replace(*span);
                highest = before.map_or(highest, |before| highest.max(before.heights.into()));
            } else {
                spanning.push(*span);
            }
            fits
        });
    }

    /// Finds the pairs that may meet in a slab of a stair and another edge; takes what is coincident with a stair from the
    /// spanning segments.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn compare_stairs(&mut self, slab: Slab, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.coincident.clear();
        if !self.spanning.is_empty() {
            self.sort_out_coincident(slab);
            self.compare_coincident(slab, meter)?;
            let mut guess = 0;
            for i in 0..self.spanning.len() {
                guess = self.compare(self.spanning[i], slab, true, Some(guess));
                self.found.check(meter)?;
            }
        }
        let mut guess = 0;
        for i in 0..self.partial.len() {
            let clipped = self.partial[i];
            let comes_in = clipped.segment.ranks[0] <= slab[0];
            guess = self.compare(clipped, slab, true, comes_in.then_some(guess));
            self.found.check(meter)?;
        }
        Ok(())
    }

    /// Takes the spanning segments that are coincident with a stair.
    fn sort_out_coincident(&mut self, slab: Slab) {
        let mut spanning = std::mem::take(&mut self.spanning);
        spanning.retain(|span| {
            let coincides_with = self.coincides_with(span, slab);
            self.coincident.extend(coincides_with.map(|place| (place, *span)));
            coincides_with.is_none()
        });
        self.spanning = spanning;
        self.coincident.sort_unstable_by_key(|&(place, span)| (place, span.segment.id));
    }

    /// The stair that a spanning segment is coincident with: one that ends alike and is near at both sides or, where there is an
    /// exact order, on its line.
    fn coincides_with(&self, span: &ClippedSegment, slab: Slab) -> Option<usize> {
        let order = self.order();
        let is_near = |stair: &ClippedSegment| {
            let is_tied = |side: usize| (stair.heights[side] - span.heights[side]).abs() <= self.slack;
            let is_on = |&rank: &u32| order.at(stair.segment, span.segment, rank).is_eq();
            is_tied(0) && is_tied(1) && (!order.is_exact || slab.iter().all(is_on))
        };
        let left = self.near(span, 0, slab, None);
        if left.is_empty() {
            return None;
        }
        let right = self.near(span, 1, slab, Some(left.start));
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
    fn compare_coincident(&mut self, slab: Slab, meter: &Meter<'_>) -> Result<(), Refusal> {
        for i in 0..self.coincident.len() {
            self.compare(self.coincident[i].1, slab, false, None);
            self.found.check(meter)?;
        }
        let mut tally = meter.tally();
        for (i, &(place, e)) in self.coincident.iter().enumerate() {
            let [left, right] = self.stairs[place].heights;
            let are_near = |other: usize| {
                let heights = self.stairs[other].heights;
                let is_near = heights[0] - left <= 3.0 * self.slack || heights[1] - right <= 3.0 * self.slack;
                other == place || (is_near && self.reach > 0.0)
            };
            for &(_, f) in self.coincident[i + 1..].iter().take_while(|(other, _)| are_near(*other)) {
                if self.may_meet(&e, &f, slab) {
                    self.found.add(std::iter::once(([e.segment.id, f.segment.id], true)), true);
                }
                tally.add(1)?;
            }
            self.found.check(meter)?;
        }
        Ok(())
    }

    /// Finds the stairs, and if asked for their coincident segments, that an edge may meet in a slab. Takes and returns the
    /// place among the stairs of an edge that enters the slab a little below, if there is one.
    fn compare(
        &mut self,
        clipped: ClippedSegment,
        slab: Slab,
        with_coincident: bool,
        guess: Option<usize>,
    ) -> usize {
        let left = self.near(&clipped, 0, slab, guess);
        // Most edges meet none, and are between the same two all the way.
        let right = self.near(&clipped, 1, slab, Some(left.start));
        if left.start == right.end && right.start == left.end {
            return left.start;
        }
        let place = left.start;
        self.compare_near(&clipped, left.clone(), 0, slab, with_coincident);
        self.compare_near(&clipped, right.clone(), 1, slab, with_coincident);
        let crossed = if left.end < right.start { left.end..right.start } else { right.end..left.start };
        self.add_stairs(&clipped, crossed.clone(), slab, false);
        if with_coincident {
            self.add_coincident(&clipped, crossed, slab, false);
        }
        place
    }

    /// Takes the stairs near an edge at a side, but for fans that start or end with the edge: these do not meet it there.
    #[inline]
    fn compare_near(
        &mut self,
        clipped: &ClippedSegment,
        near: Range<usize>,
        side: usize,
        slab: Slab,
        with_coincident: bool,
    ) {
        if self.fans.is_empty() && !near.is_empty() {
            self.find_fans();
        }
        let mut start = near.start;
        while start < near.end {
            let stair = self.stairs[start].segment;
            let end = near.end.min(self.fans[start][side] as usize);
            let is_shared = stair.ranks[side] == clipped.segment.ranks[side];
            if !is_shared {
                self.add_stairs(clipped, start..end, slab, true);
            }
            // Where a fan ends with the edge, so do its coincident segments.
            if with_coincident && !(is_shared && self.ends_at(stair, side, slab)) {
                self.add_coincident(clipped, start..end, slab, true);
            }
            start = end;
        }
    }

    fn add_stairs(&mut self, clipped: &ClippedSegment, stairs: Range<usize>, slab: Slab, is_near: bool) {
        if stairs.start < stairs.end {
            let mut found = std::mem::take(&mut self.found);
            let others = self.stairs[stairs].iter();
            found.add(others.filter_map(|other| self.pair(clipped, other, slab)), is_near);
            self.found = found;
        }
    }

    fn add_coincident(&mut self, clipped: &ClippedSegment, stairs: Range<usize>, slab: Slab, is_near: bool) {
        if stairs.start < stairs.end && !self.coincident.is_empty() {
            let mut found = std::mem::take(&mut self.found);
            let first = self.coincident.partition_point(|&(place, _)| place < stairs.start);
            let others = self.coincident[first..].iter().take_while(|&&(place, _)| place < stairs.end);
            found.add(others.filter_map(|(_, other)| self.pair(clipped, other, slab)), is_near);
            self.found = found;
        }
    }

    /// Two edges whose boxes meet, and whether they may be new.
    fn pair(&self, e: &ClippedSegment, f: &ClippedSegment, slab: Slab) -> Option<([u32; 2], bool)> {
        let meets = e.segment.meets(f.segment, &self.ends, self.reach);
        meets.then(|| ([e.segment.id, f.segment.id], !self.was_found(e, f, slab)))
    }

    /// Whether two edges come near one another where both come into a slab, and all that does is asked for. Then they were
    /// found further left, or share an end: see the module's page.
    pub(super) fn was_found(&self, e: &ClippedSegment, f: &ClippedSegment, slab: Slab) -> bool {
        let comes_in = |clipped: &ClippedSegment| {
            self.ends[clipped.segment.ranks[0] as usize].x < self.ends[slab[0] as usize].x
        };
        self.reach > 0.0 && (e.heights[0] - f.heights[0]).abs() <= self.slack && comes_in(e) && comes_in(f)
    }

    /// Of the place where an edge enters or leaves a slab or ends in it, the stairs that may go through it.
    #[inline]
    fn near(&self, clipped: &ClippedSegment, side: usize, slab: Slab, guess: Option<usize>) -> Range<usize> {
        let rank = clipped.segment.ranks[side].clamp(slab[0], slab[1]);
        let height = clipped.heights[side];
        let near = if rank == slab[side] {
            self.near_height(height, guess, |stair| stair.heights[side])
        } else {
            let p = self.ends[rank as usize];
            self.near_height(height, guess, |stair| self.height_inside(stair, p))
        };
        if near.len() > FEW && self.reach == 0.0 { self.touched(clipped.segment, rank, near) } else { near }
    }

    /// The stairs that may go through a height, by their heights there.
    #[inline]
    fn near_height(
        &self,
        height: f64,
        guess: Option<usize>,
        at: impl Fn(&ClippedSegment) -> f64,
    ) -> Range<usize> {
        // Coincident segments are within one slack of their stair, and may touch within one more.
        let [low, high] = [height - 3.0 * self.slack, height + 3.0 * self.slack];
        let is_below = |stair: &ClippedSegment| at(stair) < low;
        let may_touch = |stair: &ClippedSegment| at(stair) <= high;
        let fits = |&guess: &usize| {
            self.stairs[..guess].last().is_none_or(is_below) && !self.stairs.get(guess).is_some_and(is_below)
        };
        let first = guess.filter(fits).unwrap_or_else(|| self.stairs.partition_point(is_below));
        match self.stairs.get(first) {
            Some(stair) if may_touch(stair) => first..first + self.stairs[first..].partition_point(may_touch),
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
        let place = |stair: &ClippedSegment| {
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
    #[cold]
    fn find_fans(&mut self) {
        let SlabDecomposition { stairs, fans, .. } = self;
        fans.resize(stairs.len(), [index(stairs.len()); 2]);
        for i in (1..stairs.len()).rev() {
            for side in [0, 1] {
                let is_shared = stairs[i - 1].segment.ranks[side] == stairs[i].segment.ranks[side];
                fans[i - 1][side] = if is_shared { fans[i][side] } else { index(i) };
            }
        }
    }
}
