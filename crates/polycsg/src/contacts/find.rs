//! Compares the candidate pairs of edges: those whose boxes meet, or those that the slab decomposition finds.

use super::pair::{Crossing, Meeting, meeting};
use super::{Contacts, candidates::Candidates, close_pairs::ClosePairs};
use crate::base::meter::{Meter, Refusal};
use crate::base::{threads::Threads, threads::ranges};
use crate::edges::Edges;
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
    ) -> Result<bool, Refusal> {
        let Candidates { edges, chains, strips, budget, .. } = candidates;
        if Threads::for_edges(edges.len()).are_many() {
            return self.find_on_threads(candidates, close_pairs, meter);
        }
        let (mut met, mut counted) = (0, 0);
        strips.pairs_within(0..strips.len(), budget.blocks(edges.len()), meter, |a, b| {
            chains.chain(a).meet(chains.chain(b), edges.points(), |e, f| {
                met += 1;
                self.meet(edges, e.min(f), e.max(f), close_pairs);
            });
            meter.spend_up_to(met, &mut counted)?;
            Ok(budget.lasts(edges.len(), met, self.nodes.len()) && self.found.len() <= meter.contacts())
        })
    }

    /// The same on all threads: they compare pairs of edges strip by strip, and the results are noted in the order of the strips.
    fn find_on_threads(
        &mut self,
        candidates: Candidates<'_>,
        close_pairs: &mut ClosePairs,
        meter: &Meter<'_>,
    ) -> Result<bool, Refusal> {
        let Candidates { edges, chains, strips, budget, .. } = candidates;
        let (margins, most) = (close_pairs.margins(), meter.contacts());
        let compared = |strips_at: Range<usize>| {
            let mut met = Compared { pairs: 0, crossings: 0, meetings: Vec::new(), in_time: true };
            let mut counted = 0;
            met.in_time = strips.pairs_within(strips_at, budget.blocks(edges.len()), meter, |a, b| {
                chains.chain(a).meet(chains.chain(b), edges.points(), |e, f| {
                    met.add(edges, [e.min(f), e.max(f)], margins);
                });
                meter.spend_up_to(met.pairs, &mut counted)?;
                let lasts = budget.lasts(edges.len(), met.pairs, met.meetings.len());
                Ok(lasts && 2 * met.crossings <= most)
            })?;
            Ok(met)
        };
        let mut pairs = 0;
        for met in Threads::for_edges(edges.len()).map(ranges(strips.len()), compared) {
            let met = met?;
            pairs += met.pairs;
            meter.for_all(met.meetings, |meeting| match meeting {
                Ok(crossing) => self.cross(edges, crossing),
                Err([e, f]) => self.meet(edges, e, f, close_pairs),
            })?;
            let lasts = budget.lasts(edges.len(), pairs, self.nodes.len());
            if !met.in_time || !lasts || self.found.len() > most {
                return Ok(false);
            }
        }
        Ok(true)
    }

    pub(super) fn find_by_slabs(
        &mut self,
        edges: &Edges,
        chains: &MonotoneChains,
        slabs: &mut SlabDecomposition,
        close_pairs: &mut ClosePairs,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let most = meter.contacts();
        let ends = chains.edges().map(|edge| (edge, [edge, edge + 1]));
        slabs.build(edges.points().iter().copied(), ends, meter)?;
        meter.for_all(slabs.places(), |place| {
            let mut vertices = place.filter(|&slot| edges.is_vertex(slot));
            let first = vertices.next();
            vertices.for_each(|vertex| first.into_iter().for_each(|first| self.join(edges, first, vertex)));
        })?;
        meter.for_all(slabs.duplicates(), |[e, f]| self.meet(edges, e, f, close_pairs))?;
        close_pairs.find_beside(edges, slabs, meter)?;
        let are_few = slabs.find(most, meter)? || (close_pairs.give_up(slabs) && slabs.find(most, meter)?);
        if !are_few {
            return Err(Refusal::Contacts);
        }
        let mut tally = meter.tally();
        slabs.visit(|e, f| {
            self.meet(edges, e.min(f), e.max(f), close_pairs);
            tally.add(1)?;
            if self.found.len() > most { Err(Refusal::Contacts) } else { Ok(()) }
        })
    }
}
