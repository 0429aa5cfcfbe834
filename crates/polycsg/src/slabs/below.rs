//! What is right below a point, asked for many points at once.

use super::rungs::Span;
use super::{Bar, FEW, NONE, Slab, Slabs, parts};
use crate::predicates::{Side, height_order, side};
use std::cmp::Ordering;
use std::ops::Range;

impl Slabs {
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
            self.choose_rungs();
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
        let at = |rung: &Span| if rank == slab[0] { rung.heights[0] } else { self.height_inside(rung, rank) };
        let first = self.rungs.partition_point(|rung| at(rung) + self.slack < p.y);
        let last = first + self.rungs[first..].iter().take_while(|rung| at(rung) <= p.y + self.slack).count();
        for i in (first.saturating_sub(1)..last).rev() {
            if self.look_at(query, self.rungs[i].bar) {
                return;
            }
        }
    }

    /// Takes an edge if it is below a query, and higher than what was found; returns whether it is below.
    fn look_at(&mut self, query: usize, bar: Bar) -> bool {
        let (rank, place) = self.queries[query];
        let p = self.ends[rank as usize];
        let [a, b] = bar.ranks.map(|rank| self.ends[rank as usize]);
        let is_below = bar.ranks[0] < rank && rank < bar.ranks[1] && side(a, b, p) == Side::Left;
        if is_below {
            let nearest = &mut self.nearest[place as usize];
            let before = self.bars.get(*nearest as usize);
            let before = before.map(|bar| bar.ranks.map(|rank| self.ends[rank as usize]));
            if before.is_none_or(|before| height_order([a, b], before, p.x) == Ordering::Greater) {
                *nearest = bar.id;
            }
        }
        is_below
    }
}
