//! The unit roundoff of doubles, and the range of coordinates that is accepted.
use glam::DVec3;

/// The smallest extent and the inverse of the largest coordinate that are accepted: 2^-200.
pub(crate) const SMALLEST: f64 = 6.223_015_277_861_142e-61;

/// The unit roundoff, half an ulp of 1: one rounding errs by at most this much of its result.
pub(crate) const ROUNDING: f64 = f64::EPSILON / 2.0;

/// How far roundings may put points off a plane that is through some of them.
pub(crate) fn rounding_of(points: impl IntoIterator<Item = DVec3>) -> f64 {
    let largest = points.into_iter().fold(0.0, |most: f64, p| most.max(p.abs().max_element()));
    8.0 * f64::EPSILON * largest
}

/// Whether every coordinate is a number that cannot overflow in the arithmetic of this crate.
pub(crate) fn in_range(point: DVec3) -> bool {
    point.is_finite() && point.abs().max_element() <= 1.0 / SMALLEST
}
