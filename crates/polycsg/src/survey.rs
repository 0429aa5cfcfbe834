//! Stage 2, for larger inputs: a sample of the pairs of boxes tells which way to the contacts is the quickest.
//!
//! | what boxes meet | way |
//! | --- | --- |
//! | those of chains, few | chains as long as they may be: smooth outlines are skipped over |
//! | those of chains, many | chains of single edges: more boxes, but smaller ones |
//! | those of edges, many, that do not cross | [`Slabs`](crate::slabs::Slabs): long edges beside one another |
//!
//! All ways lead to one result. A sample may mislead, so boxes are given up later where they take too long even so.

use crate::chains::Chains;
use crate::contacts::{Patience, cross_clearly};
use crate::edges::Edges;
use crate::predicates::Margins;
use crate::strips::Strips;

/// Fewer boxes are not worth a look.
const FEW: usize = 256;

/// Of so many boxes one is compared with all others.
const STEP: usize = 16;

/// So many pairs and blocks of the sample for each edge are enough.
const PAIRS: usize = 8;

/// One more box costs as much as so many pairs of chains do.
const PAIRS_PER_BOX: usize = 4;

/// All edges, the chains they are in, and the index over the chains' boxes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Boxes<'a> {
    pub(crate) edges: &'a Edges,
    pub(crate) chains: &'a Chains,
    pub(crate) strips: &'a Strips,
}

/// What all boxes would yield, by a sample.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Survey {
    chains: usize,
    edges: usize,
    /// The pairs of chains and of edges whose boxes meet, and of the latter those that cross.
    chain_pairs: usize,
    pairs: usize,
    crossings: usize,
    /// The blocks of boxes to be looked at.
    blocks: usize,
}

impl Survey {
    /// O(n): the sample ends as soon as it tells that boxes are not quick.
    pub(crate) fn of(Boxes { edges, chains, strips }: Boxes<'_>) -> Survey {
        let mut survey = Survey { chains: chains.len(), edges: edges.len(), ..Survey::default() };
        if chains.len() < FEW {
            return survey;
        }
        let margins = Margins::for_size(chains.size());
        let most = PAIRS * edges.len();
        let (times, blocks) = strips.sample(STEP, most, |a, b| {
            survey.chain_pairs += 1;
            chains.chain(a).meet(chains.chain(b), edges.points(), |e, f| {
                survey.pairs += 1;
                survey.crossings += usize::from(cross_clearly(edges, [e.min(f), e.max(f)], margins));
            });
            survey.chain_pairs + survey.pairs < most
        });
        survey.blocks = blocks;
        for count in [&mut survey.chain_pairs, &mut survey.pairs, &mut survey.crossings, &mut survey.blocks] {
            *count *= times;
        }
        survey
    }

    /// Whether chains of single edges are quicker.
    pub(crate) fn asks_for_single_edges(&self) -> bool {
        self.chain_pairs > self.pairs + PAIRS_PER_BOX * (self.edges - self.chains)
    }

    /// Whether boxes are quicker than slabs.
    pub(crate) fn asks_for_boxes(&self, patience: Patience) -> bool {
        self.blocks <= patience.blocks(self.edges)
            && patience.lasts(self.edges, self.pairs, self.crossings, 0)
    }
}
