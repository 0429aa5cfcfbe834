//! Taylor models: polynomials of degree 3 in two variables on the square [-1, 1]^2, with a bound on what they leave out
//! [Makino and Berz 2003, Taylor models and other validated functional inclusion methods].
//!
//! A model stands for every function that differs from its polynomial by at most `rest` anywhere on the square. The bound
//! counts roundings: each operation adds more than what its sums and products can be off by.
use std::ops::{Add, Mul, Sub};

/// Monomials up to degree 3: 1, u, v, u^2, uv, v^2, u^3, u^2v, uv^2, v^3.
pub(crate) const TERMS: usize = 10;

const DEGREE: usize = 3;

/// More than what an operation's roundings add up to, as a share of its terms' magnitudes.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// A polynomial and a bound on what it leaves out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Taylor {
    pub(crate) terms: [f64; TERMS],
    pub(crate) rest: f64,
}

impl Taylor {
    pub(crate) const ZERO: Self = Self { terms: [0.0; TERMS], rest: 0.0 };

    /// A polynomial of which each term is within some roundings of numbers of this size.
    pub(crate) fn polynomial(terms: [f64; TERMS], size: f64) -> Self {
        Self { terms, rest: ROUNDINGS * size }
    }

    /// A number, and what it may be off by.
    pub(crate) fn constant(value: f64, rest: f64) -> Self {
        let mut terms = [0.0; TERMS];
        terms[0] = value;
        Self { terms, rest }
    }

    /// `c + a u + b v`, each within some roundings.
    pub(crate) fn linear([c, a, b]: [f64; 3]) -> Self {
        let mut terms = [0.0; TERMS];
        terms[..3].copy_from_slice(&[c, a, b]);
        Self { terms, rest: ROUNDINGS * (c.abs() + a.abs() + b.abs()) }
    }

    /// The sums of its terms' magnitudes by degree.
    fn sizes(&self) -> [f64; DEGREE + 1] {
        let [c, u, v, uu, uv, vv, uuu, uuv, uvv, vvv] = self.terms.map(f64::abs);
        [c, u + v, uu + uv + vv, uuu + uuv + uvv + vvv]
    }

    /// A bound on the magnitude anywhere.
    pub(crate) fn reach(&self) -> f64 {
        self.sizes().iter().sum::<f64>() + self.rest
    }

    /// A bound on how far it is from its constant anywhere.
    pub(crate) fn swing(&self) -> f64 {
        self.sizes()[1..].iter().sum::<f64>() + self.rest
    }

    /// Bounds on how far it is from its linear part.
    pub(crate) fn bend(&self) -> f64 {
        self.sizes()[2..].iter().sum::<f64>() + self.rest
    }

    pub(crate) fn scaled(&self, by: f64) -> Self {
        let rest = self.rest * by.abs() + ROUNDINGS * self.reach() * by.abs();
        Self { terms: self.terms.map(|c| c * by), rest }
    }

    /// What is left when the constant is taken off.
    fn without_constant(&self) -> Self {
        let mut other = *self;
        other.terms[0] = 0.0;
        other
    }

    /// `f0 + f1 d + f2 d^2 + f3 d^3`, where `d` is without its constant, and `left` more.
    fn series(&self, f: [f64; DEGREE + 1], left: f64) -> Self {
        let d = self.without_constant();
        let square = d * d;
        let cube = square * d;
        let sum = Self::constant(f[0], left) + d.scaled(f[1]) + square.scaled(f[2]) + cube.scaled(f[3]);
        let swing = self.swing();
        let sizes = ((f[3].abs() * swing + f[2].abs()) * swing + f[1].abs()) * swing + f[0].abs();
        Self { rest: sum.rest + RELATIVE * sizes, ..sum }
    }

    /// One over its square root; nothing unless it is positive by far.
    ///
    /// With t = c (1 + d) and |d| <= b < 1 the series in d leaves at most 35/128 b^4 (1 - b)^(-9/2).
    pub(crate) fn inverse_root(&self) -> Option<Self> {
        let middle = self.terms[0];
        let share = self.swing() / middle;
        if middle.is_nan() || middle <= 0.0 || share >= WIDEST {
            return None;
        }
        let left = 35.0 / 128.0 * share.powi(4) / (1.0 - share).powf(4.5);
        let series = self.scaled(1.0 / middle).series([1.0, -0.5, 0.375, -0.3125], left);
        Some(series.scaled(1.0 / middle.sqrt()))
    }

    /// phi(z) = acos(z) / sqrt(1 - z^2), the angle over its sine; nothing where z comes near -1.
    ///
    /// phi is the integral over s > 0 of 1 / (s^2 + 2 z s + 1). So its derivatives alternate in sign, and their magnitudes fall with z:
    /// the fourth one is largest at the least z.
    pub(crate) fn angle_over_sine(&self) -> Option<Self> {
        let least = self.terms[0] - self.swing();
        if least.is_nan() || least <= -WIDEST {
            return None;
        }
        let [f0, f1, f2, f3, _] = angle_series(self.terms[0]);
        let fourth = angle_series(least)[4] * (1.0 + RELATIVE);
        Some(self.series([f0, f1, f2, f3], fourth * self.swing().powi(4)))
    }
}

/// What series and roots of numbers may be off by, as a share of them.
const RELATIVE: f64 = 1e-12;

/// Series in more than this are not worth their rest.
const WIDEST: f64 = 0.97;

/// Values from here to 1 are expanded around 1.
const NEAR_ONE: f64 = 0.8;

