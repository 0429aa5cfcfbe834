//! Compares the candidate pairs of edges: those whose boxes meet, or those that the slab decomposition finds.

use super::pair::{Crossing, Meeting, meeting};
use super::{Contacts, candidates::Candidates, close_pairs::ClosePairs};
use crate::base::{meter::Meter, threads::Threads, threads::ranges};
use crate::edges::Edges;
use crate::error::Error;
use crate::predicates::Margins;
use crate::spatial::{chains::MonotoneChains, slabs::SlabDecomposition};
use std::ops::Range;

/// What was found in some strips.
struct Compared {
    pairs: usize,
    crossings: usize,
    /// The crossings, and the pairs to be looked at closely, in order.
    meetings: Vec<Result<Crossing, [u32; 2]>>,
    in_time: bool,
    allowed: Result<(), Error>,
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
            Meeting::Sharing(_) | Meeting::Close { .. } => self.meetings.push(Err(pair)),
        }
    }
}

impl Contacts {
    /// Returns false, with some contacts found, when it would take too long or they are too many.
    pub(super) fn find_by_boxes(
        &mut self,
        candidates: Candidates<'_>,
        close_pairs: &mut ClosePairs,
        meter: &Meter<'_>,
    ) -> Result<bool, Error> {
        let Candidates { edges, chains, strips, budget, .. } = candidates;
        if Threads::for_edges(edges.len()).are_many() {
            return self.find_on_threads(candidates, close_pairs, meter);
        }
        let (mut met, mut allowed) = (0, Ok(()));
        let in_time = strips.pairs_within(0..strips.len(), budget.blocks(edges.len()), |a, b| {
            let before = met;
            chains.chain(a).meet(chains.chain(b), edges.points(), |e, f| {
                met += 1;
                self.meet(edges, e.min(f), e.max(f), close_pairs);
            });
            allowed = meter.spend(met - before);
            allowed.is_ok()
                && budget.lasts(edges.len(), met, self.nodes.len())
                && self.found.len() <= meter.contacts()
        });
        allowed.map(|()| in_time)
    }

    /// The same on all threads: they compare pairs of edges strip by strip, and the results are noted in the order of the strips.
    fn find_on_threads(
        &mut self,
        candidates: Candidates<'_>,
        close_pairs: &mut ClosePairs,
        meter: &Meter<'_>,
    ) -> Result<bool, Error> {
        let Candidates { edges, chains, strips, budget, .. } = candidates;
        let (margins, most) = (close_pairs.margins(), meter.contacts());
        let compared = |strips_at: Range<usize>| {
            let mut met =
                Compared { pairs: 0, crossings: 0, meetings: Vec::new(), in_time: true, allowed: Ok(()) };
            met.in_time = strips.pairs_within(strips_at, budget.blocks(edges.len()), |a, b| {
                let before = met.pairs;
                chains.chain(a).meet(chains.chain(b), edges.points(), |e, f| {
                    met.add(edges, [e.min(f), e.max(f)], margins);
                });
                met.allowed = meter.spend(met.pairs - before);
                met.allowed.is_ok()
                    && budget.lasts(edges.len(), met.pairs, met.meetings.len())
                    && 2 * met.crossings <= most
            });
            met
        };
        let (mut pairs, mut allowed) = (0, Ok(()));
        let in_time =
            Threads::for_edges(edges.len()).map(ranges(strips.len()), compared).into_iter().all(|met| {
                pairs += met.pairs;
                allowed = allowed.and(met.allowed);
                met.meetings.into_iter().for_each(|meeting| match meeting {
                    Ok(crossing) => self.cross(edges, crossing),
                    Err([e, f]) => self.meet(edges, e, f, close_pairs),
                });
                met.in_time && budget.lasts(edges.len(), pairs, self.nodes.len()) && self.found.len() <= most
            });
        allowed.map(|()| in_time)
    }

    pub(super) fn find_by_slabs(
        &mut self,
        edges: &Edges,
        chains: &MonotoneChains,
        slabs: &mut SlabDecomposition,
        close_pairs: &mut ClosePairs,
        meter: &Meter<'_>,
    ) -> Result<(), Error> {
        let most = meter.contacts();
        slabs.build(edges.points().iter().copied(), chains.edges().map(|edge| (edge, [edge, edge + 1])));
        for place in slabs.places() {
            let mut vertices = place.filter(|&slot| edges.is_vertex(slot));
            let first = vertices.next();
            vertices.for_each(|vertex| first.into_iter().for_each(|first| self.join(edges, first, vertex)));
        }
        slabs.duplicates().for_each(|[e, f]| self.meet(edges, e, f, close_pairs));
        close_pairs.find_beside(edges, slabs);
        let are_few = slabs.find(most, meter)? || (close_pairs.give_up(slabs) && slabs.find(most, meter)?);
        if !are_few {
            return Err(Error::TooManyContacts { limit: most });
        }
        let mut allowed = Ok(());
        slabs.visit(|e, f| {
            if self.found.len() <= most && allowed.is_ok() {
                allowed = meter.spend(1);
                self.meet(edges, e.min(f), e.max(f), close_pairs);
            }
        });
        allowed
    }
}
