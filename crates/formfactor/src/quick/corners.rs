//! The corners of convex polygons, and what their deviation leaves open.
use super::cone::{Corner, Edge, NEAR};
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
    let corner = |given: &DVec3| Corner::given(*given, origin, deviation);
    corners.clear();
    if is_reversed {
        corners.extend(piece.iter().rev().map(corner));
    } else {
        corners.extend(piece.iter().map(corner));
    }
}

/// A bound on the form factor of what the deviation of the corners leaves open; `None` when the polygon, moved onto its plane,
/// may be far from convex.
pub(super) fn deviation_error(corners: &[Corner], edges: &[Edge]) -> Option<f64> {
    if corners.iter().all(|corner| corner.deviation == 0.0) {
        return Some(0.0);
    }
    let mut cut = 0.0;
    for edge in edges {
        for corner in corners {
            cut += cut_off(edge, corner.at)?;
        }
    }
    let direction =
        |c: &Corner| Direction { toward: c.at, error: c.deviation / c.at.length() * (1.0 + 16.0 * ROUNDING) };
    let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
    Some(cut + pairs.map(|(a, b)| swept(direction(a), direction(b))).sum::<f64>())
}

/// A bound on the form factor of what an edge's plane cuts off at a corner that may lie outside of it, as roundings leave corners that
/// go straight on: the angle off the plane, over half a turn. Nothing where it is clearly outside.
fn cut_off(edge: &Edge, corner: DVec3) -> Option<f64> {
    if corner == edge.start || corner == edge.end {
        return Some(0.0);
    }
    let (depth, error) = edge.depth(corner);
    if depth > error {
        return Some(0.0);
    }
    (depth >= -NEAR * error).then(|| (depth.abs() + error) / (edge.inward.length() * corner.length()))
}
