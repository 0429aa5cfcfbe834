//! The slab decomposition: which edges may meet, for inputs where boxes do not prune: long, nearly parallel edges.
//!
//! The plane is cut into slabs at the edges' ends, taken from left to right (of one abscissa, from below), and each slab is
//! cut in a few again and again. In the widest slabs that it crosses from side to side, an edge is a *spanning segment*:
//!
//! ```text
//!    slab            a, b, d, c span and do not meet: they are the slab's stairs, in one order at both sides.
//!   |      d_|__     e spans and crosses: it is compared with the stairs that it has between its two heights,
//!   |_c__----|-      and handed on to the parts of the slab for what else it may meet.
//!  _|--  _f /|       f ends here: it is compared with the stairs between its heights where it enters and where it
//!   |b__/__/_|__     ends, and handed on likewise.
//!  _|__a__/__|__
//!   |    e   |       So an edge costs O(log n) in each of O(log n) slabs, and each crossing O(log n) at most.
//! ```
//!
//! The stairs are those of I. J. Balaban, "An optimal algorithm for finding segment intersections", SoCG 1995: spanning
//! segments that do not cross within their slab, in one order, with which all other segments of the slab are compared by
//! search, while what is no stair goes on to the parts. As there, edges pass from slab to slab in their order, which is
//! restored where they cross, start or end. The differences: Balaban cuts in two and finds intersections where the order
//! changes, so that they cost O(1) each; here the order is that of rounded heights and decides nothing, slabs are cut in
//! more, up to three sequences of stairs are taken from a slab before the rest goes on, and spanning segments on the line of
//! a stair are set apart:
//!
//! Edges on the line of a stair are *coincident* with it. Whatever meets the stair is compared with them too, and like the
//! stair they are not handed on. Otherwise edges on one line would be compared in every slab.
//!
//! Heights are floats with a bound on their error. Where they do not tell two edges apart, the sides of their ends do, so
//! that thousands of edges within a few roundings of one another still have an order. The index reports too much and never
//! too little. Two edges with a common end are reported only if they may meet elsewhere too, so that a fan of edges costs
//! no more than other edges.
//!
//! The index can also report edges that come near one another without meeting. Then there is no such order: edges are *near*
//! at a side where their computed heights differ by no more than a wider error, the slack. Those near a stair at both sides
//! count as coincident with it. Two stairs are near one another only if they share an end:
//!
//! ```text
//!      _____c    Stairs are not compared with one another. It is not enough that each is clear of the one before or shares an
//!    b/___/      end with it: here b shares one with a, c the other one with b, and a and c are near. So each is clear
//!     \___a      of all stairs but the one before.
//! ```
//!
//! Edges that stay near would be found in slab after slab. So a pair is passed over where both come into a slab, from further
//! left, and are near there. It was found before, or shares an end:
//!
//! Both span the last slab with a width before this one, so one of the slabs that hold it was the last that had both; call it
//! `W`. It ends on the same vertical, where the heights are the same as here, bit for bit. In `W` both were compared: as a few
//! edges, each with each; or one was a stair and the other not, and the search looks three slacks around the other; or both
//! were coincident with stairs, which then are within three slacks, as far as coincident segments are compared; and two
//! stairs are not near. Where the pair was passed over in `W`, it was near at its left side, and the same holds there.

mod beside;
mod column;
mod descent;
mod fork;
mod found;
mod heights;
mod order;
mod ray_shooting;
mod segments;
mod spanning;
#[cfg(test)]
mod tests;

use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, sort::sort_on, threads::Threads};
use crate::predicates::{Segment, Side, lexicographic, side};
use descent::{Quest, Search};
use found::Found;
use glam::DVec2;
use segments::{ClippedSegment, RankedSegment, Slab};
use std::{cmp::Ordering, ops::Range, sync::Arc};

/// So many stairs near a place are taken as they are.
const FEW: usize = 8;

/// So many pairs for each edge may come near one another without meeting.
const NEAR: usize = 64;

/// Coordinates between this and its inverse have slopes.
const LEAST: f64 = f64::from_bits((1023 - 400) << 52);

/// `64u`, see [`SlabDecomposition::height`]: stairs keep their computed order between the slab's sides, too.
const SLACK: f64 = 64.0 * (f64::EPSILON / 2.0);

