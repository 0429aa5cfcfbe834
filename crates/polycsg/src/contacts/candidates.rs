//! Stage 2, the broad phase: which pairs of edges are compared.
//!
//! | what boxes meet | broad phase |
//! | --- | --- |
//! | those of chains, few | [`BroadPhase::MonotoneChains`]: chains as long as they may be, so that smooth outlines are skipped over |
//! | those of chains, many | [`BroadPhase::Edges`]: chains of single edges, which are more boxes, but smaller ones |
//! | those of edges, many, that do not cross | [`BroadPhase::Slabs`]: long edges beside one another |
//!
//! A sample of the pairs of boxes decides. All three lead to one result. A sample may mislead, so boxes are given up later
//! where they exceed their budget even so.

use super::pair::{Meeting, meeting, overlap};
use super::{Request, budget::WorkBudget};
use crate::base::meter::{Meter, Refusal};
use crate::edges::{Edges, coincident::CoincidentEdges};
use crate::predicates::Margins;
use crate::spatial::{chains::MonotoneChains, strips::Strips};

/// Fewer boxes are not worth a sample.
const FEW: usize = 256;

/// Of so many boxes one at most is compared with all others, and so many at all.
const STEP: usize = 16;
const MOST: usize = 512;

/// So many pairs and blocks for each of these are enough.
const PAIRS: usize = 16;

/// One more box costs as much as so many pairs of chains do.
const PAIRS_PER_BOX: usize = 4;

/// How the pairs of edges are found that may meet; see the module's page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BroadPhase {
    /// Those in chains whose boxes meet.
    MonotoneChains,
    /// Those whose own boxes meet.
    Edges,
    /// Those that share a slab and are not in one order there.
    Slabs,
}

/// All edges, the chains they are in, the index over the chains' boxes, and how these are to be used.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidates<'a> {
    pub(crate) edges: &'a Edges,
    pub(crate) chains: &'a MonotoneChains,
    pub(crate) strips: &'a Strips,
    pub(crate) phase: BroadPhase,
    /// What boxes may cost, as long as they are used.
    pub(crate) budget: WorkBudget,
}

impl<'a> Candidates<'a> {
    /// Indexes the edges by their chains, and decides by a sample how their pairs are found. Where the sample has more pairs
    /// that overlap than there are edges, these are cut first. Expected O(n log n).
    ///
    /// # Errors
    /// Those of the limits of the request.
    pub(crate) fn index(
        edges: &'a mut Edges,
        coincident: &mut CoincidentEdges,
        chains: &'a mut MonotoneChains,
        strips: &'a mut Strips,
        request: Request<'_>,
    ) -> Result<Candidates<'a>, Refusal> {
        let Request { budget, meter, .. } = request;
        let mut sample = Sample::of(edges, chains, strips, meter)?;
        if sample.overlaps > edges.len() {
            coincident.cut(edges, meter)?;
            sample = Sample::of(edges, chains, strips, meter)?;
        }
        let phase = sample.choice(budget);
        if phase == BroadPhase::Edges {
            chains.cut_to_edges(edges.points(), edges.spans(), meter)?;
            strips.build(chains.boxes(), meter)?;
        }
        Ok(Candidates { edges, chains, strips, phase, budget: budget.doubled() })
    }
}

/// What all boxes would yield, by a sample.
#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    chains: usize,
    edges: usize,
    /// The pairs of chains and of edges whose boxes meet, and of the latter those that cross.
    chain_pairs: usize,
    pairs: usize,
    crossings: usize,
    /// The pairs of edges that overlap.
    overlaps: usize,
    /// The blocks of boxes to be looked at.
    blocks: usize,
}

impl Sample {
    /// Indexes the edges by their chains for it. The sample ends as soon as it tells that boxes are not quick.
    fn of(
        edges: &Edges,
        chains: &mut MonotoneChains,
        strips: &mut Strips,
        meter: &Meter<'_>,
    ) -> Result<Sample, Refusal> {
        chains.build(edges.points(), edges.spans(), meter)?;
        strips.build(chains.boxes(), meter)?;
        let mut sample = Sample { chains: chains.len(), edges: edges.len(), ..Sample::default() };
        if chains.len() < FEW {
            return Ok(sample);
        }
        let margins = Margins::for_size(chains.size());
        let step = STEP.max(chains.len() / MOST);
        let most = PAIRS * MOST;
        let (times, blocks) = strips.sample(step, 4 * most, |a, b| {
            sample.chain_pairs += 1;
            chains.chain(a).meet(chains.chain(b), edges.points(), |e, f| {
                sample.pairs += 1;
                match meeting(edges, [e.min(f), e.max(f)], margins) {
                    Meeting::Apart | Meeting::Sharing(_) => {}
                    Meeting::Crossing(_) => sample.crossings += 1,
                    Meeting::Close { .. } => sample.overlaps += usize::from(overlap(edges, [e, f])),
                }
            });
            sample.chain_pairs + sample.pairs < most
        });
        sample.blocks = blocks;
        let Sample { chain_pairs, pairs, crossings, overlaps, blocks, .. } = &mut sample;
        [chain_pairs, pairs, crossings, overlaps, blocks].into_iter().for_each(|count| *count *= times);
        Ok(sample)
    }

    fn choice(&self, budget: WorkBudget) -> BroadPhase {
        let boxes_are_quick =
            self.blocks <= budget.blocks(self.edges) && budget.lasts(self.edges, self.pairs, self.crossings);
        let single_edges_are_quicker =
            self.chain_pairs > self.pairs + PAIRS_PER_BOX * (self.edges - self.chains);
        match (boxes_are_quick, single_edges_are_quicker) {
            (false, _) => BroadPhase::Slabs,
            (true, false) => BroadPhase::MonotoneChains,
            (true, true) => BroadPhase::Edges,
        }
    }
}
