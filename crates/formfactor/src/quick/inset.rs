//! Targets a hair smaller than they are, where an error is allowed that is larger than what that loses.
//!
//! ```text
//!     _________________
//!    |  _____________  |     In buildings most edges of a target lie along edges of what stands on it, touches it or is its neighbour, but
//!    | |             | |     for roundings, so that doubles cannot tell which of the two is in front. A hair inside none does, and what
//!    | |_____________| |     touches the target hides nothing for certain.
//!    |_________________|
//! ```
use super::cone::{Corner, CornerId, Edge, size};
use crate::exact::lambert::{Direction, swept};
use crate::numeric::rounding::ROUNDING;
use glam::DVec3;

/// How far inside corners are put, as shares of their ways to the middle: the first of which little enough is lost.
const SHARES: [f64; 2] = [1.0 / (1u64 << 30) as f64, 1.0 / (1u64 << 38) as f64];

/// Takes the corners of a convex polygon with these edges a hair inside in place of others, and returns a bound on the form factor of what is
/// lost; `None` where that is more than is allowed.
pub(super) fn inset(edges: &[Edge], origin: DVec3, most: f64, corners: &mut Vec<Corner>) -> Option<f64> {
    let middle = edges.iter().map(|edge| edge.start).sum::<DVec3>() / edges.len() as f64;
    SHARES.into_iter().find_map(|share| {
        corners.clear();
        corners.extend(edges.iter().map(|edge| toward(middle, edge.start, share, origin)));
        let lost = lost(edges, corners);
        (lost <= most).then_some(lost)
    })
}

/// A corner on its way to the middle. It is where it is rounded to.
fn toward(middle: DVec3, corner: DVec3, share: f64, origin: DVec3) -> Corner {
    let way = (middle - corner) * share;
    Corner {
        at: corner + way,
        id: CornerId::cut([corner + origin, middle + origin]),
        deviation: way.length() + 4.0 * ROUNDING * size(corner),
        rounding: 0.0,
    }
}

/// A bound on the form factor of what is between the edges and the corners inside of them.
fn lost(edges: &[Edge], corners: &[Corner]) -> f64 {
    let direction = |(edge, corner): (&Edge, &Corner)| Direction {
        toward: edge.start,
        error: corner.deviation / edge.start.length() * (1.0 + 16.0 * ROUNDING),
    };
    let next = edges.iter().zip(corners).cycle().skip(1);
    edges.iter().zip(corners).zip(next).map(|(a, b)| swept(direction(a), direction(b))).sum()
}
