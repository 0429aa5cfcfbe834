//! Exact integers of fixed size, for coordinates that are multiples of one power of two below 2^61 of it: decimal
//! fractions, lattices, and whatever lies within a factor of 2^8 of one another.
//!
//! No allocation: where the filters cannot tell, as in bundles of edges through nearly one point, this is a good ten
//! times as fast as integers of any size.

use super::exact::decode;
use super::{Segment, Side};
use dashu_int::Sign;
use glam::DVec2;
use std::cmp::Ordering;

/// Coordinates have less bits, so that their differences have 62, areas 125, and products of areas fit in 256.
const BITS: u32 = 61;

type Point = [i64; 2];

/// Points as multiples of one power of two, if they are small ones.
fn scaled<const N: usize>(points: [DVec2; N]) -> Option<[Point; N]> {
    let exponent = |x: f64| decode(x).2.unwrap_or(i32::MAX);
    let lowest = points.iter().fold(i32::MAX, |least, p| least.min(exponent(p.x)).min(exponent(p.y)));
    let mut all_fit = true;
    let mut multiple = |x: f64| {
        let (sign, mantissa, exponent) = decode(x);
        let shift = exponent.map_or(0, |e| (i64::from(e) - i64::from(lowest)).unsigned_abs());
        all_fit &= shift + u64::from(u64::BITS - mantissa.leading_zeros()) <= u64::from(BITS);
        let magnitude = i64::try_from(mantissa << (shift % 64)).unwrap_or(0);
        if sign == Sign::Negative { -magnitude } else { magnitude }
    };
    let points = points.map(|p| [multiple(p.x), multiple(p.y)]);
    all_fit.then_some(points)
}

/// The cross product of `b - a` and `d - c`.
fn cross(a: Point, b: Point, c: Point, d: Point) -> i128 {
    let run = |from: Point, to: Point| [to[0] - from[0], to[1] - from[1]].map(i128::from);
    let ([ux, uy], [vx, vy]) = (run(a, b), run(c, d));
    ux * vy - uy * vx
}

/// The product of two numbers below 2^127 in full: its high and its low half.
fn full_product(a: u128, b: u128) -> [u128; 2] {
    let halves = |x: u128| [x >> 64, x & u128::from(u64::MAX)];
    let ([a1, a0], [b1, b0]) = (halves(a), halves(b));
    let middle = a1 * b0 + a0 * b1;
    let (low, carry) = (a0 * b0).overflowing_add(middle << 64);
    [a1 * b1 + (middle >> 64) + u128::from(carry), low]
}

/// The order of `a b` and `c d`.
fn compare_products([a, b]: [i128; 2], [c, d]: [i128; 2]) -> Ordering {
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

/// As [`turn`](super::turn).
pub(super) fn turn(e: Segment, g: Segment) -> Option<Side> {
    let [a, b, c, d] = scaled([e[0], e[1], g[0], g[1]])?;
    Some(Side::from(cross(a, b, c, d).cmp(&0)))
}

/// As [`crossing_order`](super::crossing_order).
pub(super) fn crossing_order(e: Segment, f: Segment, g: Segment) -> Option<Ordering> {
    let [a, b, f0, f1, g0, g1] = scaled([e[0], e[1], f[0], f[1], g[0], g[1]])?;
    let distances = |[p, q]: [Point; 2]| [a, b].map(|end| cross(end, p, end, q).abs());
    let ([nf, mf], [ng, mg]) = (distances([f0, f1]), distances([g0, g1]));
    Some(compare_products([nf, mg], [ng, mf]))
}

/// The order at the abscissa `x` of two rightward edges that span it, neither vertical.
pub(super) fn height_order(e: Segment, f: Segment, x: f64) -> Option<Ordering> {
    let [e0, e1, f0, f1, at] = scaled([e[0], e[1], f[0], f[1], DVec2::new(x, e[0].y)])?;
    // Over the start of e, a height is a cross product over the edge's width.
    let height = |[p, q]: [Point; 2]| [cross(p, [at[0], e0[1]], p, q), i128::from(q[0] - p[0])];
    let ([h, w], [k, v]) = (height([e0, e1]), height([f0, f1]));
    Some(compare_products([h, v], [k, w]))
}

/// Whether the crossing of `e` and `f` lies left of, on or right of the abscissa `x`.
pub(super) fn crossing_x_order(e: Segment, f: Segment, x: f64) -> Option<Ordering> {
    let [a, b, f0, f1, at] = scaled([e[0], e[1], f[0], f[1], DVec2::new(x, e[0].y)])?;
    let (n, m) = (cross(a, f0, a, f1), cross(b, f0, b, f1));
    // The crossing is at a + (b - a) n / (n - m), and n has the sign of n - m.
    let (n, w) = (n.abs(), (n - m).abs());
    Some(compare_products([i128::from(b[0] - a[0]), n], [i128::from(at[0] - a[0]), w]))
}
