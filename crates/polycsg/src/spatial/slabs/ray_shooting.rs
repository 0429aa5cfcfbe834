//! What is right below a point, asked for many points at once.

use super::segments::{NONE, RankedSegment, Slab, SpanningSegment, parts};
use super::{FEW, SlabDecomposition};
use crate::predicates::{Side, height_order, side};
use glam::DVec2;
use std::cmp::Ordering;
use std::ops::Range;

impl SlabDecomposition {
    /// For each of some of the points the edge right below it, by its id: of the edges that a ray straight down from just
    /// right of the point meets the first, edges that start in the point passed over.
    pub(crate) fn below(&mut self, points: &[u32], found: &mut Vec<Option<u32>>) {
        self.queries.clear();
        self.queries.extend((0..).zip(points).map(|(place, &point)| (self.ranks[point as usize], place)));
        self.queries.sort_unstable();
        self.nearest.clear();
        self.nearest.resize(points.len(), NONE);
        if let Some(slab) = self.open_all() {
            self.look_down(slab, 0, 0..self.queries.len());
        }
        found.clear();
        let id = |&bar: &u32| self.bars.get(bar as usize).map(|bar| bar.id);
        found.extend(self.nearest.iter().map(id));
    }

    /// Finds what is below those of the queries, sorted by rank, that lie in a slab but not at its right side.
    fn look_down(&mut self, slab: Slab, start: usize, queries: Range<usize>) {
        let within =
            |rank: u32| queries.start + self.queries[queries.clone()].partition_point(|q| q.0 < rank);
        let queries = within(slab[0])..within(slab[1]);
        if queries.is_empty() {
            return self.open.truncate(start);
        }
        self.sort_out_spans(slab, start);
        while !self.spans.is_empty() {
            self.choose_rungs(slab);
            queries.clone().for_each(|query| self.look_at_rungs(query, slab));
            if slab[1] - slab[0] > 1 {
                self.open.extend(self.spans.drain(..).map(|span| span.bar));
            }
        }
        let end = self.open.len();
        if end - start <= FEW {
            for query in queries {
                for i in start..end {
                    self.look_at(query, self.open[i]);
                }
            }
        } else {
            for half in parts(slab) {
                self.open_again(half, start..end);
                self.look_down(half, end, queries.clone());
            }
        }
        self.open.truncate(start);
    }

    /// Takes the highest rung below a query.
    fn look_at_rungs(&mut self, query: usize, slab: Slab) {
        let rank = self.queries[query].0;
        let p = self.ends[rank as usize];
        let at = |rung: &SpanningSegment| {
            if rank == slab[0] { rung.heights[0] } else { self.height_inside(rung, rank) }
        };
        let first = self.rungs.partition_point(|rung| at(rung) + self.slack < p.y);
        let near = &self.rungs[first..];
        let near = &near[..near.partition_point(|rung| at(rung) <= p.y + self.slack)];
        let below = first + near.partition_point(|rung| self.is_below(rung.bar, p));
        if let Some(place) = below.checked_sub(1) {
            self.look_at(query, self.rungs[place].bar);
        }
    }

    fn is_below(&self, bar: RankedSegment, p: DVec2) -> bool {
        let [a, b] = self.segment(bar);
        side(a, b, p) == Side::Left
    }

    /// Takes an edge if it is below a query, and higher than what was found.
    fn look_at(&mut self, query: usize, bar: RankedSegment) {
        let (rank, place) = self.queries[query];
        let p = self.ends[rank as usize];
        if bar.ranks[0] < rank && rank < bar.ranks[1] && self.is_below(bar, p) {
            let before = self.bars.get(self.nearest[place as usize] as usize);
            let is_higher = |before: &RankedSegment| {
                height_order(self.segment(bar), self.segment(*before), p.x) == Ordering::Greater
            };
            if before.is_none_or(is_higher) {
                self.nearest[place as usize] = bar.id;
            }
        }
    }
}
