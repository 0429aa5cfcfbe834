//! Vertical ray shooting: the edge right below a point.

use super::{chains::MonotoneChains, slabs::SlabDecomposition, strips::Strips};
use crate::base::meter::{Meter, Refusal};
use crate::base::threads::Threads;
use crate::predicates::{Segment, Side, height_order, side};
use glam::DVec2;
use std::cmp::Ordering;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// So many boxes are looked at for each edge; then the slab decomposition takes over.
const BOXES_PER_EDGE: usize = 32;

/// So many vertices are asked for at a time.
const VERTICES: usize = 1024;

/// For each of some vertices the edge right below it. No edge may run through the vertices.
#[derive(Debug, Default)]
pub(crate) struct VerticalRays {
    edges: Vec<Option<u32>>,
}

impl VerticalRays {
    /// Shoots down from vertices, of which none lies inside any edge of the chains.
    ///
    /// The ray keeps just right of the vertex, so that an edge counts from its leftmost end to just before its rightmost
    /// one; of edges that meet below the vertex the one that is higher right of it is the nearer. Edges that start in
    /// the vertex are passed over.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn shoot(
        &mut self,
        chains: &MonotoneChains,
        strips: &Strips,
        slabs: &mut SlabDecomposition,
        points: &[DVec2],
        vertices: &[u32],
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let (most, looked_at) = (BOXES_PER_EDGE * points.len(), AtomicUsize::new(0));
        self.edges.clear();
        self.edges.resize(vertices.len(), None);
        let parts = self.edges.chunks_mut(VERTICES).zip(vertices.chunks(VERTICES));
        Threads::for_edges(points.len()).try_for_each(parts, |(edges, vertices)| {
            let mut tally = meter.tally();
            for (edge, &vertex) in edges.iter_mut().zip(vertices) {
                // What other threads look at meanwhile is counted later: only the sum decides.
                let before = most.saturating_sub(looked_at.load(Relaxed));
                if before == 0 {
                    break;
                }
                let mut left = before;
                *edge = nearest_below(chains, strips, points, points[vertex as usize], &mut left);
                looked_at.fetch_add(before - left, Relaxed);
                tally.add(1 + before - left)?;
            }
            Ok(())
        })?;
        if looked_at.into_inner() < most {
            return Ok(());
        }
        let edges = chains.edges().map(|edge| (edge, [edge, edge + 1]));
        slabs.build(points.iter().copied(), edges, meter)?;
        slabs.below(vertices, &mut self.edges, meter)
    }

    /// The edge below the i-th vertex.
    pub(crate) fn edge(&self, i: usize) -> Option<u32> {
        self.edges[i]
    }
}

/// What is right below a point, looking at `left` boxes at most.
fn nearest_below(
    chains: &MonotoneChains,
    strips: &Strips,
    points: &[DVec2],
    p: DVec2,
    left: &mut usize,
) -> Option<u32> {
    let mut best: Option<(u32, Segment)> = None;
    strips.below(p.x, p.y, left, |chain| {
        let chain = chains.chain(chain);
        if chain.low.x <= p.x && p.x < chain.high.x && chain.low.y <= p.y {
            let below = chain.edges_at(points, p.x).filter(|&(_, [a, b])| side(a, b, p) == Side::Left);
            best = below.fold(best, |best, edge| higher(best, Some(edge), p.x));
        }
        best.map(|(_, [a, b])| a.y.min(b.y))
    });
    best.map(|(edge, _)| edge)
}

/// The higher of two edges just right of an abscissa; the first if they run together.
fn higher(best: Option<(u32, Segment)>, other: Option<(u32, Segment)>, x: f64) -> Option<(u32, Segment)> {
    match (best, other) {
        (Some(a), Some(b)) if height_order(b.1, a.1, x) == Ordering::Greater => Some(b),
        (None, other) => other,
        (best, _) => best,
    }
}
