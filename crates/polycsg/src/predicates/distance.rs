//! Distances of points from lines, in units of the lines' lengths, with 106 bits.

use super::segment::Segment;
use exactfloat::DoubleDouble;
use glam::DVec2;

/// 2^-97: more than the relative error of any of the few operations on double-doubles in a row.
pub(super) const RELATIVE: f64 = f64::from_bits((1023 - 97) << 52);

/// Where no product of four differences under- or overflows, nor a low part of one: coordinates are 0 or in 2^-100 … 2^100.
pub(super) fn is_moderate(p: DVec2) -> bool {
    const LOW: f64 = f64::from_bits((1023 - 100) << 52);
    const HIGH: f64 = f64::from_bits((1023 + 100) << 52);
    p.to_array().iter().all(|&x| x == 0.0 || (LOW..=HIGH).contains(&x.abs()))
}

/// The size of the doubled area of a segment and a point, and a bound on its error; coordinates are moderate.
///
/// Differences are exact, and each further operation is right to 2^-100 of itself.
pub(super) fn distance([p, q]: Segment, point: DVec2) -> (DoubleDouble, f64) {
    let difference =
        |a: DVec2| (DoubleDouble::difference(a.x, point.x), DoubleDouble::difference(a.y, point.y));
    let ((ux, uy), (vx, vy)) = (difference(p), difference(q));
    let (l, r) = (ux * vy, uy * vx);
    let area = l - r;
    (if area.hi < 0.0 { -area } else { area }, RELATIVE * (l.hi.abs() + r.hi.abs()))
}
