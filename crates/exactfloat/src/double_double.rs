//! Double-double arithmetic: about 106 bits.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// An unevaluated sum of two doubles with `|lo|` at most half an ulp of `hi`.
///
/// The sum, difference and product of two doubles are exact. Every operation on double-doubles is right to a relative
/// 2^-100, with room to spare, where nothing over- or underflows (Joldes, Muller and Popescu, "Tight and rigorous error bounds for
/// basic building blocks of double-word arithmetic", 2017: algorithms 6, 11 and a division by two residuals). Products
/// are exact for factors below 2^996 whose product is above 2^-968.
///
/// ```
/// use exactfloat::DoubleDouble;
/// let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
/// let rest = DoubleDouble::from(1.0) - third * DoubleDouble::from(3.0);
/// assert!(rest.round().abs() < 1e-31);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[must_use]
pub struct DoubleDouble {
    /// The nearest double.
    pub hi: f64,
    /// What it misses.
    pub lo: f64,
}

impl DoubleDouble {
    /// 0.
    pub const ZERO: DoubleDouble = DoubleDouble { hi: 0.0, lo: 0.0 };

    /// `a + b` exactly (Knuth's two-sum).
    #[inline]
    pub fn sum(a: f64, b: f64) -> DoubleDouble {
        let hi = a + b;
        let t = hi - a;
        DoubleDouble { hi, lo: (a - (hi - t)) + (b - t) }
    }

    /// `a - b` exactly.
    #[inline]
    pub fn difference(a: f64, b: f64) -> DoubleDouble {
        DoubleDouble::sum(a, -b)
    }

    /// `a * b` exactly (Dekker's product with Veltkamp's split).
    #[inline]
    pub fn product(a: f64, b: f64) -> DoubleDouble {
        let hi = a * b;
        let ((au, al), (bu, bl)) = (split(a), split(b));
        DoubleDouble { hi, lo: ((au * bu - hi) + au * bl + al * bu) + al * bl }
    }

    /// The nearest double.
    #[inline]
    #[must_use]
    pub fn round(self) -> f64 {
        self.hi + self.lo
    }
}

/// `a + b` exactly when `|a| >= |b|` or `a` is 0 (Dekker's fast two-sum).
#[inline]
fn fast_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble { hi, lo: b - (hi - a) }
}

/// The upper 26 bits of a significand and the rest.
#[inline]
fn split(a: f64) -> (f64, f64) {
    let t = 134_217_729.0 * a;
    let upper = t - (t - a);
    (upper, a - upper)
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(hi: f64) -> DoubleDouble {
        DoubleDouble { hi, lo: 0.0 }
    }
}

impl Neg for DoubleDouble {
    type Output = DoubleDouble;
    #[inline]
    fn neg(self) -> DoubleDouble {
        DoubleDouble { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for DoubleDouble {
    type Output = DoubleDouble;
    #[inline]
    fn add(self, other: DoubleDouble) -> DoubleDouble {
        let (high, low) = (DoubleDouble::sum(self.hi, other.hi), DoubleDouble::sum(self.lo, other.lo));
        let middle = fast_sum(high.hi, high.lo + low.hi);
        fast_sum(middle.hi, middle.lo + low.lo)
    }
}

impl Sub for DoubleDouble {
    type Output = DoubleDouble;
    #[inline]
    fn sub(self, other: DoubleDouble) -> DoubleDouble {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = DoubleDouble;
    #[inline]
    fn mul(self, other: DoubleDouble) -> DoubleDouble {
        let product = DoubleDouble::product(self.hi, other.hi);
        fast_sum(product.hi, product.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for DoubleDouble {
    type Output = DoubleDouble;
    #[inline]
    fn div(self, other: DoubleDouble) -> DoubleDouble {
        let first = self.hi / other.hi;
        let rest = self - other * DoubleDouble::from(first);
        let second = rest.hi / other.hi;
        let rest = rest - other * DoubleDouble::from(second);
        fast_sum(first, second) + DoubleDouble::from(rest.hi / other.hi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use num_traits::Signed;
    use proptest::prelude::*;

    fn exact(x: DoubleDouble) -> BigRational {
        [x.hi, x.lo].into_iter().map(|x| BigRational::from_float(x).expect("finite")).sum()
    }

    /// Doubles of full precision, of exponents that leave room for a few products.
    fn double() -> impl Strategy<Value = f64> {
        (-1.0..1.0f64, -60i32..60).prop_map(|(m, e)| m * 2f64.powi(e))
    }

    fn pair() -> impl Strategy<Value = DoubleDouble> {
        (double(), -1.0..1.0f64).prop_map(|(hi, lo)| DoubleDouble::sum(hi, hi * lo * 2f64.powi(-53)))
    }

    fn is_close(value: DoubleDouble, wanted: &BigRational) -> bool {
        let bound = wanted.abs() * BigRational::from_float(2f64.powi(-100)).expect("finite");
        (exact(value) - wanted).abs() <= bound && value.hi == value.round()
    }

    proptest! {
        #[test]
        fn operations_on_doubles_are_exact(a in double(), b in double()) {
            let [x, y] = [a, b].map(|x| exact(x.into()));
            prop_assert_eq!(exact(DoubleDouble::sum(a, b)), &x + &y);
            prop_assert_eq!(exact(DoubleDouble::difference(a, b)), &x - &y);
            prop_assert_eq!(exact(DoubleDouble::product(a, b)), x * y);
        }

        #[test]
        fn operations_keep_their_bound(a in pair(), b in pair()) {
            let (x, y) = (exact(a), exact(b));
            prop_assert!(is_close(a + b, &(&x + &y)));
            prop_assert!(is_close(a - b, &(&x - &y)));
            prop_assert!(is_close(a * b, &(&x * &y)));
            if b.hi != 0.0 {
                prop_assert!(is_close(a / b, &(x / y)));
            }
        }

        #[test]
        fn quotients_that_are_doubles_come_out(a in double(), b in double()) {
            if b != 0.0 {
                prop_assert_eq!((DoubleDouble::product(a, b) / DoubleDouble::from(b)).round(), a);
            }
        }

        #[test]
        fn sums_that_cancel_keep_their_bits(a in pair(), ulps in -4i64..5) {
            let b = DoubleDouble::from(f64::from_bits(a.hi.to_bits().wrapping_add_signed(ulps)));
            prop_assert!(is_close(a - b, &(exact(a) - exact(b))));
        }
    }
}
