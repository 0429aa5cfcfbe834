//! Integrals over two surfaces, and what they may err by.
use crate::scene::surfaces::Surface;
use std::f64::consts::PI;

/// An integral, an estimate of its error, and how many values of the integrand it took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Integral {
    pub(super) value: f64,
    pub(super) error: f64,
    pub(super) evaluations: u64,
}

impl Integral {
    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            error: self.error + other.error,
            evaluations: self.evaluations + other.evaluations,
        }
    }
}

/// What a pair is allowed to err by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Allowed {
    /// Of the integral over both.
    pub(super) absolute: f64,
    /// Of its value.
    pub(super) relative: f64,
    /// Of the square root of its value were nothing in between.
    pub(super) of_root: f64,
    /// Of the integral over both, whatever it were: an equal share of what is left of a row's tolerance.
    pub(super) equal: f64,
    pub(super) evaluations: u64,
}

impl Allowed {
    /// A part of it.
    pub(super) fn part(&self, share: f64) -> Self {
        let parts = [self.absolute, self.relative, self.of_root, self.equal].map(|x| x * share);
        let [absolute, relative, of_root, equal] = parts;
        Self { absolute, relative, of_root, equal, ..*self }
    }

    pub(super) fn error(&self, value: f64, whole: f64) -> f64 {
        self.absolute.max(self.relative * value).min(self.of_root * whole.sqrt() + self.equal)
    }
}

/// Surfaces that see each other at a flat angle count as if they saw each other at a steeper one in a row's tolerance: an eighth of
/// the largest integral that there may be.
pub(super) fn least_whole(one: &Surface, other: &Surface) -> f64 {
    let most = one.area * other.area / (PI * one.middle.distance_squared(other.middle));
    (most / 8.0).min(one.area).min(other.area)
}

/// What no point factor from one surface to the other exceeds, by its size and the distance.
pub(super) fn most(one: &Surface, other: &Surface) -> f64 {
    let away = one.middle.distance(other.middle) - one.radius - other.radius;
    let above = |from: &Surface, to: &Surface| to.face[1].dot(from.middle - to.face[0]) - from.radius;
    let away = away.max(above(one, other));
    if away > 0.0 { (other.area / (PI * away * away)).min(1.0) } else { 1.0 }
}
