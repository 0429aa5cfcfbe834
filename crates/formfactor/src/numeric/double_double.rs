//! Numbers of twice the precision: unevaluated sums of two doubles, about 2^-104 of relative error.
//!
//! Everything between a vertex and the double that it is projected to runs in this arithmetic, so that a projection which
//! is a double comes out as that double. It decides no sign: [`super::predicates`] does, with a bound on its error.
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number `hi + lo` with |lo| at most half an ulp of `hi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct DoubleDouble {
    pub(crate) hi: f64,
    pub(crate) lo: f64,
}

/// `a + b` exactly (Knuth).
pub(crate) fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    let t = hi - a;
    DoubleDouble { hi, lo: (a - (hi - t)) + (b - t) }
}

/// `a + b` exactly when |a| >= |b| (Dekker).
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble { hi, lo: b - (hi - a) }
}

/// The upper 26 bits of a significand and the rest (Veltkamp); right below 2^996.
fn split(a: f64) -> (f64, f64) {
    let t = 134_217_729.0 * a;
    let upper = t - (t - a);
    (upper, a - upper)
}

/// `a * b` exactly (Dekker), barring underflow.
pub(crate) fn two_product(a: f64, b: f64) -> DoubleDouble {
    let hi = a * b;
    let ((au, al), (bu, bl)) = (split(a), split(b));
    DoubleDouble { hi, lo: al * bl - (((hi - au * bu) - al * bu) - au * bl) }
}

impl DoubleDouble {
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

impl From<f64> for DoubleDouble {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let middle = quick_two_sum(high.hi, high.lo + low.hi);
        quick_two_sum(middle.hi, middle.lo + low.lo)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.hi, other.hi);
        quick_two_sum(product.hi, product.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let rest = self - other * Self::from(first);
        let second = rest.hi / other.hi;
        let rest = rest - other * Self::from(second);
        quick_two_sum(first, second) + Self::from(rest.hi / other.hi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::offset::{accurate_cross, accurate_dot};
    use dashu_int::IBig;
    use glam::DVec3;
    use proptest::prelude::*;

    /// A double of 20 bits times 2^-20 or so: sums and products of a few have an exact integer counterpart.
    fn small() -> impl Strategy<Value = i64> {
        -(1i64 << 52)..(1i64 << 52)
    }

    fn double(x: i64) -> f64 {
        // At most 53 bits: exact.
        x as f64
    }

    fn integer(x: DoubleDouble) -> IBig {
        IBig::try_from(x.hi).expect("an integer") + IBig::try_from(x.lo).expect("an integer")
    }

    proptest! {
        #[test]
        fn differences_and_products_of_doubles_are_exact(a in small(), b in small()) {
            prop_assert_eq!(integer(DoubleDouble::difference(double(a), double(b))), IBig::from(a) - IBig::from(b));
            let product = DoubleDouble::from(double(a)) * DoubleDouble::from(double(b));
            prop_assert_eq!(integer(product), IBig::from(a) * IBig::from(b));
        }

        #[test]
        fn quotients_that_are_doubles_come_out(a in small(), b in 1i64..(1 << 52)) {
            let product = DoubleDouble::from(double(a)) * DoubleDouble::from(double(b));
            prop_assert_eq!((product / DoubleDouble::from(double(b))).round(), double(a));
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