/// See the module's page.
#[derive(Debug, Default)]
pub(crate) struct SlabDecomposition {
    /// The distinct ends in their order.
    ends: Arc<Vec<DVec2>>,
    sorted: Vec<(DVec2, u32)>,
    /// Per point its rank.
    ranks: Vec<u32>,
    /// The edges, those with the same ends one after the other; `segments` has the first of each kind.
    all: Vec<RankedSegment>,
    segments: Arc<Vec<RankedSegment>>,
    /// Two heights that differ by more differ.
    error: f64,
    /// The same, or more where edges are reported that come near one another.
    slack: f64,
    /// How far boxes are widened.
    reach: f64,
    /// Whether all coordinates lie where slopes neither overflow nor lose bits.
    has_slopes: bool,
    /// The edges that come into the slab at hand, into its part at hand, and so on, with their places in `segments` for ids,
    /// each slab's in their order at its left side.
    passing: Vec<ClippedSegment>,
    /// What started in the slab just left behind and goes beyond it, in its order there.
    starting: Vec<ClippedSegment>,
    /// Of the segments that span the slab at hand its stairs and the rest, and the edges that end or start in it.
    spanning: Vec<ClippedSegment>,
    stairs: Vec<ClippedSegment>,
    partial: Vec<ClippedSegment>,
    /// The edges in a slab without width, and their heights and places.
    column: Vec<RankedSegment>,
    keys: Vec<(f64, u32)>,
    /// The segments that are coincident with a stair, by its place.
    coincident: Vec<(usize, ClippedSegment)>,
    /// Per stair where those end that come after it and share its left end, and its right one; empty until asked for.
    fans: Vec<[u32; 2]>,
    found: Found,
    /// Ranks of neighbouring abscissae.
    by_height: Vec<u32>,
    /// Points by rank, and of each one the segment found below it.
    queries: Vec<(u32, u32)>,
    nearest: Vec<u32>,
}

