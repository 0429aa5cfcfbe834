//! Compares the candidate pairs of edges: those whose boxes meet, or those that the slab decomposition finds.

use super::pair::{Crossing, Meeting, meeting};
use super::{Contacts, candidates::Candidates, close_pairs::ClosePairs};
use crate::base::threads::Threads;
use crate::edges::Edges;
use crate::error::Error;
use crate::predicates::Margins;
use crate::spatial::{chains::MonotoneChains, slabs::SlabDecomposition};
use std::ops::Range;

/// What was found in some strips.
#[derive(Default)]
struct Compared {
    pairs: usize,
    crossings: usize,
    /// The crossings, and the pairs to be looked at closely, in order.
    meetings: Vec<Result<Crossing, [u32; 2]>>,
    in_time: bool,
}

impl Compared {
    #[inline]
    fn add(&mut self, edges: &Edges, pair: [u32; 2], margins: Margins) {
        self.pairs += 1;
        match meeting(edges, pair, margins) {
            Meeting::Apart => {}
            Meeting::Crossing(crossing) => {
                self.crossings += 1;
                self.meetings.push(Ok(crossing));
            }
            Meeting::Close { .. } => self.meetings.push(Err(pair)),
        }
    }
}

/// Parts of a range of strips, the same for any number of threads.
fn parts(strips: usize) -> impl Iterator<Item = Range<usize>> {
    const MOST: usize = 64;
    let length = strips.div_ceil(MOST).max(1);
    (0..strips).step_by(length).map(move |start| start..strips.min(start + length))
}

impl Contacts {
    /// Returns false, with some contacts found, when it would take too long or they are more than `most`.
    pub(super) fn find_by_boxes(
        &mut self,
        candidates: Candidates<'_>,
        close_pairs: &mut ClosePairs,
        most: usize,
    ) -> bool {
        let Candidates { edges, chains, strips, budget, .. } = candidates;
        if Threads::for_edges(edges.len()).are_many() {
            return self.find_on_threads(candidates, close_pairs, most);
        }
        let mut met = 0;
        strips.pairs_within(0..strips.len(), budget.blocks(edges.len()), |a, b| {
            chains.chain(a).meet(chains.chain(b), edges.points(), |e, f| {
                met += 1;
                self.meet(edges, e.min(f), e.max(f), close_pairs);
            });
            budget.lasts(edges.len(), met, self.nodes.len()) && self.found.len() <= most
        })
    }

    /// The same on all threads: they compare pairs of edges strip by strip, and the results are noted in the order of the strips.
    fn find_on_threads(
        &mut self,
        candidates: Candidates<'_>,
        close_pairs: &mut ClosePairs,
        most: usize,
    ) -> bool {
        let Candidates { edges, chains, strips, budget, .. } = candidates;
        let margins = close_pairs.margins();
        let compared = |strips_at: Range<usize>| {
            let mut met = Compared::default();
            met.in_time = strips.pairs_within(strips_at, budget.blocks(edges.len()), |a, b| {
                chains.chain(a).meet(chains.chain(b), edges.points(), |e, f| {
                    met.add(edges, [e.min(f), e.max(f)], margins);
                });
                budget.lasts(edges.len(), met.pairs, met.meetings.len()) && 2 * met.crossings <= most
            });
            met
        };
        let mut pairs = 0;
        Threads::for_edges(edges.len()).map(parts(strips.len()), compared).into_iter().all(|met| {
            pairs += met.pairs;
            met.meetings.into_iter().for_each(|meeting| match meeting {
                Ok(crossing) => self.cross(edges, crossing),
                Err([e, f]) => self.meet(edges, e, f, close_pairs),
            });
            met.in_time && budget.lasts(edges.len(), pairs, self.nodes.len()) && self.found.len() <= most
        })
    }

    pub(super) fn find_by_slabs(
        &mut self,
        edges: &Edges,
        chains: &MonotoneChains,
        slabs: &mut SlabDecomposition,
        close_pairs: &mut ClosePairs,
        most: usize,
    ) -> Result<(), Error> {
        slabs.build(edges.points().iter().copied(), chains.edges().map(|edge| (edge, [edge, edge + 1])));
        for place in slabs.places() {
            let mut vertices = place.filter(|&slot| edges.is_vertex(slot));
            let first = vertices.next();
            vertices.for_each(|vertex| first.into_iter().for_each(|first| self.join(edges, first, vertex)));
        }
        slabs.duplicates().for_each(|[e, f]| self.meet(edges, e, f, close_pairs));
        close_pairs.find_beside(edges, slabs);
        let are_few = slabs.find(most) || (close_pairs.give_up(slabs) && slabs.find(most));
        if !are_few {
            return Err(Error::TooManyContacts { limit: most });
        }
        slabs.visit(|e, f| {
            if self.found.len() <= most {
                self.meet(edges, e.min(f), e.max(f), close_pairs);
            }
        });
        Ok(())
    }
}
