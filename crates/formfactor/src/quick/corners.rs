//! The corners of convex polygons, and what their deviation leaves open.
use super::cone::{Corner, Edge, Place};
use crate::exact::lambert::{Direction, swept};
use crate::numeric::rounding::ROUNDING;
use glam::DVec3;

/// Copies the vertices of a convex polygon, in reverse order when it turns its back, so that they run counter-clockwise seen
/// from `origin`.
pub(super) fn copy(
    piece: &[DVec3],
    deviation: f64,
    origin: DVec3,
    is_reversed: bool,
    corners: &mut Vec<Corner>,
) {
    corners.clear();
    corners.extend(piece.iter().map(|given| Corner::given(*given, origin, deviation)));
    if is_reversed {
        corners.reverse();
    }
}

/// A bound on the form factor of what the deviation of the corners leaves open; `None` when the polygon, moved onto its plane,
/// may not be convex.
pub(super) fn deviation_error(corners: &[Corner], edges: &[Edge]) -> Option<f64> {
    if corners.iter().all(|corner| corner.deviation == 0.0) {
        return Some(0.0);
    }
    let is_apart = |edge: &Edge, p: DVec3| p == edge.start || p == edge.end || edge.place(p) == Place::Inside;
    if !edges.iter().all(|edge| corners.iter().all(|c| is_apart(edge, c.at))) {
        return None;
    }
    let direction =
        |c: &Corner| Direction { toward: c.at, error: c.deviation / c.at.length() * (1.0 + 16.0 * ROUNDING) };
    let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
    Some(pairs.map(|(a, b)| swept(direction(a), direction(b))).sum())
}
