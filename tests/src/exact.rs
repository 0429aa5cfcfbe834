//! Doubles as exact integers on one common power-of-two grid, and exact ratios rounded back to doubles.
use glam::DVec2;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// An integer in which the oracle's arithmetic is exact: `i128` on small lattices, `BigInt` everywhere else.
pub trait Exact: Clone + Ord + Signed + From<i64> + Into<BigInt> {}

impl Exact for i128 {}
impl Exact for BigInt {}

/// Widest grid coordinate, in bits, for which every determinant of the oracle fits an `i128`.
///
/// The largest is a midpoint's orientation, of degree 6 in the coordinates with fewer than 20 factors of two.
const SMALL_BITS: i64 = 16;

/// The grid 2^`exponent` on which a set of doubles lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Power of two of one grid step.
    pub exponent: i64,
    /// Bits of the largest coordinate, counted in grid steps.
    pub bits: i64,
}

impl Grid {
    /// The coarsest grid that holds every coordinate of `points`.
    pub fn of<'p>(points: impl IntoIterator<Item = &'p DVec2>) -> Grid {
        let (mut lowest, mut highest) = (i64::MAX, i64::MIN);
        for value in points.into_iter().flat_map(|p| [p.x, p.y]) {
            let (mantissa, exponent) = mantissa_and_exponent(value);
            if mantissa != 0 {
                lowest = lowest.min(exponent);
                highest = highest.max(exponent + i64::from(64 - mantissa.abs().leading_zeros()));
            }
        }
        if highest < lowest {
            Grid { exponent: 0, bits: 0 }
        } else {
            Grid { exponent: lowest, bits: highest - lowest }
        }
    }

    /// True when `i128` is wide enough for every determinant of the oracle.
    pub fn is_small(&self) -> bool {
        self.bits <= SMALL_BITS
    }

    /// `value` counted in grid steps: exact for every double that [`Grid::of`] saw.
    pub fn steps(&self, value: f64) -> BigInt {
        let (mantissa, exponent) = mantissa_and_exponent(value);
        if mantissa == 0 { BigInt::zero() } else { BigInt::from(mantissa) << (exponent - self.exponent) }
    }

    /// As [`Grid::steps`], for a small grid.
    pub fn small_steps(&self, value: f64) -> i128 {
        self.steps(value).to_i128().expect("a small grid's coordinates fit")
    }

    /// `steps` grid steps squared as an area.
    pub fn area(&self, steps: BigRational) -> BigRational {
        steps * power_of_two(2 * self.exponent)
    }
}

/// The odd mantissa (or 0) and exponent of a finite double: `value = mantissa * 2^exponent`.
pub fn mantissa_and_exponent(value: f64) -> (i64, i64) {
    assert!(value.is_finite(), "the oracle takes finite numbers, not {value}");
    let bits = value.to_bits();
    let raw = i64::try_from((bits >> 52) & 0x7ff).expect("eleven bits");
    let fraction = i64::try_from(bits & ((1 << 52) - 1)).expect("fifty-two bits");
    let magnitude = if raw == 0 { fraction } else { fraction | (1 << 52) };
    if magnitude == 0 {
        return (0, 0);
    }
    let shift = magnitude.trailing_zeros();
    let mantissa = magnitude >> shift;
    (if value < 0.0 { -mantissa } else { mantissa }, raw.max(1) - 1075 + i64::from(shift))
}

/// A double as an exact ratio.
pub fn ratio(value: f64) -> BigRational {
    let (mantissa, exponent) = mantissa_and_exponent(value);
    BigRational::from_integer(BigInt::from(mantissa)) * power_of_two(exponent)
}

/// 2^`exponent` as an exact ratio.
pub fn power_of_two(exponent: i64) -> BigRational {
    let power = BigInt::one() << exponent.unsigned_abs();
    if exponent >= 0 { BigRational::from_integer(power) } else { BigRational::new_raw(BigInt::one(), power) }
}

