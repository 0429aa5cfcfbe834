//! Which edges come near one another without meeting, by less than a distance δ in both coordinates.
//!
//! ```text
//!      f /                  Two edges that do not meet are nearest where one of them ends. Such an end P is
//!       /                     - above or below the other edge, by (1 + T) δ at most if that is no steeper than T:
//!     P      ___--- e           then `pairs` reports the two once the slack is that large;
//!       __---                 - beyond the edge's end Q, within δ in abscissa and (1 + 2 T) δ in height of it; or
//!     Q                       - in the box of a steeper edge, widened by δ.
//! ```
//!
//! Steep edges are few in most inputs and their boxes narrow. Where they are not, looking at them is given up.

use super::{SlabDecomposition, segments::RankedSegment};
use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, sort::sort};
use crate::predicates::{Margins, doubled_area, lexicographic};
use std::ops::Range;

/// `T`: a steeper edge goes up by so many times its width.
const STEEP: f64 = 128.0;

/// How many ends are looked at for each edge, before looking is given up.
const ENDS_PER_EDGE: usize = 16;

impl SlabDecomposition {
    /// Lets [`pairs`](SlabDecomposition::pairs) report ends above and below edges, too. False where that would be most of all ends, as
    /// heights are small beside abscissae.
    ///
    /// Heights are wrong by `32 u` times the largest between two edges, and δ is at least `4 u` of that.
    pub(crate) fn widen(&mut self, distance: f64) -> bool {
        const MOST: f64 = 64.0;
        let slack = (STEEP + 16.0) * distance;
        let is_enough = slack <= MOST * self.error;
        if is_enough {
            self.slack = self.error.max(slack);
            self.reach = distance;
        }
        is_enough
    }

    /// Lets [`pairs`](SlabDecomposition::pairs) report what meets, and no more; false if that is so.
    pub(crate) fn narrow(&mut self) -> bool {
        self.slack = self.error;
        std::mem::take(&mut self.reach) > 0.0
    }

    /// Calls `visit` for pairs of points, ends of edges, the second of which is just beyond an edge that ends in the first;
    /// false when there are too many.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn ends_beside_ends(
        &mut self,
        distance: f64,
        meter: &Meter<'_>,
        mut visit: impl FnMut(u32, u32),
    ) -> Result<bool, Refusal> {
        let height = (1.0 + 2.0 * STEEP) * distance;
        let mut left = ENDS_PER_EDGE * self.segments.len();
        let mut by_height = std::mem::take(&mut self.by_height);
        let y = |rank: u32| self.ends[rank as usize].y;
        let (mut first, mut is_in_time, mut tally) = (0, true, meter.tally());
        for close in self.ends.chunk_by(|p, q| q.x - p.x <= distance) {
            by_height.clear();
            by_height.extend(index(first)..index(first + close.len()));
            first += close.len();
            sort(&mut by_height, |&i, &j| y(i).total_cmp(&y(j)), meter)?;
            for (place, &i) in by_height.iter().enumerate() {
                tally.add(1)?;
                for &j in by_height[place + 1..].iter().take_while(|&&j| y(j) - y(i) <= height) {
                    is_in_time &= left > 0;
                    if !is_in_time {
                        break;
                    }
                    left -= 1;
                    tally.add(1)?;
                    self.points_at(i).for_each(|p| self.points_at(j).for_each(|q| visit(p, q)));
                }
            }
        }
        self.by_height = by_height;
        Ok(is_in_time)
    }

    /// Calls `visit` for steep edges and points, ends of others, that are not clear of them; false when there are too many.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn ends_beside_steep_edges(
        &self,
        margins: Margins,
        meter: &Meter<'_>,
        mut visit: impl FnMut(u32, u32),
    ) -> Result<bool, Refusal> {
        let mut left = ENDS_PER_EDGE * self.segments.len();
        let mut tally = meter.tally();
        for &segment in &*self.segments {
            tally.add(1)?;
            let [a, b] = self.ends_of(segment);
            if (b.y - a.y).abs() / STEEP <= b.x - a.x {
                continue;
            }
            let ranks = self.ranks_beside(segment, margins.close);
            let Some(fewer) = left.checked_sub(ranks.len()) else { return Ok(false) };
            left = fewer;
            tally.add(ranks.len())?;
            let (low, high) = (a.y.min(b.y) - margins.close, a.y.max(b.y) + margins.close);
            for rank in ranks.filter(|rank| !segment.ranks.contains(rank)) {
                let p = self.ends[rank as usize];
                if low <= p.y && p.y <= high && !margins.is_apart([a, b], doubled_area(a, b, p)) {
                    self.points_at(rank).for_each(|point| visit(segment.id, point));
                }
            }
        }
        Ok(true)
    }

    /// The ends over an edge's range of abscissae, widened.
    fn ranks_beside(&self, segment: RankedSegment, distance: f64) -> Range<u32> {
        let [left, right] = self.ends_of(segment).map(|end| end.x);
        let before = |x: f64| self.ends.partition_point(|p| p.x < x);
        index(before(left - distance))..index(before(right + distance))
    }

    /// The points of a rank, by their numbers.
    fn points_at(&self, rank: u32) -> impl Iterator<Item = u32> + '_ {
        let end = self.ends[rank as usize];
        let first = self.sorted.partition_point(|(p, _)| lexicographic(*p, end).is_lt());
        self.sorted[first..].iter().take_while(move |(p, _)| *p == end).map(|&(_, point)| point)
    }
}
