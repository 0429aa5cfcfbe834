//! What lies right below a point: one vertical look.

use crate::chains::Chains;
use crate::predicates::{Segment, Side, height_order, side};
use crate::strips::Strips;
use glam::DVec2;
use std::cmp::Ordering;

/// The nearest of the chains' edges that a ray straight down from just right of `p` meets, and that edge directed to the right.
///
/// The ray keeps right of `p`, so that an edge counts from its leftmost end to just before its rightmost one; of
/// edges that meet below `p` the one that is higher right of it is the nearer. No edge may run through `p`,
/// unless it starts there and is to be passed over.
pub(crate) fn nearest_below(
    chains: &Chains,
    strips: &Strips,
    points: &[DVec2],
    p: DVec2,
) -> Option<(u32, Segment)> {
    let mut best: Option<(u32, Segment)> = None;
    strips.below(p.x, p.y, |chain| {
        let chain = chains.chain(chain);
        if chain.low.x <= p.x && p.x < chain.high.x && chain.low.y <= p.y {
            let found = chain.edge_at(points, p.x).filter(|&(_, [a, b])| side(a, b, p) == Side::Left);
            best = higher(best, found, p.x);
        }
        best.map(|(_, [a, b])| a.y.min(b.y))
    });
    best
}

/// The higher of two edges just right of an abscissa; the first if they run together.
fn higher(best: Option<(u32, Segment)>, other: Option<(u32, Segment)>, x: f64) -> Option<(u32, Segment)> {
    match (best, other) {
        (Some(a), Some(b)) if height_order(b.1, a.1, x) == Ordering::Greater => Some(b),
        (None, other) => other,
        (best, _) => best,
    }
}
