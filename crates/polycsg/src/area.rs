//! The shoelace sum in double-double arithmetic.

use crate::predicates::{Segment, exact_area};
use exactfloat::DoubleDouble;
use glam::DVec2;

/// The area that closed walks of directed edges enclose, counter-clockwise positive.
///
/// Each axis is scaled by a power of two that brings its largest coordinate near 1, so that no product leaves the
/// range, and the sum carries 106 bits: its error is below 1e-29 times the terms' sum. Where these all but cancel, exact
/// integers take over, so that the area is always right to an ulp or two. Beyond the range it is infinite, never NaN.
pub(crate) fn enclosed_area<W>(walks: impl Iterator<Item = W> + Clone) -> f64
where
    W: Iterator<Item = Segment> + Clone,
{
    let size = walks.clone().flatten().flatten().map(DVec2::abs).fold(DVec2::ZERO, DVec2::max);
    let exponents = [exponent(size.x), exponent(size.y)];
    let scale = DVec2::new(power(-exponents[0]), power(-exponents[1]));
    let (mut sum, mut terms) = (DoubleDouble::ZERO, 0.0);
    for walk in walks.clone() {
        let Some([origin, _]) = walk.clone().next() else { continue };
        let origin = origin * scale;
        let from_origin =
            |p: DVec2| [0, 1].map(|axis| DoubleDouble::difference(p[axis] * scale[axis], origin[axis]));
        for [a, b] in walk {
            let ([ax, ay], [bx, by]) = (from_origin(a), from_origin(b));
            let (l, r) = (ax * by, ay * bx);
            sum = sum + l - r;
            terms += l.hi.abs() + r.hi.abs();
        }
    }
    if sum.hi.abs() < terms * CANCELLED {
        return exact_area(walks.flatten());
    }
    // In two steps, either of which may only leave the range if the result does.
    let shift = exponents[0] + exponents[1] - 1;
    sum.round() * power(shift / 2) * power(shift - shift / 2)
}

/// `2^-42`: down to there an error of `1e-29` of the terms is below half an ulp of the sum.
const CANCELLED: f64 = f64::from_bits((1023 - 42) << 52);

/// The exponent of a number's leading bit, within -1022 … 1022.
fn exponent(size: f64) -> i32 {
    i32::from((size.to_bits() >> 52) as u16 & 0x7ff).clamp(1, 2045) - 1023
}

/// 2 to the power of -1022 … 1023.
fn power(exponent: i32) -> f64 {
    f64::from_bits(u64::from((exponent + 1023).unsigned_abs()) << 52)
}
