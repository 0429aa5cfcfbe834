//! Exact integers and ratios: the last resort of every predicate.

use dashu_int::{IBig, Sign, UBig, ops::BitTest};
use std::cmp::Ordering;

/// Sign, odd mantissa and exponent of a finite `f64`: `x = ± mantissa · 2^exponent`; zero has no exponent.
pub(super) fn decode(x: f64) -> (Sign, u64, Option<i32>) {
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

/// The exponent of the lowest set bit of any of the coordinates.
fn lowest_exponent(coordinates: &[f64]) -> i32 {
    coordinates.iter().filter_map(|&x| decode(x).2).min().unwrap_or(0)
}

/// The coordinates as integers: all multiplied by one power of two.
pub(super) fn integers<const N: usize>(coordinates: [f64; N]) -> [IBig; N] {
    scaled_integers(coordinates).0
}

/// The coordinates as integers, and the exponent `s` such that `coordinate = integer · 2^s`.
pub(super) fn scaled_integers<const N: usize>(coordinates: [f64; N]) -> ([IBig; N], i32) {
    let lowest = lowest_exponent(&coordinates);
    (coordinates.map(|x| multiple(x, lowest)), lowest)
}

/// A number as a multiple of a power of two that is not above its lowest set bit.
fn multiple(x: f64, lowest: i32) -> IBig {
    let (sign, mantissa, exponent) = decode(x);
    let shift = exponent.map_or(0, |e| (e - lowest).unsigned_abs() as usize);
    IBig::from_parts(sign, UBig::from(mantissa)) << shift
}

/// The area that closed walks of directed edges enclose, correctly rounded; infinite beyond the range.
#[cold]
pub(crate) fn exact_area(edges: impl Iterator<Item = super::Segment> + Clone) -> f64 {
    let exponents = edges.clone().flatten().map(|p| lowest_exponent(&[p.x, p.y]));
    let lowest = exponents.min().unwrap_or(0);
    let cross = |[a, b]: super::Segment| {
        let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(|x| multiple(x, lowest));
        ax * by - ay * bx
    };
    let doubled = edges.map(cross).fold(IBig::ZERO, |sum, term| sum + term);
    let exponent = 2 * lowest - 1;
    if i64::from(exponent) + doubled.bit_len() as i64 > 1024 {
        return if doubled.sign() == Sign::Positive { f64::INFINITY } else { f64::NEG_INFINITY };
    }
    Ratio::new(doubled, IBig::ONE, exponent).to_f64()
}

/// The rational number `numerator / denominator · 2^exponent` with a positive denominator.
#[derive(Clone, Debug)]
pub(crate) struct Ratio {
    numerator: IBig,
    denominator: UBig,
    exponent: i32,
}

impl Ratio {
    /// `numerator / denominator · 2^exponent`; the denominator is not zero.
    pub(super) fn new(numerator: IBig, denominator: IBig, exponent: i32) -> Ratio {
        let (sign, denominator) = denominator.into_parts();
        Ratio {
            numerator: if sign == Sign::Negative { -numerator } else { numerator },
            denominator,
            exponent,
        }
    }

    /// The number that a finite `f64` stands for.
    pub(crate) fn from_f64(x: f64) -> Ratio {
        let ([numerator], exponent) = scaled_integers([x]);
        Ratio { numerator, denominator: UBig::ONE, exponent }
    }

    /// `self + factor · (to - from)` on one line: the ordinate at the abscissa `self` of the line through two points.
    pub(crate) fn ordinate_on(&self, line: super::Segment) -> Ratio {
        let ([ax, ay, bx, by], s) = scaled_integers([line[0].x, line[0].y, line[1].x, line[1].y]);
        let (dx, dy) = (bx - &ax, by - &ay);
        // All on the scale 2^t that is fine enough for the line and for this abscissa.
        let t = s.min(self.exponent);
        let up = |v: IBig, from: i32| v << (from - t).unsigned_abs() as usize;
        let d = IBig::from(self.denominator.clone());
        let run = up(self.numerator.clone(), self.exponent) - up(ax, s) * &d;
        Ratio::new(up(ay, s) * &d * &dx + run * dy, d * dx, t)
    }

    pub(crate) fn compare(&self, other: &Ratio) -> Ordering {
        let t = self.exponent.min(other.exponent);
        let up = |r: &Ratio| r.numerator.clone() << (r.exponent - t).unsigned_abs() as usize;
        let (l, r) = (
            up(self) * IBig::from(other.denominator.clone()),
            up(other) * IBig::from(self.denominator.clone()),
        );
        l.cmp(&r)
    }

    /// The nearest `f64`, ties to even. The number must not lie beyond the largest finite one.
    pub(crate) fn to_f64(&self) -> f64 {
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