/// The double nearest to an exact ratio, ties to even, subnormals included; infinite beyond the range.
pub fn nearest(value: &BigRational) -> f64 {
    nearest_quotient(value.numer(), value.denom(), 0)
}

/// The double nearest to `numerator / denominator * 2^exponent`, for a positive denominator.
pub fn nearest_quotient(numerator: &BigInt, denominator: &BigInt, exponent: i64) -> f64 {
    if numerator.is_zero() {
        return 0.0;
    }
    let (top, bottom) = (numerator.abs(), denominator);
    let unit = (floor_log2(&top, bottom) + exponent - 52).max(-1074);
    let shift = exponent - unit;
    let (top, bottom) =
        if shift >= 0 { (top << shift, bottom.clone()) } else { (top, bottom.clone() << -shift) };
    let mut steps = &top / &bottom;
    let twice_rest = (&top - &steps * &bottom) * 2;
    if twice_rest > bottom || (twice_rest == bottom && steps.bit(0)) {
        steps += 1;
    }
    let magnitude = assemble(steps.to_u64().expect("at most 2^53 units"), unit);
    if numerator.is_negative() { -magnitude } else { magnitude }
}

/// The largest `k` with `2^k <= top / bottom`, both positive.
fn floor_log2(top: &BigInt, bottom: &BigInt) -> i64 {
    let guess =
        i64::try_from(top.bits()).expect("bit length") - i64::try_from(bottom.bits()).expect("bit length");
    let reached = if guess >= 0 { top >= &(bottom << guess) } else { &(top << -guess) >= bottom };
    if reached { guess } else { guess - 1 }
}

/// `units * 2^exponent` as a double, for `units <= 2^53` in which it is exact.
fn assemble(units: u64, exponent: i64) -> f64 {
    let (units, exponent) = if units == 1 << 53 { (1 << 52, exponent + 1) } else { (units, exponent) };
    if units < 1 << 52 {
        return f64::from_bits(units); // only subnormals have fewer than 53 bits, in units of 2^-1074
    }
    match u64::try_from(exponent + 1075) {
        Ok(raw) if raw < 0x7ff => f64::from_bits((raw << 52) | (units - (1 << 52))),
        _ => f64::INFINITY,
    }
}

/// Twice the signed area of closed rings, exactly.
pub fn twice_signed_area<'r>(rings: impl IntoIterator<Item = &'r [DVec2]>) -> BigRational {
    let rings: Vec<&[DVec2]> = rings.into_iter().collect();
    let grid = Grid::of(rings.iter().copied().flatten());
    let mut sum = BigInt::zero();
    for ring in rings {
        for (p, q) in edges(ring) {
            sum += grid.steps(p.x) * grid.steps(q.y) - grid.steps(p.y) * grid.steps(q.x);
        }
    }
    grid.area(BigRational::from_integer(sum))
}

/// The edges of a ring, the closing one last.
pub fn edges(ring: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn every_double_survives_the_way_through_a_ratio() {
        let mut random = Random::new(1);
        for _ in 0..20_000 {
            let value = f64::from_bits(random.bits());
            if value.is_finite() {
                assert_eq!(nearest(&ratio(value)), value);
            }
        }
        for value in [5e-324, f64::MIN_POSITIVE, f64::MAX, -f64::MAX, 1.0, -0.1] {
            assert_eq!(nearest(&ratio(value)), value);
        }
    }

    #[test]
    fn quotients_round_as_the_processor_divides() {
        let mut random = Random::new(2);
        for _ in 0..20_000 {
            let (a, b) = (f64::from_bits(random.bits()), f64::from_bits(random.bits()));
            let quotient = a / b;
            if a.is_finite() && b.is_finite() && b != 0.0 && quotient != 0.0 {
                assert_eq!(nearest(&(ratio(a) / ratio(b))), quotient, "{a} / {b}");
            }
        }
    }

    #[test]
    fn a_ring_of_known_area() {
        let square = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]].map(DVec2::from);
        assert_eq!(nearest(&twice_signed_area([&square[..]])), 0.5);
    }
}
