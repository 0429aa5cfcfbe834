//! Which pairs of edges are compared: those whose chains' boxes meet, or those that slabs find.

use super::Contacts;
use super::meeting::{Crossing, Meeting, meeting};
use crate::Error;
use crate::chains::Chains;
use crate::edges::Edges;
use crate::predicates::Margins;
use crate::slabs::Slabs;
use crate::survey::Boxes;
use crate::suspects::Suspects;
use crate::threads::Threads;
use std::ops::Range;

/// How long boxes of chains are looked at before [`Slabs`] are built: up to so many pairs of edges for each edge and for
/// each node found, and up to so many blocks of boxes for each edge.
///
/// Where edges do cross, boxes are quicker: among many long edges in all directions about 4 pairs make a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patience {
    pub(crate) pairs: usize,
    pub(crate) pairs_per_edge: usize,
    pub(crate) pairs_per_node: usize,
    pub(crate) blocks_per_edge: usize,
    /// The most contacts to be found at all, counted as [`Csg::try_evaluate_with`](crate::Csg::try_evaluate_with) does.
    pub(crate) contacts: usize,
}

#[cfg(any(test, fuzzing))]
impl Patience {
    /// Slabs at once.
    pub(crate) const NONE: Patience =
        Patience { pairs: 0, pairs_per_edge: 0, pairs_per_node: 0, blocks_per_edge: 0, contacts: usize::MAX };
}

impl Default for Patience {
    fn default() -> Patience {
        Patience {
            pairs: 1000,
            pairs_per_edge: 48,
            pairs_per_node: 8,
            blocks_per_edge: 32,
            contacts: usize::MAX,
        }
    }
}

impl Patience {
    /// How many blocks of boxes may be looked at.
    pub(crate) fn blocks(self, edges: usize) -> usize {
        self.pairs + self.blocks_per_edge * edges
    }

    /// Twice as much, for those who were told that it would last.
    pub(super) fn doubled(self) -> Patience {
        let twice = |n: usize| n.saturating_mul(2);
        Patience {
            pairs: twice(self.pairs),
            pairs_per_edge: twice(self.pairs_per_edge),
            pairs_per_node: twice(self.pairs_per_node),
            blocks_per_edge: twice(self.blocks_per_edge),
            ..self
        }
    }

    /// Whether to go on when so many pairs of edges, nodes and contacts were found.
    pub(crate) fn lasts(self, edges: usize, pairs: usize, nodes: usize, contacts: usize) -> bool {
        let most = self.pairs + self.pairs_per_edge * edges;
        pairs < most + self.pairs_per_node * nodes && contacts <= self.contacts
    }
}

/// What was found in some strips.
#[derive(Default)]
struct Met {
    pairs: usize,
    crossings: usize,
    /// The crossings, and the pairs to be looked at closely, in order.
    meetings: Vec<Result<Crossing, [u32; 2]>>,
    in_time: bool,
}

impl Met {
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
    /// Returns false, with some contacts found, when it would take too long or they are too many.
    pub(super) fn find_by_boxes(
        &mut self,
        boxes: Boxes<'_>,
        suspects: &mut Suspects,
        patience: Patience,
    ) -> bool {
        let Boxes { edges, chains, strips } = boxes;
        if Threads::for_edges(edges.len()).are_many() {
            return self.find_on_threads(boxes, suspects, patience);
        }
        let mut met = 0;
        strips.pairs_within(0..strips.len(), patience.blocks(edges.len()), |a, b| {
            chains.chain(a).meet(chains.chain(b), edges.points(), |e, f| {
                met += 1;
                self.meet(edges, e.min(f), e.max(f), suspects);
            });
            patience.lasts(edges.len(), met, self.nodes.len(), self.found.len())
        })
    }

    /// The same: pairs of edges are compared strip by strip on all threads, and what was found is noted strip by strip.
    fn find_on_threads(&mut self, boxes: Boxes<'_>, suspects: &mut Suspects, patience: Patience) -> bool {
        let Boxes { edges, chains, strips } = boxes;
        let margins = suspects.margins();
        let compared = |strips_at: Range<usize>| {
            let mut met = Met::default();
            met.in_time = strips.pairs_within(strips_at, patience.blocks(edges.len()), |a, b| {
                chains.chain(a).meet(chains.chain(b), edges.points(), |e, f| {
                    met.add(edges, [e.min(f), e.max(f)], margins);
                });
                patience.lasts(edges.len(), met.pairs, met.meetings.len(), 2 * met.crossings)
            });
            met
        };
        let mut pairs = 0;
        Threads::for_edges(edges.len()).map(parts(strips.len()), compared).into_iter().all(|met| {
            pairs += met.pairs;
            met.meetings.into_iter().for_each(|meeting| match meeting {
                Ok(crossing) => self.cross(edges, crossing),
                Err([e, f]) => self.meet(edges, e, f, suspects),
            });
            met.in_time && patience.lasts(edges.len(), pairs, self.nodes.len(), self.found.len())
        })
    }

    pub(super) fn find_by_slabs(
        &mut self,
        edges: &Edges,
        chains: &Chains,
        slabs: &mut Slabs,
        suspects: &mut Suspects,
        most: usize,
    ) -> Result<(), Error> {
        slabs.build(edges.points().iter().copied(), chains.edges().map(|edge| (edge, [edge, edge + 1])));
        for place in slabs.places() {
            let mut vertices = place.filter(|&slot| edges.ring(slot).end != slot);
            let first = vertices.next();
            vertices.for_each(|vertex| first.into_iter().for_each(|first| self.join(edges, first, vertex)));
        }
        slabs.copies().for_each(|[e, f]| self.meet(edges, e, f, suspects));
        suspects.look_beside(edges, slabs);
        let are_few = slabs.find(most) || (suspects.look_no_more(slabs) && slabs.find(most));
        if !are_few {
            return Err(Error::TooManyContacts { limit: most });
        }
        slabs.visit(|e, f| {
            if self.found.len() <= most {
                self.meet(edges, e.min(f), e.max(f), suspects);
            }
        });
        Ok(())
    }
}
