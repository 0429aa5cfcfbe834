//! Rational numbers on a scale of their own.

use crate::integers::scaled_integers;
use dashu_int::{IBig, Sign, UBig, ops::BitTest};
use std::cmp::Ordering;

/// The rational number `numerator / denominator · 2^exponent` with a positive denominator; not reduced.
///
/// ```
/// use exactfloat::{Integer, Ratio};
/// let third = Ratio::new(Integer::from(1), Integer::from(3), 0);
/// assert_eq!(third.to_f64(), 1.0 / 3.0);
/// assert!(third.compare(&Ratio::from_f64(1.0 / 3.0)).is_gt()); // the double lies below
/// ```
#[derive(Clone, Debug)]
#[must_use]
pub struct Ratio {
    numerator: IBig,
    denominator: UBig,
    exponent: i32,
}

impl Ratio {
    /// `numerator / denominator · 2^exponent`; the denominator is not zero.
    pub fn new(numerator: IBig, denominator: IBig, exponent: i32) -> Ratio {
        let (sign, denominator) = denominator.into_parts();
        Ratio {
            numerator: if sign == Sign::Negative { -numerator } else { numerator },
            denominator,
            exponent,
        }
    }

    /// The number that a finite `f64` stands for.
    pub fn from_f64(x: f64) -> Ratio {
        let ([[numerator]], exponent) = scaled_integers([[x]]);
        Ratio { numerator, denominator: UBig::ONE, exponent }
    }

    /// The ordinate at the abscissa `self` of the line through two points of different abscissae.
    pub fn ordinate_on(&self, line: [[f64; 2]; 2]) -> Ratio {
        let ([[ax, ay], [bx, by]], s) = scaled_integers(line);
        let (dx, dy) = (bx - &ax, by - &ay);
        // All on the scale 2^t that is fine enough for the line and for this abscissa.
        let t = s.min(self.exponent);
        let up = |v: IBig, from: i32| v << (from - t).unsigned_abs() as usize;
        let d = IBig::from(self.denominator.clone());
        let run = up(self.numerator.clone(), self.exponent) - up(ax, s) * &d;
        Ratio::new(up(ay, s) * &d * &dx + run * dy, d * dx, t)
    }

    /// The order of two numbers.
    #[must_use]
    pub fn compare(&self, other: &Ratio) -> Ordering {
        let t = self.exponent.min(other.exponent);
        let up = |r: &Ratio| r.numerator.clone() << (r.exponent - t).unsigned_abs() as usize;
        let (l, r) = (
            up(self) * IBig::from(other.denominator.clone()),
            up(other) * IBig::from(self.denominator.clone()),
        );
        l.cmp(&r)
    }

    /// The nearest `f64`, ties to even; 0.0 for what rounds to zero. The number must not lie beyond the largest finite one.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        let (sign, numerator) = self.numerator.clone().into_parts();
        if numerator.is_zero() {
            return 0.0;
        }
        // A quotient of at least 65 bits, its last bit sticky.
        let missing = 66 + self.denominator.bit_len() as i64 - numerator.bit_len() as i64;
        let shift = usize::try_from(missing).unwrap_or(0);
        let shifted = numerator << shift;
        let quotient = &shifted / &self.denominator;
        let inexact = &quotient * &self.denominator != shifted;
        let magnitude = round_binary(quotient, inexact, i64::from(self.exponent) - shift as i64);
        // + 0.0: a negative number that rounds to zero is 0.0.
        if sign == Sign::Negative { -magnitude + 0.0 } else { magnitude }
    }
}

/// The `f64` nearest to `integer · 2^exponent`, ties to even; infinite beyond the range.
///
/// ```
/// use exactfloat::{Integer, nearest};
/// assert_eq!(nearest(Integer::from(3), -1), 1.5);
/// assert_eq!(nearest(Integer::from(-1), 1024), f64::NEG_INFINITY);
/// ```
#[must_use]
pub fn nearest(integer: IBig, exponent: i32) -> f64 {
    if i64::from(exponent) + integer.bit_len() as i64 > 1024 {
        return if integer.sign() == Sign::Positive { f64::INFINITY } else { f64::NEG_INFINITY };
    }
    Ratio::new(integer, IBig::ONE, exponent).to_f64()
}

/// `quotient · 2^exponent`, a little more when `inexact`, to the nearest `f64`, ties to even.
fn round_binary(quotient: UBig, inexact: bool, exponent: i64) -> f64 {
    let top = exponent + quotient.bit_len() as i64 - 1;
    let lowest = (top - 52).max(-1074);
    let Ok(drop) = usize::try_from(lowest - exponent) else {
        return f64::INFINITY; // unreachable: a quotient has more than 65 bits
    };
    let kept = &quotient >> drop;
    let rest = quotient - (&kept << drop);
    let half = UBig::ONE << drop.saturating_sub(1);
    let mut mantissa = u64::try_from(kept).unwrap_or(u64::MAX);
    let up = match rest.cmp(&half) {
        Ordering::Less => false,
        Ordering::Equal => inexact || mantissa & 1 == 1,
        Ordering::Greater => true,
    };
    mantissa += u64::from(up);
    binary(mantissa, lowest)
}

/// `mantissa · 2^exponent` where that is exact: `mantissa <= 2^53`, `exponent >= -1074`.
fn binary(mantissa: u64, exponent: i64) -> f64 {
    let power = |e: i64| f64::from_bits(((e + 1023).unsigned_abs()) << 52);
    #[expect(clippy::cast_precision_loss, reason = "a mantissa of at most 53 bits is exact")]
    let m = mantissa as f64;
    // Two factors: 2^-1074 is subnormal, and a partial product is exact because the final one is.
    if exponent < -1022 { m * power(-1022) * power(exponent + 1022) } else { m * power(exponent) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use num_traits::{Signed, ToPrimitive};
    use proptest::prelude::*;

    fn exact(x: f64) -> BigRational {
        BigRational::from_float(x).expect("finite")
    }

    proptest! {
        #[test]
        fn ratios_round_to_nearest_even(n in any::<i64>(), d in 1i64.., s in -1100i32..900) {
            let ratio = Ratio::new(n.into(), d.into(), s);
            let value = BigRational::new(n.into(), d.into()) * BigRational::from_integer(2.into()).pow(s);
            let rounded = ratio.to_f64();
            let off = |v: f64| (exact(v) - &value).abs();
            for neighbour in [rounded.next_up(), rounded.next_down()] {
                match off(rounded).cmp(&off(neighbour)) {
                    Ordering::Less => {}
                    Ordering::Equal => prop_assert_eq!(rounded.to_bits() & 1, 0),
                    Ordering::Greater => prop_assert!(false, "{rounded} is not nearest to {:?}", value.to_f64()),
                }
            }
        }

        #[test]
        fn ordinates_and_orders_are_those_of_rationals(line in prop::array::uniform2(prop::array::uniform2(-1e3..1e3f64)), x in -1e3..1e3f64, y in -1e3..1e3f64) {
            let [[ax, ay], [bx, by]] = line.map(|point| point.map(exact));
            prop_assume!(ax != bx);
            let ordinate = &ay + (exact(x) - &ax) / (bx - &ax) * (by - &ay);
            let found = Ratio::from_f64(x).ordinate_on(line);
            prop_assert_eq!(found.compare(&Ratio::from_f64(y)), ordinate.cmp(&exact(y)));
        }
    }
}
