//! Clipping of convex polygons by a plane.
use super::cone::{Corner, size};
use crate::numeric::rounding::ROUNDING;
use glam::DVec3;
use std::cmp::Ordering;

/// Keeps the part of a convex polygon that is not on the lower side of a plane. `place` says where a vertex lies,
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
    let Some(last) = corners.last() else { return };
    let (mut before, mut there) = (last.at, place(last.at));
    for corner in corners.iter() {
        let here = place(corner.at);
        match (there, here) {
            (Ordering::Less, Ordering::Greater) => spare.push(cut(corner.at, before, &height)),
            (Ordering::Greater, Ordering::Less) => spare.push(cut(before, corner.at, &height)),
            _ => (),
        }
        if here != Ordering::Less {
            spare.push(*corner);
        }
        (before, there) = (corner.at, here);
    }
    std::mem::swap(corners, spare);
}

/// The point of an edge where its height is zero.
///
/// The factor errs by 8 roundings of itself, the sum by those of its parts.
fn cut(inner: DVec3, outer: DVec3, height: impl Fn(DVec3) -> f64) -> Corner {
    let (above, below) = (height(inner), height(outer));
    let along = outer - inner;
    let at = inner + along * (above / (above - below));
    Corner { at, deviation: 2.0 * ROUNDING * (size(inner) + 8.0 * size(along)) }
}
