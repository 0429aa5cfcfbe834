//! Numbers of twice the precision: unevaluated sums of two doubles, about 2^-104 of relative error.
//!
//! Everything between a vertex and the double that it is projected to runs in this arithmetic, so that a projection which
//! is a double comes out as that double. It decides no sign: [`crate::predicates`] does, with a bound on its error.
use glam::DVec3;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number `hi + lo` with |lo| at most half an ulp of `hi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Twofold {
    pub(crate) hi: f64,
    pub(crate) lo: f64,
}

/// `a + b` exactly (Knuth).
fn two_sum(a: f64, b: f64) -> Twofold {
    let hi = a + b;
    let t = hi - a;
    Twofold { hi, lo: (a - (hi - t)) + (b - t) }
}

/// `a + b` exactly when |a| >= |b| (Dekker).
fn quick_two_sum(a: f64, b: f64) -> Twofold {
    let hi = a + b;
    Twofold { hi, lo: b - (hi - a) }
}

/// The upper 26 bits of a significand and the rest (Veltkamp); right below 2^996.
fn split(a: f64) -> (f64, f64) {
    let t = 134_217_729.0 * a;
    let upper = t - (t - a);
    (upper, a - upper)
}

/// `a * b` exactly (Dekker), barring underflow.
fn two_product(a: f64, b: f64) -> Twofold {
    let hi = a * b;
    let ((au, al), (bu, bl)) = (split(a), split(b));
    Twofold { hi, lo: al * bl - (((hi - au * bu) - al * bu) - au * bl) }
}

impl Twofold {
    pub(crate) const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// `a - b` exactly.
    pub(crate) fn difference(a: f64, b: f64) -> Self {
        two_sum(a, -b)
    }

    /// The nearest double.
    pub(crate) fn round(self) -> f64 {
        self.hi + self.lo
    }
}

impl From<f64> for Twofold {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Neg for Twofold {
    type Output = Self;
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for Twofold {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let middle = quick_two_sum(high.hi, high.lo + low.hi);
        quick_two_sum(middle.hi, middle.lo + low.lo)
    }
}

impl Sub for Twofold {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Twofold {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.hi, other.hi);
        quick_two_sum(product.hi, product.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for Twofold {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let rest = self - other * Self::from(first);
        let second = rest.hi / other.hi;
        let rest = rest - other * Self::from(second);
        quick_two_sum(first, second) + Self::from(rest.hi / other.hi)
    }
}

/// A vector of twofold numbers: where something lies as seen from dA.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Offset(pub(crate) [Twofold; 3]);

impl Offset {
    /// `to - from` exactly.
    pub(crate) fn between(from: DVec3, to: DVec3) -> Self {
        Self([0, 1, 2].map(|i| Twofold::difference(to[i], from[i])))
    }

    /// The way to another offset.
    pub(crate) fn to(self, other: Self) -> Self {
        Self([0, 1, 2].map(|i| other.0[i] - self.0[i]))
    }

    /// The nearest vector of doubles.
    pub(crate) fn round(self) -> DVec3 {
        DVec3::from_array(self.0.map(Twofold::round))
    }

    /// The magnitudes of its components, as they enter the error of a product.
    pub(crate) fn sizes(self) -> DVec3 {
        sizes(self.round())
    }

    pub(crate) fn dot(self, other: Self) -> Twofold {
        (0..3).map(|i| self.0[i] * other.0[i]).fold(Twofold::ZERO, Add::add)
    }

    /// The cross product, and the sums of its terms' magnitudes: each component errs by less than 2^-99 of its sum.
    pub(crate) fn cross(self, other: Self) -> (Self, DVec3) {
        let (a, b) = (self.0, other.0);
        let term = |i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let terms = size(a[j].hi) * size(b[k].hi) + size(a[k].hi) * size(b[j].hi);
            (a[j] * b[k] - a[k] * b[j], terms)
        };
        let parts = [0, 1, 2].map(term);
        (Self(parts.map(|t| t.0)), DVec3::from_array(parts.map(|t| t.1)))
    }

    /// The point at `share` of the way to `other`, within 2^-98 of the two lengths.
    pub(crate) fn toward(self, other: Self, share: Twofold) -> Self {
        Self([0, 1, 2].map(|i| self.0[i] + share * (other.0[i] - self.0[i])))
    }
}

/// The magnitude of a factor as it enters a bound: zero for zero, else at least 2^-250, so that the product of three
/// neither underflows itself nor is less than what underflow loses in the product that it bounds.
pub(crate) fn size(x: f64) -> f64 {
    const LEAST: f64 = 5.527_147_875_260_445e-76;
    if x == 0.0 { 0.0 } else { x.abs().max(LEAST) }
}

pub(crate) fn sizes(v: DVec3) -> DVec3 {
    DVec3::new(size(v.x), size(v.y), size(v.z))
}

/// `a x b`, each component within two roundings of itself and 2^-104 of its terms.
pub(crate) fn accurate_cross(a: DVec3, b: DVec3) -> DVec3 {
    let component = |i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (p, q) = (two_product(a[j], b[k]), two_product(a[k], b[j]));
        let high = two_sum(p.hi, -q.hi);
        high.hi + (high.lo + (p.lo - q.lo))
    };
    DVec3::new(component(0), component(1), component(2))
}

/// `a . b` within two roundings of itself and 2^-103 of its terms.
pub(crate) fn accurate_dot(a: DVec3, b: DVec3) -> f64 {
    let (x, y, z) = (two_product(a.x, b.x), two_product(a.y, b.y), two_product(a.z, b.z));
    let first = two_sum(x.hi, y.hi);
    let second = two_sum(first.hi, z.hi);
    second.hi + (second.lo + first.lo + (x.lo + y.lo + z.lo))
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu_int::IBig;
    use proptest::prelude::*;

    /// A double of 20 bits times 2^-20 or so: sums and products of a few have an exact integer counterpart.
    fn small() -> impl Strategy<Value = i64> {
        -(1i64 << 52)..(1i64 << 52)
    }

    fn double(x: i64) -> f64 {
        // At most 53 bits: exact.
        x as f64
    }

    fn integer(x: Twofold) -> IBig {
        IBig::try_from(x.hi).expect("an integer") + IBig::try_from(x.lo).expect("an integer")
    }

    proptest! {
        #[test]
        fn differences_and_products_of_doubles_are_exact(a in small(), b in small()) {
            prop_assert_eq!(integer(Twofold::difference(double(a), double(b))), IBig::from(a) - IBig::from(b));
            let product = Twofold::from(double(a)) * Twofold::from(double(b));
            prop_assert_eq!(integer(product), IBig::from(a) * IBig::from(b));
        }

        #[test]
        fn quotients_that_are_doubles_come_out(a in small(), b in 1i64..(1 << 52)) {
            let product = Twofold::from(double(a)) * Twofold::from(double(b));
            prop_assert_eq!((product / Twofold::from(double(b))).round(), double(a));
        }

        #[test]
        fn accurate_products_round_the_exact_ones(v in prop::array::uniform6(small())) {
            let (a, b) = (DVec3::new(double(v[0]), double(v[1]), double(v[2])), DVec3::new(double(v[3]), double(v[4]), double(v[5])));
            let w: Vec<IBig> = v.iter().map(|x| IBig::from(*x)).collect();
            let exact = &w[0] * &w[3] + &w[1] * &w[4] + &w[2] * &w[5];
            let (dot, exact) = (accurate_dot(a, b), exact.to_f64().value());
            prop_assert!((dot - exact).abs() <= 2.0 * f64::EPSILON * exact.abs());
            let exact = (&w[1] * &w[5] - &w[2] * &w[4]).to_f64().value();
            prop_assert!((accurate_cross(a, b).x - exact).abs() <= 2.0 * f64::EPSILON * exact.abs());
        }
    }
}
