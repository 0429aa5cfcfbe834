//! Where a convex polygon lies in another one's plane, up to a reach: which of the two is before the other is not known there.
use super::clip::before;
use crate::scene::occluder::Face;
use crate::scene::surfaces::area;
use glam::DVec3;

/// The area of the parts of convex pieces that are within `reach` of a convex polygon along its plane's normal, given the polygon's
/// edges, counter-clockwise seen from where the normal points to.
pub(super) fn contact(
    pieces: &[Vec<DVec3>],
    edges: impl Iterator<Item = [DVec3; 2]>,
    [on, normal]: Face,
    reach: f64,
) -> f64 {
    let above = before(pieces, [on - normal * reach, normal]);
    let mut left = before(&above, [on + normal * reach, -normal]);
    for [a, b] in edges {
        if left.is_empty() {
            break;
        }
        let inward = normal.cross(b - a).normalize_or_zero();
        left = before(&left, [a - inward * reach, inward]);
    }
    left.iter().map(|piece| area(piece)).sum()
}
