//! The contour sum (2.4) of a convex part, in plain doubles, as the sources use it.
use glam::DVec3;
use std::f64::consts::TAU;

/// The form factor to a convex polygon without occlusion; corners relative to dA, counter-clockwise seen from the front,
/// with dA before it. What lies below the horizon is cut off first: (2.4) alone would count it as negative.
pub(super) fn contour(normal: DVec3, corners: &[DVec3]) -> f64 {
    let corners = above(normal, corners);
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let sum: f64 = edges.map(|(a, b)| term(normal, *a, *b)).sum();
    (sum / TAU).max(0.0)
}

/// beta N . (b x a) / |b x a|; 0 for an edge seen end-on.
fn term(normal: DVec3, a: DVec3, b: DVec3) -> f64 {
    let cross = b.cross(a);
    let sine = cross.length();
    if sine == 0.0 { 0.0 } else { sine.atan2(a.dot(b)) * normal.dot(cross) / sine }
}

/// The part of a convex polygon that is not below the horizon.
pub(super) fn above(normal: DVec3, corners: &[DVec3]) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (from, to) = (normal.dot(*a), normal.dot(*b));
        if from >= 0.0 {
            kept.push(*a);
        }
        if (from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0) {
            kept.push(*a + (*b - *a) * (from / (from - to)));
        }
    }
    kept
}
