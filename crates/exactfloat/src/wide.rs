//! Numbers with 125 bits, an exponent of their own and a bound on their error: a filter for what doubles leave open, over the whole
//! range of exponents, before integers of any size.

use crate::fixed::full_product;
use crate::integers::decode;
use dashu_int::Sign;
use std::cmp::Ordering;
use std::ops::{Mul, Sub};

/// Integers are kept below 2^125.
const BITS: u32 = 125;

/// More than the relative error of the few operations on a bound in a row.
const SLACK: f64 = 1.0 + f64::EPSILON * 8.0;

/// `integer · 2^exponent`, off by `error · 2^exponent` at most. Nothing over- or underflows in polynomials of degree 4.
///
/// Differences and products are exact as long as they have no more than 125 bits; else they are cut off there, and the bound says so.
///
/// ```
/// use exactfloat::Wide;
/// let [huge, one, tiny] = [1e300, 1.0, 1e-300].map(Wide::from);
/// assert!((huge * huge - tiny).compare(huge * one).is_some_and(|order| order.is_gt()));
/// assert!((huge * one).compare(one * huge).is_some_and(|order| order.is_eq()));
/// assert!((one - tiny).compare(one).is_none()); // that takes a thousand bits
/// ```
#[derive(Clone, Copy, Debug)]
#[must_use]
pub struct Wide {
    integer: i128,
    exponent: i32,
    error: f64,
}

fn bits(integer: i128) -> u32 {
    i128::BITS - integer.unsigned_abs().leading_zeros()
}

/// 2^`exponent`, or a little more where that is tiny.
fn power(exponent: i32) -> f64 {
    f64::from_bits(u64::from((exponent.max(-1000) + 1023).unsigned_abs()) << 52)
}

impl Wide {
    /// The same with so many bits less; what that cuts off adds to the error.
    fn cut(self, bits: u32) -> Wide {
        if bits == 0 {
            return self;
        }
        let integer = self.integer >> bits.min(i128::BITS - 1);
        let is_exact = self.integer == 0 || (bits < i128::BITS && integer << bits == self.integer);
        let error = self.error * power(-(bits as i32)) + f64::from(u8::from(!is_exact));
        Wide { integer, exponent: self.exponent + bits as i32, error: error * SLACK }
    }

    /// The order, where the bounds prove it.
    #[must_use]
    pub fn compare(self, other: Wide) -> Option<Ordering> {
        let Wide { integer, error, .. } = self - other;
        #[expect(clippy::cast_precision_loss, reason = "the slack covers it")]
        let size = integer.unsigned_abs() as f64;
        (error == 0.0 || size > error * SLACK).then_some(integer.cmp(&0))
    }
}

impl From<f64> for Wide {
    fn from(x: f64) -> Wide {
        let (sign, mantissa, exponent) = decode(x);
        let integer = i128::from(mantissa);
        // Next to zero any other number keeps all of its bits.
        let exponent = exponent.unwrap_or(-20_000);
        Wide { integer: if sign == Sign::Negative { -integer } else { integer }, exponent, error: 0.0 }
    }
}

impl Sub for Wide {
    type Output = Wide;
    fn sub(self, other: Wide) -> Wide {
        let is_swapped = self.exponent < other.exponent;
        let (high, low) = if is_swapped { (other, self) } else { (self, other) };
        let gap = high.exponent.abs_diff(low.exponent);
        let up = gap.min(BITS.saturating_sub(bits(high.integer)));
        let low = low.cut(gap - up);
        let integer = (high.integer << up) - low.integer;
        let error = (high.error * power(up as i32) + low.error) * SLACK;
        let integer = if is_swapped { -integer } else { integer };
        Wide { integer, exponent: low.exponent, error }.cut(bits(integer).saturating_sub(BITS))
    }
}

impl Mul for Wide {
    type Output = Wide;
    fn mul(self, other: Wide) -> Wide {
        let (a, b) = (bits(self.integer), bits(other.integer));
        let excess = (a + b).saturating_sub(BITS);
        let exponent = self.exponent + other.exponent;
        let size = |bits: u32| power(bits as i32);
        let error = (size(a) * other.error + size(b) * self.error + self.error * other.error) * SLACK * SLACK;
        if excess == 0 {
            return Wide { integer: self.integer * other.integer, exponent, error };
        }
        let [high, low] = full_product(self.integer.unsigned_abs(), other.integer.unsigned_abs());
        let magnitude = (high << (i128::BITS - excess) | low >> excess) as i128;
        let integer = if (self.integer < 0) == (other.integer < 0) { magnitude } else { -magnitude };
        let is_exact = low << (i128::BITS - excess) == 0;
        let error = (error * power(-(excess as i32)) + f64::from(u8::from(!is_exact))) * SLACK;
        Wide { integer, exponent: exponent + excess as i32, error }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use proptest::prelude::*;

    /// Ordinary numbers, some ulps apart, and those of any exponent.
    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![
            (-4i32..5).prop_map(f64::from),
            (-3i32..4).prop_map(|ulps| 1.0 + f64::from(ulps) * f64::EPSILON),
            -1.0..1.0f64,
            (-1.0..1.0f64, -1070i32..1020).prop_map(|(m, e)| m * 2f64.powi(e / 2) * 2f64.powi(e - e / 2)),
            Just(f64::MAX),
            Just(5e-324),
        ]
    }

    fn exact(x: f64) -> BigRational {
        BigRational::from_float(x).expect("finite")
    }

    /// A polynomial of degree 4, once with each kind of number.
    fn terms<T: Clone + Sub<Output = T> + Mul<Output = T>>([a, b, c, d, e, f]: [T; 6]) -> [T; 2] {
        let cross = (a.clone() - b.clone()) * (c.clone() - d.clone()) - (e.clone() - b) * (f.clone() - d);
        [cross.clone() * (a - c), (e - f) * cross]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn what_is_told_is_right(numbers in prop::array::uniform6(number())) {
            let ([a, b], [c, d]) = (terms(numbers.map(Wide::from)), terms(numbers.map(exact)));
            let square = |x: &Wide, y: Wide| (*x * y, y * *x);
            prop_assert!([None, Some(c.cmp(&d))].contains(&a.compare(b)));
            prop_assert!([None, Some(Ordering::Equal)].contains(&square(&a, b).0.compare(square(&a, b).1)));
        }

        #[test]
        fn few_bits_are_exact(numbers in prop::array::uniform6(-1000i32..1000), exponent in -200i32..200) {
            let scaled = numbers.map(|n| f64::from(n) * 2f64.powi(exponent));
            let ([a, b], [c, d]) = (terms(scaled.map(Wide::from)), terms(scaled.map(exact)));
            prop_assert_eq!(a.compare(b), Some(c.cmp(&d)));
        }

        #[test]
        fn what_is_far_apart_is_told(numbers in prop::array::uniform6(1.0..2.0f64)) {
            let [a, b] = terms(numbers.map(Wide::from));
            let [c, d] = terms(numbers.map(exact));
            prop_assert_eq!(a.compare(b), Some(c.cmp(&d)));
        }
    }
}