impl SlabDecomposition {
    /// Indexes edges between points, given by the numbers of their ends, under their ids.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn build(
        &mut self,
        points: impl Iterator<Item = DVec2>,
        edges: impl Iterator<Item = (u32, [u32; 2])>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let threads = self.rank(points, meter)?;
        let segment = |(id, ends): (u32, [u32; 2])| {
            let [a, b] = ends.map(|point| self.ranks[point as usize]);
            RankedSegment { ranks: [a.min(b), a.max(b)], id }
        };
        self.all.clear();
        meter.for_all(edges.map(segment), |segment| {
            self.all.extend((segment.ranks[0] < segment.ranks[1]).then_some(segment));
        })?;
        let key = |ranks: [u32; 2]| u64::from(ranks[0]) << 32 | u64::from(ranks[1]);
        sort_on(threads, &mut self.all, |a, b| (key(a.ranks), a.id).cmp(&(key(b.ranks), b.id)), meter)?;
        let segments = Arc::make_mut(&mut self.segments);
        segments.clear();
        let first_of_each = self.all.chunk_by(|a, b| a.ranks == b.ranks).map(|same| same[0]);
        meter.extend(segments, first_of_each)?;
        let highest = self.ends.iter().fold(0.0, |y: f64, p| y.max(p.y.abs()));
        self.error = highest * SLACK + f64::MIN_POSITIVE;
        self.narrow();
        let is_moderate = |x: f64| x == 0.0 || (LEAST..=1.0 / LEAST).contains(&x.abs());
        self.has_slopes = self.ends.iter().all(|p| is_moderate(p.x) && is_moderate(p.y));
        Ok(())
    }

    fn rank(&mut self, points: impl Iterator<Item = DVec2>, meter: &Meter<'_>) -> Result<Threads, Refusal> {
        self.sorted.clear();
        meter.extend(&mut self.sorted, points.zip(0..))?;
        let threads = Threads::for_edges(self.sorted.len());
        sort_on(threads, &mut self.sorted, |a, b| lexicographic(a.0, b.0).then(a.1.cmp(&b.1)), meter)?;
        let ends = Arc::make_mut(&mut self.ends);
        ends.clear();
        self.ranks.clear();
        self.ranks.resize(self.sorted.len(), 0);
        meter.for_each(&self.sorted[..], |&(point, number)| {
            if ends.last() != Some(&point) {
                ends.push(point);
            }
            self.ranks[number as usize] = index(ends.len() - 1);
        })?;
        Ok(threads)
    }

    /// The points by their numbers, those in one place together.
    pub(crate) fn places(&self) -> impl Iterator<Item = impl Iterator<Item = u32> + '_> + '_ {
        self.sorted.chunk_by(|a, b| a.0 == b.0).map(|place| place.iter().map(|&(_, number)| number))
    }

    /// The edges that have both ends in common with another one before them, with the first such.
    pub(crate) fn duplicates(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let same = self.all.chunk_by(|a, b| a.ranks == b.ranks);
        same.flat_map(|same| same[1..].iter().map(|segment| [same[0].id, segment.id]))
    }

    /// Calls `visit` once for each pair of edges that may meet but in one common end or both, by their ids; of edges with
    /// both ends in common, one stands for all against another such.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn pairs(
        &mut self,
        meter: &Meter<'_>,
        mut visit: impl FnMut(u32, u32),
    ) -> Result<(), Refusal> {
        self.find(usize::MAX, meter)?;
        let mut tally = meter.tally();
        self.visit(|e, f| {
            visit(e, f);
            tally.add(1)
        })
    }

    /// The same for the pairs that were found, until one fails.
    ///
    /// # Errors
    /// That of the first visit with one.
    pub(crate) fn visit(
        &self,
        mut visit: impl FnMut(u32, u32) -> Result<(), Refusal>,
    ) -> Result<(), Refusal> {
        for segments in self.found.pairs() {
            let [mut e, mut f] = segments.map(|segment| self.duplicates_of(segment));
            let [first, other] = [&e, &f].map(|same| self.all[same.start].id);
            visit(first, other)?;
            f.by_ref().skip(1).try_for_each(|g| visit(first, self.all[g].id))?;
            e.by_ref().skip(1).try_for_each(|g| visit(self.all[g].id, other))?;
        }
        Ok(())
    }

    /// The places in `all` of the edges that a segment stands for.
    fn duplicates_of(&self, segment: u32) -> Range<usize> {
        if self.all.len() == self.segments.len() {
            return segment as usize..segment as usize + 1;
        }
        let ranks = self.segments[segment as usize].ranks;
        let start = self.all.partition_point(|segment| segment.ranks < ranks);
        start..start + self.all[start..].iter().take_while(|segment| segment.ranks == ranks).count()
    }

    /// Finds the pairs; false, with nothing to visit, when there are more than so many, or too many that only come near one
    /// another.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn find(&mut self, most: usize, meter: &Meter<'_>) -> Result<bool, Refusal> {
        let near = if self.reach > 0.0 { NEAR * self.segments.len() } else { usize::MAX };
        self.found.start(most, near);
        self.queries.clear();
        self.look_into_all(Search { quest: Quest::Pairs, meter })?;
        Ok(!self.found.count(meter)?)
    }

    /// An edge, directed to the right.
    #[inline]
    fn ends_of(&self, segment: RankedSegment) -> Segment {
        segment.ranks.map(|rank| self.ends[rank as usize])
    }

    fn may_meet(&self, e: &ClippedSegment, f: &ClippedSegment, slab: Slab) -> bool {
        let (r, s) = (e.segment.ranks, f.segment.ranks);
        let (left, right) = (r[0].max(s[0]).max(slab[0]), r[1].min(s[1]).min(slab[1]));
        if left >= right || self.was_found(e, f, slab) {
            return false;
        }
        let order = |rank: u32| {
            let (y, z) = (self.height(e, rank), self.height(f, rank));
            if (y - z).abs() > self.slack { y.total_cmp(&z) } else { Ordering::Equal }
        };
        match [r[0] == s[0], r[1] == s[1]] {
            [false, false] => {
                let order_left = order(left);
                order_left == Ordering::Equal || order_left != order(right)
            }
            [true, _] => order(right) == Ordering::Equal && self.may_run_together(e.segment, s[1]),
            [_, true] => order(left) == Ordering::Equal && self.may_run_together(e.segment, s[0]),
        }
    }

    /// Whether of two edges with a common end, one of them given by its other end, both are on one line, or as close
    /// together as asked for.
    #[cold]
    fn may_run_together(&self, segment: RankedSegment, end: u32) -> bool {
        let [a, b] = self.ends_of(segment);
        self.reach > 0.0 || side(a, b, self.ends[end as usize]) == Side::On
    }
}
