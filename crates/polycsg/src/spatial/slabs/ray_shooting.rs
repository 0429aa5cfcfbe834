//! What is right below a point, asked for many points at once.

use super::SlabDecomposition;
use super::descent::{Quest, Search};
use super::segments::{ClippedSegment, NONE, RankedSegment, Slab};
use crate::base::meter::{Meter, Refusal};
use crate::base::sort::sort;
use crate::predicates::{Side, height_order, side};
use glam::DVec2;
use std::{cmp::Ordering, ops::Range, sync::Arc};

impl SlabDecomposition {
    /// For each of some of the points the edge right below it, by its id: of the edges that a ray straight down from just
    /// right of the point meets the first, edges that start in the point passed over.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn below(
        &mut self,
        points: &[u32],
        found: &mut Vec<Option<u32>>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.queries.clear();
        let ranked = (0..).zip(points).map(|(place, &point)| (self.ranks[point as usize], place));
        meter.extend(&mut self.queries, ranked)?;
        sort(&mut self.queries, Ord::cmp, meter)?;
        self.nearest.clear();
        self.nearest.resize(points.len(), NONE);
        let SlabDecomposition { segments, ends, found: pairs, .. } = self;
        pairs.start(0, 0);
        Arc::make_mut(segments)
            .retain(|segment| ends[segment.ranks[0] as usize].x < ends[segment.ranks[1] as usize].x);
        self.look_into_all(Search { quest: Quest::Below, meter })?;
        found.clear();
        let id = |&segment: &u32| self.segments.get(segment as usize).map(|segment| segment.id);
        meter.extend(found, self.nearest.iter().map(id))
    }

    /// The queries that lie in a slab but not at its right side.
    pub(super) fn queries_in(&self, slab: Slab) -> Range<usize> {
        let [first, end] = slab.map(|side| self.queries.partition_point(|query| query.0 < side));
        first..end
    }

    /// Takes the highest stair below each query in a slab.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn look_at_queries(&mut self, slab: Slab, meter: &Meter<'_>) -> Result<(), Refusal> {
        meter.for_each(self.queries_in(slab), |query| self.look_at_stairs(query, slab))
    }

    fn look_at_stairs(&mut self, query: usize, slab: Slab) {
        let rank = self.queries[query].0;
        let p = self.ends[rank as usize];
        let at = |stair: &ClippedSegment| {
            if rank == slab[0] { stair.heights[0] } else { self.height_inside(stair, p) }
        };
        let first = self.stairs.partition_point(|stair| at(stair) + self.slack < p.y);
        let near = &self.stairs[first..];
        let near = &near[..near.partition_point(|stair| at(stair) <= p.y + self.slack)];
        let below = first + near.partition_point(|stair| self.is_below(stair.segment, p));
        if let Some(place) = below.checked_sub(1) {
            self.look_at(query, self.stairs[place].segment);
        }
    }

    fn is_below(&self, segment: RankedSegment, p: DVec2) -> bool {
        let [a, b] = self.ends_of(segment);
        side(a, b, p) == Side::Left
    }

    /// Takes an edge if it is below a query, and higher than what was found.
    pub(super) fn look_at(&mut self, query: usize, segment: RankedSegment) {
        let (rank, place) = self.queries[query];
        let p = self.ends[rank as usize];
        if segment.ranks[0] < rank && rank < segment.ranks[1] && self.is_below(segment, p) {
            let before = self.segments.get(self.nearest[place as usize] as usize);
            let is_higher = |before: &RankedSegment| {
                height_order(self.ends_of(segment), self.ends_of(*before), p.x) == Ordering::Greater
            };
            if before.is_none_or(is_higher) {
                self.nearest[place as usize] = segment.id;
            }
        }
    }
}
