//! The way from the widest slabs to the narrowest, and from left to right.
//!
//! ```text
//!  |    |    |    |   The edges that come into a slab stand in their order at its left side. They pass through its parts
//!  |----+----+----|   one after the other, and their order is restored at each side, where they cross and where they end.
//!  |   _|____|____|   What starts in a part comes out of that in its order, too, and is merged with what passes. Only
//!  |--+-+-/  | \__|   what starts in the narrowest slabs is sorted. Edges that start in a part are a run of all edges,
//!  |    |    |    |   sorted by their left ends.
//! ```

use super::SlabDecomposition;
use super::segments::{ClippedSegment, RankedSegment, Slab, parts};
use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, sort::sort, threads::Threads};
use std::{cmp::Ordering, ops::Range};

/// So many sequences of stairs are taken from a slab's spanning segments, before the rest is handed on.
const ROUNDS: usize = 3;

/// By so many steps for each edge an order is restored; then it is sorted.
const STEPS: usize = 16;

/// So many edges are compared with one another, each with each.
const FEW_EDGES: usize = 32;

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
pub(super) fn by_height(a: &ClippedSegment, b: &ClippedSegment) -> Ordering {
    a.heights[0].total_cmp(&b.heights[0])
}

#[inline]
fn is_lower(a: &ClippedSegment, b: &ClippedSegment) -> bool {
    a.heights[0] < b.heights[0]
}

