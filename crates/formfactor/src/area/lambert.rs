//! Lambert's sum over a convex polygon, in doubles.
use glam::DVec3;
use std::f64::consts::TAU;

/// Below this squared tangent of an angle its series converges: see [`arc`].
const SMALL: f64 = 1.0 / 16.0;

/// atan(t) / t by its Taylor series in t^2 <= 1/16: eleven terms leave less than 16^-11 / 23 < 3e-15.
fn arc(square: f64) -> f64 {
    // Written out: loops over the terms took three times as long.
    let (s, q) = (square, square * square);
    let low = (1.0 - s * (1.0 / 3.0)) + q * (1.0 / 5.0 - s * (1.0 / 7.0));
    let middle = (1.0 / 9.0 - s * (1.0 / 11.0)) + q * (1.0 / 13.0 - s * (1.0 / 15.0));
    let high = (1.0 / 17.0 - s * (1.0 / 19.0)) + q * (1.0 / 21.0);
    let quartic = q * q;
    low + quartic * (middle + quartic * high)
}

/// Lambert's sum over a convex polygon given relative to the point, counter-clockwise as the point sees it.
pub(super) fn lambert(normal: DVec3, corners: &[DVec3]) -> f64 {
    let Some(mut a) = corners.last().copied() else { return 0.0 };
    let mut sum = 0.0;
    for &b in corners {
        let (cross, cosine) = (b.cross(a), a.dot(b));
        let square = cross.length_squared();
        let rise = normal.dot(cross);
        if cosine > 0.0 && square < SMALL * cosine * cosine {
            sum += rise * arc(square / (cosine * cosine)) / cosine;
        } else if square > 0.0 {
            let sine = square.sqrt();
            sum += rise * sine.atan2(cosine) / sine;
        }
        a = b;
    }
    (sum / TAU).max(0.0)
}
