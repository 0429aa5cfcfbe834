//! Doubles as integers of any size: all of a question's numbers multiplied by one power of two.

use dashu_int::{IBig, Sign, UBig};
use std::cmp::Ordering;

/// Sign, odd mantissa and exponent of a finite `f64`: `x = ± mantissa · 2^exponent`; zero has no exponent.
#[inline]
pub(crate) fn decode(x: f64) -> (Sign, u64, Option<i32>) {
    let bits = x.to_bits();
    let sign = if bits >> 63 == 0 { Sign::Positive } else { Sign::Negative };
    let biased = i32::from((bits >> 52) as u16 & 0x7ff);
    let fraction = bits & ((1 << 52) - 1);
    let (mantissa, exponent) =
        if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
    if mantissa == 0 {
        return (sign, 0, None);
    }
    let zeros = mantissa.trailing_zeros();
    (sign, mantissa >> zeros, Some(exponent + zeros as i32))
}

/// The exponent of the lowest set bit of any of some finite numbers; none where all are 0.
#[must_use]
pub fn lowest_exponent(numbers: impl IntoIterator<Item = f64>) -> Option<i32> {
    numbers.into_iter().filter_map(|x| decode(x).2).min()
}

/// The coordinates of some points as integers: all multiplied by one power of two.
///
/// ```
/// use exactfloat::{integers, sign};
/// let [[a, b, c]] = integers([[0.1, 0.2, 0.3]]);
/// assert!(sign(&(a + b - c)).is_gt()); // of the three doubles as they are; 0.1 + 0.2 is rounded, this is not
/// ```
#[must_use]
pub fn integers<const D: usize, const N: usize>(points: [[f64; D]; N]) -> [[IBig; D]; N] {
    scaled_integers(points).0
}

/// The coordinates as integers, and the exponent `s` such that `coordinate = integer · 2^s`.
#[must_use]
pub fn scaled_integers<const D: usize, const N: usize>(points: [[f64; D]; N]) -> ([[IBig; D]; N], i32) {
    let lowest = lowest_exponent(points.into_iter().flatten()).unwrap_or(0);
    (points.map(|point| point.map(|x| multiple(x, lowest))), lowest)
}

/// A finite number as a multiple of `2^lowest`, a power of two that is not above its lowest set bit.
#[must_use]
pub fn multiple(x: f64, lowest: i32) -> IBig {
    let (sign, mantissa, exponent) = decode(x);
    let shift = exponent.map_or(0, |e| (e - lowest).unsigned_abs() as usize);
    IBig::from_parts(sign, UBig::from(mantissa)) << shift
}

/// How an integer compares with 0.
#[must_use]
pub fn sign(integer: &IBig) -> Ordering {
    match (integer.is_zero(), integer.sign()) {
        (true, _) => Ordering::Equal,
        (false, Sign::Positive) => Ordering::Greater,
        (false, Sign::Negative) => Ordering::Less,
    }
}