impl SlabDecomposition {
    /// Looks into the slab of all ends.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn look_into_all(&mut self, search: Search<'_>) -> Result<(), Refusal> {
        self.passing.clear();
        self.starting.clear();
        let Some(last) = self.ends.len().checked_sub(1) else { return Ok(()) };
        let starts = self.starting_before(0..self.segments.len(), 1);
        self.start(0, starts.clone());
        self.merge(0);
        self.descend([0, index(last)], 0, starts.end..self.segments.len(), search)
    }

    /// Some of all edges, under their places for ids.
    pub(super) fn edges(&self, places: Range<usize>) -> impl Iterator<Item = RankedSegment> + Clone + '_ {
        let ids = index(places.start)..;
        self.segments[places].iter().zip(ids).map(|(segment, id)| RankedSegment { id, ..*segment })
    }

    /// Of edges, those that start before a rank.
    pub(super) fn starting_before(&self, edges: Range<usize>, rank: u32) -> Range<usize> {
        let count = self.segments[edges.clone()].partition_point(|segment| segment.ranks[0] < rank);
        edges.start..edges.start + count
    }

    /// Looks into a slab that the edges passing from `base` on come into, and that others start in; leaves those passing that
    /// go beyond it, in their order there.
    fn descend(
        &mut self,
        slab: Slab,
        base: usize,
        starts: Range<usize>,
        search: Search<'_>,
    ) -> Result<(), Refusal> {
        if self.passing.len() - base + starts.len() <= FEW_EDGES {
            self.look_at_few(slab, base, starts.clone(), search)?;
            self.pass_all(slab[1], base, starts);
            return Ok(());
        }
        let threads = Threads::for_edges(self.passing.len() - base + starts.len());
        if threads.are_many() {
            return self.fork(slab, base, starts, search, threads);
        }
        let mut rest = starts;
        for part in parts(slab) {
            let inside = self.starting_before(rest.clone(), part[1]);
            let at_end = self.starting_before(inside.end..rest.end, part[1] + 1);
            rest.start = at_end.end;
            self.look_into(part, base, inside, search)?;
            if self.found.is_over() {
                break;
            }
            self.start(part[1], at_end);
            self.merge(base);
        }
        Ok(())
    }

    /// Finds what is asked for between the stairs of a slab and all else in it; then, of what is left, in its parts. Leaves
    /// passing what goes beyond it, and in `starting` what started in it and does so.
    pub(super) fn look_into(
        &mut self,
        slab: Slab,
        base: usize,
        starts: Range<usize>,
        search: Search<'_>,
    ) -> Result<(), Refusal> {
        let Search { quest, meter } = search;
        let is_column = quest == Quest::Pairs && self.is_column(slab);
        if is_column {
            self.look_into_column(slab, base, starts.clone(), meter)?;
        }
        let child = self.passing.len();
        if is_column || (quest == Quest::Below && self.queries_in(slab).is_empty()) {
            self.pass_all(slab[1], child, starts);
        } else {
            self.sort_out(slab, base, starts.clone(), meter)?;
            self.look_at_spanning(slab, search)?;
            if slab[1] - slab[0] > 1 && !self.found.is_over() {
                self.hand_on(slab, meter)?;
                self.descend(slab, child, starts, search)?;
            }
        }
        self.starting.clear();
        let started = self.passing[child..].iter().filter(|passing| passing.segment.ranks[0] > slab[0]);
        self.starting.extend(started);
        self.passing.truncate(child);
        self.pass(slab[1], base);
        Ok(())
    }

    /// Finds what is asked for between the stairs of a slab and all else in it: at first all that spans it may be stairs.
    fn look_at_spanning(&mut self, slab: Slab, search: Search<'_>) -> Result<(), Refusal> {
        let is_last = slab[1] - slab[0] == 1;
        let mut round = 0;
        while !self.stairs.is_empty() && !self.found.is_over() {
            round += 1;
            search.meter.spend(self.stairs.len())?;
            self.choose_stairs(slab);
            match search.quest {
                Quest::Pairs => self.compare_stairs(slab, search.meter)?,
                Quest::Below => self.look_at_queries(slab, search.meter)?,
            }
            self.stairs.clear();
            if round < ROUNDS || is_last {
                self.stairs.append(&mut self.spanning);
            }
        }
        Ok(())
    }

    pub(super) fn is_column(&self, [left, right]: Slab) -> bool {
        self.ends[left as usize].x == self.ends[right as usize].x
    }

    /// Takes apart the edges that span a slab, in their order, and those that end or start in it.
    fn sort_out(
        &mut self,
        slab: Slab,
        base: usize,
        starts: Range<usize>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let (mut stairs, mut partial) = (std::mem::take(&mut self.stairs), std::mem::take(&mut self.partial));
        self.spanning.clear();
        stairs.clear();
        partial.clear();
        meter.for_each(&self.passing[base..], |passing| {
            let right = passing.segment.ranks[1].min(slab[1]);
            let clipped =
                ClippedSegment { heights: [passing.heights[0], self.height(passing, right)], ..*passing };
            if right == slab[1] { stairs.push(clipped) } else { partial.push(clipped) }
        })?;
        meter.extend(&mut partial, self.edges(starts).map(|segment| self.clip(segment, slab)))?;
        (self.stairs, self.partial) = (stairs, partial);
        self.sort_ties(slab, meter)
    }

    /// Lets the edges that are left of a slab's spanning segments, and those that end in it, pass into its parts.
    fn hand_on(&mut self, slab: Slab, meter: &Meter<'_>) -> Result<(), Refusal> {
        sort(&mut self.spanning, by_height, meter)?;
        let mut left = self.spanning.iter().peekable();
        for ending in self.partial.iter().take_while(|ending| ending.segment.ranks[0] <= slab[0]) {
            while let Some(span) = left.next_if(|span| is_lower(span, ending)) {
                self.passing.push(*span);
            }
            self.passing.push(*ending);
        }
        self.passing.extend(left);
        Ok(())
    }

    /// Moves the passing edges on to a rank that some of them do not reach.
    fn pass(&mut self, rank: u32, base: usize) {
        let p = self.ends[rank as usize];
        let mut kept = base;
        let mut steps = STEPS * (self.passing.len() - base);
        for i in base..self.passing.len() {
            let mut passing = self.passing[i];
            if passing.segment.ranks[1] > rank {
                passing.heights[0] = self.height_inside(&passing, p);
                let mut at = kept;
                while at > base && steps > 0 && is_lower(&passing, &self.passing[at - 1]) {
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
    }

    /// The same with edges that start before the rank.
    fn pass_all(&mut self, rank: u32, base: usize, starts: Range<usize>) {
        let mut passing = std::mem::take(&mut self.passing);
        passing.extend(self.edges(starts).map(|segment| self.clip(segment, [segment.ranks[0]; 2])));
        self.passing = passing;
        self.pass(rank, base);
    }

    /// Adds edges that start at a rank to those that started before.
    fn start(&mut self, rank: u32, starts: Range<usize>) {
        let mut starting = std::mem::take(&mut self.starting);
        let height = self.ends[rank as usize].y;
        let place = starting.partition_point(|other| other.heights[0] < height);
        starting.splice(place..place, self.edges(starts).map(|segment| self.clip(segment, [rank; 2])));
        self.starting = starting;
    }

    /// Merges what started into what is passing.
    fn merge(&mut self, base: usize) {
        let SlabDecomposition { passing, starting, .. } = self;
        let mut from = passing.len();
        passing.extend_from_slice(starting);
        let mut to = passing.len();
        while let Some(last) = starting.last() {
            to -= 1;
            if from > base && is_lower(last, &passing[from - 1]) {
                from -= 1;
                passing[to] = passing[from];
            } else {
                passing[to] = *last;
                starting.pop();
            }
        }
    }

    /// Looks at each of a few edges in a slab.
    fn look_at_few(
        &mut self,
        slab: Slab,
        base: usize,
        starts: Range<usize>,
        Search { quest, meter }: Search<'_>,
    ) -> Result<(), Refusal> {
        let mut few = std::mem::take(&mut self.partial);
        few.clear();
        few.extend(self.passing[base..].iter().map(|passing| {
            let right = self.height(passing, passing.segment.ranks[1].min(slab[1]));
            ClippedSegment { heights: [passing.heights[0], right], ..*passing }
        }));
        few.extend(self.edges(starts).map(|segment| self.clip(segment, slab)));
        match quest {
            Quest::Pairs => self.compare_all(slab, &few),
            Quest::Below => {
                let queries = self.queries_in(slab);
                meter.for_each(queries, |query| {
                    few.iter().for_each(|edge| self.look_at(query, edge.segment));
                })?;
            }
        }
        self.partial = few;
        self.found.check(meter)
    }

    /// Finds the pairs among a few edges that may meet in a slab.
    fn compare_all(&mut self, slab: Slab, few: &[ClippedSegment]) {
        for (i, e) in few.iter().enumerate() {
            let [low, high] =
                [e.heights[0].min(e.heights[1]) - self.slack, e.heights[0].max(e.heights[1]) + self.slack];
            for f in &few[..i] {
                let is_beside = f.heights[0].max(f.heights[1]) < low || high < f.heights[0].min(f.heights[1]);
                if !is_beside && self.may_meet(e, f, slab) {
                    self.found.add(std::iter::once(([e.segment.id, f.segment.id], true)), false);
                }
            }
        }
    }
}
