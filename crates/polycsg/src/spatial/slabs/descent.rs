//! The way from the widest slabs to the narrowest.
//!
//! The edges that come into a slab stand in their order at its left side. The parts of the slab are looked into from left to
//! right, and from part to part the order is mended: where edges cross, and where they start or end. So nothing is sorted
//! anew, and what starts in a part is a run of all edges, sorted by their left ends.

use super::SlabDecomposition;
use super::segments::{ClippedSegment, RankedSegment, Slab, parts};
use crate::base::{id::index, meter::Meter};
use std::{cmp::Ordering, ops::Range};

/// So many sequences of stairs are taken from a slab's spanning segments, before the rest is handed on.
const ROUNDS: usize = 3;

/// So many steps for each edge an order is mended by, before it is sorted.
const STEPS: usize = 16;

/// So many edges are compared with one another, each with each.
const FEW_EDGES: usize = 24;

/// What slabs are looked into for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quest {
    /// Pairs of edges that may meet.
    Pairs,
    /// What is below the queries.
    Below,
}

/// What slabs are looked into for, within which limits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search<'a> {
    pub(super) quest: Quest,
    pub(super) meter: &'a Meter<'a>,
}

/// By their heights at the left side.
fn by_height(a: &ClippedSegment, b: &ClippedSegment) -> Ordering {
    a.heights[0].total_cmp(&b.heights[0]).then(a.segment.id.cmp(&b.segment.id))
}

impl SlabDecomposition {
    /// Looks into the slab of all ends.
    pub(super) fn look_into_all(&mut self, search: Search<'_>) {
        self.passing.clear();
        let Some(last) = self.ends.len().checked_sub(1) else { return };
        let slab = [0, index(last)];
        let starts = self.starting_before(0..self.segments.len(), 1);
        self.pass(slab[0], 0, starts.clone());
        self.descend(slab, 0, starts.end..self.segments.len(), search);
    }

