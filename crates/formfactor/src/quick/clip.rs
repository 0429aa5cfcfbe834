//! Clipping of convex polygons by a plane.
use super::cone::{Corner, CornerId, size};
use crate::numeric::rounding::ROUNDING;
use glam::DVec3;
use std::cmp::Ordering;

/// Keeps the part of a convex polygon, whose corners are all given, that is not on the lower side of a plane. `place` says where a vertex lies,
/// `height` how far from the plane in some measure, within a rounding or two.
///
/// A clip point lies on its edge within its deviation. The ends are taken in the same order for both directions of an edge, so that
/// neighbours share the clip point.
pub(super) fn clip(
    corners: &mut Vec<Corner>,
    spare: &mut Vec<Corner>,
    place: impl Fn(DVec3) -> Ordering,
    height: impl Fn(DVec3) -> f64,
) {
    spare.clear();
    let given = corners.iter().filter_map(|corner| Some((corner, corner.id.given()?)));
    let Some((mut before, last)) = given.clone().next_back() else { return };
    let (mut left, mut there) = (last, place(last));
    for (corner, reached) in given {
        let here = place(reached);
        match (there, here) {
            (Ordering::Less, Ordering::Greater) => {
                spare.push(cut(corner, [reached, left], [reached, left].map(&height)));
            }
            (Ordering::Greater, Ordering::Less) => {
                spare.push(cut(before, [left, reached], [left, reached].map(&height)));
            }
            _ => (),
        }
        if here != Ordering::Less {
            // An edge to a clip point starts where the corner was rounded to.
            let deviation = corner.deviation + 2.0 * ROUNDING * size(corner.at);
            spare.push(Corner { deviation, ..*corner });
        }
        (before, left, there) = (corner, reached, here);
    }
    std::mem::swap(corners, spare);
}

/// The point of an edge from `inner` where its height is zero.
///
/// The factor errs by 8 roundings of itself, the sum by those of its parts.
fn cut(inner: &Corner, ends: [DVec3; 2], [above, below]: [f64; 2]) -> Corner {
    let along = ends[1] - ends[0];
    let at = inner.at + along * (above / (above - below));
    let rounding = 2.0 * ROUNDING * (size(inner.at) + 8.0 * size(along));
    Corner { at, id: CornerId::cut(ends), deviation: inner.deviation + rounding, rounding }
}