/// phi(z) and its derivatives to the fourth, the n-th divided by n!.
///
/// (1 - z^2) phi' = z phi - 1, and derivatives of that; near 1, where this cancels, phi(z) is the sum of n! / (3/2)_n w^n with
/// w = (1 - z) / 2.
fn angle_series(z: f64) -> [f64; 5] {
    if z >= NEAR_ONE {
        return angle_series_near_one((1.0 - z) / 2.0);
    }
    let square = (1.0 - z) * (1.0 + z);
    let f = z.acos() / square.sqrt();
    let f1 = (z * f - 1.0) / square;
    let f2 = (3.0 * z * f1 + f) / square;
    let f3 = (5.0 * z * f2 + 4.0 * f1) / square;
    let f4 = (7.0 * z * f3 + 9.0 * f2) / square;
    [f, f1, f2 / 2.0, f3 / 6.0, f4 / 24.0]
}

/// n! / (3/2)_n, up to a term that is below 2^-60 at w = 1/10 in the fourth derivative.
const FACTORS: [f64; 26] = {
    let mut factors = [1.0; 26];
    let mut n = 1;
    while n < factors.len() {
        factors[n] = factors[n - 1] * n as f64 / (n as f64 + 0.5);
        n += 1;
    }
    factors
};

/// By Horner's rule for the polynomial and its derivatives at once; dw/dz = -1/2.
fn angle_series_near_one(w: f64) -> [f64; 5] {
    let mut sums = [0.0; 5];
    for factor in FACTORS.into_iter().rev() {
        for k in (1..5).rev() {
            sums[k] = sums[k] * w + sums[k - 1];
        }
        sums[0] = sums[0] * w + factor;
    }
    let [f, f1, f2, f3, f4] = sums;
    [f, f1 / -2.0, f2 / 4.0, f3 / -8.0, f4 / 16.0]
}

impl Add for Taylor {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let mut sum = self;
        sum.terms.iter_mut().zip(other.terms).for_each(|(c, d)| *c += d);
        sum.rest = self.rest + other.rest + ROUNDINGS * sum.sizes().iter().sum::<f64>();
        sum
    }
}

impl Sub for Taylor {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.add(Self { terms: other.terms.map(|c| -c), ..other })
    }
}

impl Mul for Taylor {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        // Written out: loops over the degrees took three times as long.
        let (a, b) = (&self.terms, &other.terms);
        let terms = [
            a[0] * b[0],
            a[0] * b[1] + a[1] * b[0],
            a[0] * b[2] + a[2] * b[0],
            a[0] * b[3] + a[1] * b[1] + a[3] * b[0],
            a[0] * b[4] + a[1] * b[2] + a[2] * b[1] + a[4] * b[0],
            a[0] * b[5] + a[2] * b[2] + a[5] * b[0],
            a[0] * b[6] + a[1] * b[3] + a[3] * b[1] + a[6] * b[0],
            a[0] * b[7] + a[1] * b[4] + a[2] * b[3] + a[3] * b[2] + a[4] * b[1] + a[7] * b[0],
            a[0] * b[8] + a[1] * b[5] + a[2] * b[4] + a[4] * b[2] + a[5] * b[1] + a[8] * b[0],
            a[0] * b[9] + a[2] * b[5] + a[5] * b[2] + a[9] * b[0],
        ];
        let (p, q) = (self.sizes(), other.sizes());
        let [one, two]: [f64; 2] = [p, q].map(|sizes| sizes.iter().sum());
        let left_out = p[1] * q[3] + p[2] * (q[2] + q[3]) + p[3] * (q[1] + q[2] + q[3]);
        let rests = self.rest * (two + other.rest) + one * other.rest;
        Self { terms, rest: (left_out + rests) * (1.0 + ROUNDINGS) + ROUNDINGS * one * two }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn value(model: &Taylor, u: f64, v: f64) -> f64 {
        let monomials = [1.0, u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v];
        model.terms.iter().zip(monomials).map(|(c, m)| c * m).sum()
    }

    fn angle_over_sine(z: f64) -> f64 {
        if z < 1.0 { z.acos() / (1.0 - z * z).sqrt() } else { z.acosh() / (z * z - 1.0).sqrt() }
    }

    fn linear() -> impl Strategy<Value = [f64; 3]> {
        [-1.0..1.0, -1.0..1.0, -1.0..1.0]
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        /// Whatever is done to models, functions stay within them.
        #[test]
        fn a_model_holds_its_function(
            a in linear(), b in linear(), c in linear(), u in -1.0..1.0f64, v in -1.0..1.0f64,
        ) {
            let at = |[c, a, b]: [f64; 3]| c + a * u + b * v;
            let [x, y, z] = [a, b, c].map(Taylor::linear);
            let product = x * y * z + y * y - x * x * y * z;
            let (p, q, r) = (at(a), at(b), at(c));
            let exact = p * q * r + q * q - p * p * q * r;
            prop_assert!((value(&product, u, v) - exact).abs() <= product.rest);
            let square = x * x + y * y + Taylor::constant(0.5, 0.0);
            if let Some(root) = square.inverse_root() {
                prop_assert!((value(&root, u, v) - 1.0 / (p * p + q * q + 0.5).sqrt()).abs() <= root.rest);
            }
            if let Some(angle) = x.angle_over_sine() {
                let exact = angle_over_sine(p);
                prop_assert!((value(&angle, u, v) - exact).abs() <= angle.rest + 1e-12 * exact);
            }
        }
    }

    /// Where both ways to the derivatives hold they agree.
    #[test]
    fn derivatives_agree_near_one() {
        let near = angle_series_near_one((1.0 - NEAR_ONE) / 2.0);
        let far = angle_series(NEAR_ONE - f64::EPSILON);
        for (n, f) in near.iter().zip(far) {
            assert!((n - f).abs() <= RELATIVE * f.abs(), "{n} {f}");
        }
    }
}
