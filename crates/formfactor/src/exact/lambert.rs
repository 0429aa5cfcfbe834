//! Lambert's contour sum with a bound on its error.
//!
//! F = 1/(2 pi) sum of beta_k N . (R_{k+1} x R_k) / |R_{k+1} x R_k| over the directed edges of the visible boundary,
//! beta = atan2(|R_k x R_{k+1}|, R_k . R_{k+1}). [Barreto 2008, (2.4); the order of the cross product makes the sum
//! positive for loops that are counter-clockwise seen from the target's front.]
//!
//! **The bound.** A term has two errors. *Arithmetic*: cross and dot products are compensated, each within two roundings, so
//! that the term errs by at most 24 roundings of beta, and by what cancellation leaves of the compensation. *Directions*: that
//! to a vertex is off by at most some angle. Moving the ends of an arc of angle beta by e0 and e1 sweeps two spherical
//! triangles, each of area at most 2 asin(tan(e/2) tan(beta/2)); as cos <= 1, the form factor changes by at most the swept area
//! over pi. Two sets differ by no more than what their boundaries swept, whatever their holes and crossings, and two unions by
//! no more than the sum over their members.
use crate::form_factor::FormFactor;
use crate::numeric::offset::{accurate_cross, accurate_dot};
use crate::numeric::rounding::ROUNDING;
use exactfloat::DoubleDouble;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// What compensation leaves of a product's terms.
const COMPENSATED: f64 = ROUNDING * ROUNDING * 64.0;

/// The direction to a vertex of a contour, and a bound on its angle to the true one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Direction {
    pub(crate) toward: DVec3,
    pub(crate) error: f64,
}

/// Lambert's sum over directed edges, in any order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContourSum {
    normal: DVec3,
    sum: DoubleDouble,
    error: f64,
}

impl ContourSum {
    pub(crate) fn new(normal: DVec3) -> Self {
        Self { normal, sum: DoubleDouble::ZERO, error: 0.0 }
    }

    /// Adds the edge from `a` to `b`, the region to its left seen from the target's front.
    pub(crate) fn add(&mut self, a: Direction, b: Direction) {
        let arc = Arc::between(a, b);
        self.error += arc.swept(a.error + b.error);
        if arc.sine > 0.0 {
            let cosine = accurate_dot(self.normal, arc.cross) / arc.sine;
            self.sum = self.sum - DoubleDouble::from(arc.angle() * cosine / TAU);
            self.error += arc.angle() / TAU * (24.0 * ROUNDING + arc.cancelled());
        }
    }

    /// Adds an edge on the horizon, the region above it.
    ///
    /// Its plane is the horizon and its cosine 1, so that it adds its angle, which errs by the errors of its ends. The edges
    /// before and after it do not share those errors with it: each adds at most the angle by which its end is off, over 2 pi.
    pub(crate) fn add_horizon(&mut self, a: Direction, b: Direction) {
        let arc = Arc::between(a, b);
        self.sum = self.sum + DoubleDouble::from(arc.angle() / TAU);
        self.error += (24.0 * ROUNDING * arc.angle() + COMPENSATED + 2.0 * (a.error + b.error)) / TAU;
    }

    /// The whole of a closed loop.
    pub(crate) fn add_loop(&mut self, directions: &[Direction]) {
        let Some(last) = directions.last() else { return };
        directions.iter().fold(*last, |a, b| {
            self.add(a, *b);
            *b
        });
    }

    /// The form factor, with an error of at most `error` from elsewhere.
    pub(crate) fn form_factor(&self, error: f64) -> FormFactor {
        let sum = self.sum.round();
        if sum.is_nan() {
            // An edge passes through dA: nothing is known.
            return FormFactor { value: 0.0, error_bound: 1.0 };
        }
        let value = sum.clamp(0.0, 1.0);
        FormFactor { value, error_bound: (self.error + error + ROUNDING * value).min(1.0) }
    }
}

/// The length of a vector whose square may underflow.
fn length(v: DVec3) -> f64 {
    let largest = v.abs().max_element();
    if largest < 1e-140 && largest > 0.0 { (v / largest).length() * largest } else { v.length() }
}

/// A great-circle arc between two directions of any length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arc {
    cross: DVec3,
    sine: f64,
    cosine: f64,
    lengths: f64,
}

impl Arc {
    pub(crate) fn between(a: Direction, b: Direction) -> Self {
        let cross = accurate_cross(a.toward, b.toward);
        let cosine = accurate_dot(a.toward, b.toward);
        Self { cross, sine: length(cross), cosine, lengths: a.toward.length() * b.toward.length() }
    }

    pub(crate) fn angle(&self) -> f64 {
        self.sine.atan2(self.cosine)
    }

    /// The relative error of `cross` where its terms cancel beyond the compensation.
    fn cancelled(&self) -> f64 {
        COMPENSATED * self.lengths / self.sine
    }

    /// A bound on the change of a form factor when the ends move by angles whose sum is `moved`.
    fn swept(&self, moved: f64) -> f64 {
        if moved == 0.0 {
            0.0
        } else {
            swept_within(moved, self.sine / (self.lengths + self.cosine).max(0.0))
        }
    }
}

/// A bound on the change of a form factor when the ends of an arc move within their errors.
pub(crate) fn swept(a: Direction, b: Direction) -> f64 {
    let moved = a.error + b.error;
    if moved == 0.0 {
        return 0.0;
    }
    // Plain products err by a few roundings of the lengths.
    let lengths = a.toward.length() * b.toward.length();
    let error = 16.0 * ROUNDING * lengths;
    let sine = a.toward.cross(b.toward).length() + error;
    swept_within(moved, sine / (lengths + a.toward.dot(b.toward) - error).max(0.0))
}

/// The bound for an arc with this tangent of half its angle; 1 when the ends may move too far for it to hold.
///
/// Up to s = moved (tan(beta/2) + moved) = 1/4 the two triangles have less than 3/2 s of area.
fn swept_within(moved: f64, half_tangent: f64) -> f64 {
    let swept = moved * (half_tangent + moved);
    // Written so that NaN, an edge through dA, is not small.
    if swept <= 0.25 { 1.5 / PI * swept } else { 1.0 }
}