    /// Some of all edges, under their places for ids.
    pub(super) fn starting(&self, places: Range<usize>) -> impl Iterator<Item = RankedSegment> + Clone + '_ {
        let ids = index(places.start)..;
        self.segments[places].iter().zip(ids).map(|(segment, id)| RankedSegment { id, ..*segment })
    }

    /// Of edges, those that start before a rank.
    fn starting_before(&self, edges: Range<usize>, rank: u32) -> Range<usize> {
        let count = self.segments[edges.clone()].partition_point(|segment| segment.ranks[0] < rank);
        edges.start..edges.start + count
    }

    /// Looks into a slab that the edges passing from `base` on come into, and that others start in; forgets the former.
    fn descend(&mut self, slab: Slab, base: usize, starts: Range<usize>, search: Search<'_>) {
        if self.passing.len() - base + starts.len() <= FEW_EDGES {
            self.look_at_few(slab, base, starts, search.quest);
            return self.passing.truncate(base);
        }
        let mut rest = starts;
        for part in parts(slab) {
            let inside = self.starting_before(rest.clone(), part[1]);
            self.look_into(part, base, inside.clone(), search);
            if part[1] == slab[1] || self.found.is_over() {
                break;
            }
            let all = self.starting_before(rest.clone(), part[1] + 1);
            rest.start = all.end;
            self.pass(part[1], base, all);
        }
        self.passing.truncate(base);
    }

    /// Finds what is asked for between the stairs of a slab and all else in it; then, of what is left, in its parts.
    fn look_into(&mut self, slab: Slab, base: usize, starts: Range<usize>, search: Search<'_>) {
        let Search { quest, meter } = search;
        self.found.allow(meter.spend(self.passing.len() - base + starts.len()));
        if quest == Quest::Below && self.queries_in(slab).is_empty() {
            return;
        }
        if quest == Quest::Pairs && self.is_column(slab) {
            return self.look_into_column(slab, base, starts);
        }
        self.sort_out(slab, base, starts.clone());
        let is_last = slab[1] - slab[0] == 1;
        let mut round = 0;
        while !self.spanning.is_empty() && (round < ROUNDS || is_last) && !self.found.is_over() {
            round += 1;
            self.choose_stairs(slab);
            match quest {
                Quest::Pairs => self.compare_stairs(slab),
                Quest::Below => self.queries_in(slab).for_each(|query| self.look_at_stairs(query, slab)),
            }
        }
        if !is_last && !self.found.is_over() {
            let child = self.passing.len();
            self.hand_on(slab, base);
            self.descend(slab, child, starts, search);
        }
    }

    pub(super) fn is_column(&self, [left, right]: Slab) -> bool {
        self.ends[left as usize].x == self.ends[right as usize].x
    }

    /// Takes apart the edges that span a slab, in their order, and those that end or start in it.
    fn sort_out(&mut self, slab: Slab, base: usize, starts: Range<usize>) {
        let (mut spanning, mut partial) =
            (std::mem::take(&mut self.spanning), std::mem::take(&mut self.partial));
        spanning.clear();
        partial.clear();
        for passing in &self.passing[base..] {
            let right = passing.segment.ranks[1].min(slab[1]);
            let clipped =
                ClippedSegment { heights: [passing.heights[0], self.height(passing, right)], ..*passing };
            if right == slab[1] { spanning.push(clipped) } else { partial.push(clipped) }
        }
        partial.extend(self.starting(starts).map(|segment| self.clip(segment, slab)));
        (self.spanning, self.partial) = (spanning, partial);
        self.sort_ties(slab);
    }

    /// Lets the edges that are left of a slab's spanning segments, and those that end in it, pass into its parts.
    fn hand_on(&mut self, slab: Slab, base: usize) {
        self.spanning.sort_unstable_by(by_height);
        let mut left = self.spanning.iter().peekable();
        for i in base..self.passing.len() {
            let passing = self.passing[i];
            if passing.segment.ranks[1] < slab[1] {
                while let Some(span) = left.next_if(|span| by_height(span, &passing).is_lt()) {
                    self.passing.push(*span);
                }
                self.passing.push(passing);
            }
        }
        self.passing.extend(left);
    }

    /// Moves the passing edges on to a rank, with others that start before it or there.
    fn pass(&mut self, rank: u32, base: usize, starts: Range<usize>) {
        let p = self.ends[rank as usize];
        let mut kept = base;
        let mut steps = STEPS * (self.passing.len() - base);
        for i in base..self.passing.len() {
            let mut passing = self.passing[i];
            if passing.segment.ranks[1] > rank {
                passing.heights[0] = self.height_inside(&passing, p);
                let mut at = kept;
                while at > base && steps > 0 && by_height(&passing, &self.passing[at - 1]).is_lt() {
                    self.passing[at] = self.passing[at - 1];
                    at -= 1;
                    steps -= 1;
                }
                self.passing[at] = passing;
                kept += 1;
            }
        }
        self.passing.truncate(kept);
        if steps == 0 {
            self.passing[base..].sort_unstable_by(by_height);
        }
        self.start_at(rank, base, starts);
    }

    /// Merges edges that start before a rank or there into those that pass it.
    fn start_at(&mut self, rank: u32, base: usize, starts: Range<usize>) {
        let mut partial = std::mem::take(&mut self.partial);
        partial.clear();
        let reaches = |segment: &RankedSegment| segment.ranks[1] > rank;
        partial.extend(self.starting(starts).filter(reaches).map(|segment| {
            let clipped = self.clip(segment, [0, rank]);
            ClippedSegment { heights: [clipped.heights[1]; 2], ..clipped }
        }));
        partial.sort_unstable_by(by_height);
        let mut from = self.passing.len();
        self.passing.extend_from_slice(&partial);
        let mut to = self.passing.len();
        while let Some(last) = partial.last() {
            to -= 1;
            if from > base && by_height(last, &self.passing[from - 1]).is_lt() {
                from -= 1;
                self.passing[to] = self.passing[from];
            } else {
                self.passing[to] = *last;
                partial.pop();
            }
        }
        self.partial = partial;
    }

    /// Looks at each of a few edges in a slab.
    fn look_at_few(&mut self, slab: Slab, base: usize, starts: Range<usize>, quest: Quest) {
        let mut few = std::mem::take(&mut self.partial);
        few.clear();
        few.extend(self.passing[base..].iter().map(|passing| {
            let right = self.height(passing, passing.segment.ranks[1].min(slab[1]));
            ClippedSegment { heights: [passing.heights[0], right], ..*passing }
        }));
        few.extend(self.starting(starts).map(|segment| self.clip(segment, slab)));
        match quest {
            Quest::Pairs => self.compare_all(slab, &few),
            Quest::Below => {
                let queries = self.queries_in(slab);
                queries.for_each(|query| few.iter().for_each(|edge| self.look_at(query, edge.segment)));
            }
        }
        self.partial = few;
    }

    /// Finds the pairs among a few edges that may meet in a slab.
    fn compare_all(&mut self, slab: Slab, few: &[ClippedSegment]) {
        for (i, e) in few.iter().enumerate() {
            let [low, high] =
                [e.heights[0].min(e.heights[1]) - self.slack, e.heights[0].max(e.heights[1]) + self.slack];
            for f in &few[..i] {
                let is_beside = f.heights[0].max(f.heights[1]) < low || high < f.heights[0].min(f.heights[1]);
                if !is_beside && self.may_meet(e, f, slab) {
                    self.found.add(std::iter::once([e.segment.id, f.segment.id]), false);
                }
            }
        }
    }
}
