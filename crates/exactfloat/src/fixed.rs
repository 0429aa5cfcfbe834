//! Integers of fixed size, for numbers that are multiples of one power of two below 2^61 of it: decimal fractions,
//! lattices, and whatever lies within a factor of 2^8 of one another.
//!
//! Nothing is allocated: where a filter cannot tell, as in bundles of edges through nearly one point, this is a good ten
//! times as fast as integers of any size.
//!
//! ```
//! use exactfloat::fixed;
//! assert_eq!(fixed::scaled([[0.5, 3.0], [-0.25, 0.0]]), Some([[2, 12], [-1, 0]]));
//! assert_eq!(fixed::scaled([[1e-300, 1.0]]), None); // no common scale
//! assert!(fixed::compare_products([1 << 100, 3], [1 << 101, 2]).is_lt());
//! ```

use crate::integers::decode;
use dashu_int::Sign;
use std::cmp::Ordering;

/// Scaled numbers have fewer bits, so that their differences have 62, determinants of degree 2 have 125, and products of two of
/// these fit in 256.
pub const BITS: u32 = 61;

/// The coordinates of some points as integers: all multiplied by one power of two. None where one would have more than
/// [`BITS`] bits.
#[inline]
#[must_use]
pub fn scaled<const D: usize, const N: usize>(points: [[f64; D]; N]) -> Option<[[i64; D]; N]> {
    let exponent = |x: f64| decode(x).2.unwrap_or(i32::MAX);
    let mut lowest = i32::MAX;
    for point in points {
        for x in point {
            lowest = lowest.min(exponent(x));
        }
    }
    let mut all_fit = true;
    let mut multiple = |x: f64| {
        let (sign, mantissa, exponent) = decode(x);
        let shift = exponent.map_or(0, |e| (i64::from(e) - i64::from(lowest)).unsigned_abs());
        all_fit &= shift + u64::from(u64::BITS - mantissa.leading_zeros()) <= u64::from(BITS);
        let magnitude = i64::try_from(mantissa << (shift % 64)).unwrap_or(0);
        if sign == Sign::Negative { -magnitude } else { magnitude }
    };
    let points = points.map(|point| point.map(&mut multiple));
    all_fit.then_some(points)
}

/// The product of two numbers below 2^127 in full: its high and its low half.
#[inline]
pub(crate) fn full_product(a: u128, b: u128) -> [u128; 2] {
    let halves = |x: u128| [x >> 64, x & u128::from(u64::MAX)];
    let ([a1, a0], [b1, b0]) = (halves(a), halves(b));
    let middle = a1 * b0 + a0 * b1;
    let (low, carry) = (a0 * b0).overflowing_add(middle << 64);
    [a1 * b1 + (middle >> 64) + u128::from(carry), low]
}

/// The order of `a b` and `c d`, of numbers below 2^127 in magnitude.
#[inline]
#[must_use]
pub fn compare_products([a, b]: [i128; 2], [c, d]: [i128; 2]) -> Ordering {
    let (left, right) = (a.signum() * b.signum(), c.signum() * d.signum());
    let sizes = || {
        let size = |x: i128, y: i128| full_product(x.unsigned_abs(), y.unsigned_abs());
        size(a, b).cmp(&size(c, d))
    };
    left.cmp(&right).then_with(|| match left {
        0 => Ordering::Equal,
        1 => sizes(),
        _ => sizes().reverse(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::BigInt;
    use proptest::prelude::*;

    fn factor() -> impl Strategy<Value = i128> {
        (any::<i128>(), 1u32..128).prop_map(|(x, shift)| x >> shift)
    }

    proptest! {
        #[test]
        fn products_compare_as_big_integers_do(a in factor(), b in factor(), c in factor(), d in factor()) {
            let product = |x: i128, y: i128| BigInt::from(x) * BigInt::from(y);
            prop_assert_eq!(compare_products([a, b], [c, d]), product(a, b).cmp(&product(c, d)));
            prop_assert_eq!(compare_products([a, b], [b, a]), Ordering::Equal);
        }

        #[test]
        fn scaled_numbers_keep_their_ratios(numbers in prop::array::uniform3(-1000i32..1000), exponent in -1000i32..1000) {
            let power = 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
            let [scaled] = scaled([numbers.map(|n| f64::from(n) * power)]).expect("few bits");
            let product = |i: usize, j: usize| i128::from(numbers[i]) * i128::from(scaled[j]);
            prop_assert!((0..3).all(|i| (0..3).all(|j| product(i, j) == product(j, i))));
        }
    }
}
