//! The crossing of two edges, each coordinate rounded once to the nearest double.

use super::segment::Segment;
use exactfloat::{DoubleDouble, Ratio, scaled_integers};
use glam::DVec2;

/// The crossing of two edges that cross properly, both coordinates correctly rounded (ties to even).
///
/// Depends on the two edges as point sets only, not on their order or direction.
pub(crate) fn crossing_point(e: Segment, f: Segment) -> DVec2 {
    crossing_by_residuals(e, f).unwrap_or_else(|| {
        let [x, y] = crossing_ratio(e, f);
        DVec2::new(x.to_f64(), y.to_f64())
    })
}

/// The exact crossing of two edges that cross properly.
#[cold]
pub(crate) fn crossing_ratio(e: Segment, f: Segment) -> [Ratio; 2] {
    let ([[ax, ay], [bx, by], [cx, cy], [dx, dy]], scale) =
        scaled_integers([e[0], e[1], f[0], f[1]].map(|p| p.to_array()));
    let n = (&cx - &ax) * (&dy - &ay) - (&cy - &ay) * (&dx - &ax);
    let m = (&cx - &bx) * (&dy - &by) - (&cy - &by) * (&dx - &bx);
    let w = &n - m;
    [
        Ratio::new(&ax * &w + (bx - &ax) * &n, w.clone(), scale),
        Ratio::new(&ay * &w + (by - &ay) * &n, w, scale),
    ]
}

/// 2^-98: more than the relative error of any of the few operations in a row in [`area`].
const RELATIVE: f64 = f64::from_bits((1023 - 98) << 52);

/// 2^-46: more than the relative errors of the few operations in doubles below, together.
const COARSE: f64 = f64::from_bits((1023 - 46) << 52);

/// Where no operation below overflows and no low part is lost: coordinates are 0 or in 2^-200 … 2^200.
#[inline]
fn in_window(p: DVec2) -> bool {
    const LOW: u64 = (1023 - 200) << 53;
    const HIGH: u64 = (1023 + 200) << 53;
    // Without the sign, numbers have the order of their bits.
    let fits = |x: f64| {
        let bits = x.to_bits() << 1;
        bits == 0 || bits.wrapping_sub(LOW) <= HIGH - LOW
    };
    fits(p.x) && fits(p.y)
}

/// The doubled area of (f, p), and the sum of the two products' sizes: wrong by that times [`RELATIVE`] at most, and by two
/// ulps of its own.
#[inline]
fn area(f: Segment, p: DVec2) -> (f64, f64) {
    let (ux, uy) = (DoubleDouble::difference(f[0].x, p.x), DoubleDouble::difference(f[0].y, p.y));
    let (vx, vy) = (DoubleDouble::difference(f[1].x, p.x), DoubleDouble::difference(f[1].y, p.y));
    let (l, r) = (DoubleDouble::product(ux.hi, vy.hi), DoubleDouble::product(uy.hi, vx.hi));
    let tails = (ux.hi * vy.lo + ux.lo * vy.hi) - (uy.hi * vx.lo + uy.lo * vx.hi);
    ((l.hi - r.hi) + ((l.lo - r.lo) + tails), l.hi.abs() + r.hi.abs())
}

/// The most steps towards a crossing.
const STEPS: usize = 3;

/// Whether a sum of two doubles rounds to the first of them, whatever the rest is up to an error.
#[inline]
fn is_proven(sum: DoubleDouble, error: f64) -> bool {
    sum.hi + (sum.lo + error) == sum.hi && sum.hi + (sum.lo - error) == sum.hi
}

/// The rounded crossing, when doubles prove both roundings.
///
/// A point p near the crossing misses it by δ = (A_f u - A_e v) / (u × v), where u and v are the edges' vectors and A_e, A_f the
/// doubled areas of the edges and p: exactly, as the edges are straight. The areas are small and their few bits are right,
/// so p + δ is known to far more bits than a double has, and where it is not, the next p is nearer.
pub(super) fn crossing_by_residuals(e: Segment, f: Segment) -> Option<DVec2> {
    // On an axis-parallel edge one coordinate needs no arithmetic.
    match [axis_parallel(e), axis_parallel(f)] {
        [None, None] => {}
        [Some(axis), None] => return on_axis_parallel(axis, e, f),
        [None, Some(axis)] => return on_axis_parallel(axis, f, e),
        [Some(0), Some(_)] => return Some(DVec2::new(e[0].x, f[0].y)),
        [Some(_), Some(_)] => return Some(DVec2::new(f[0].x, e[0].y)),
    }
    let (u, v) = (e[1] - e[0], f[1] - f[0]);
    let det = u.perp_dot(v);
    let loss = ((u.x * v.y).abs() + (u.y * v.x).abs()) / det.abs();
    let is_moderate = [e, f].iter().all(|s| in_window(s[0]) && in_window(s[1])) && loss * COARSE < 0.25;
    let mut p = e[0] + u * ((f[0] - e[0]).perp_dot(v) / det);
    for _ in 0..if is_moderate { STEPS } else { 0 } {
        if !in_window(p) {
            return None;
        }
        let ((of_e, size_e), (of_f, size_f)) = (area(e, p), area(f, p));
        let coordinate = |at: f64, u: f64, v: f64| {
            let (forth, back) = (of_f * u, of_e * v);
            let error =
                RELATIVE * (size_f * u.abs() + size_e * v.abs()) + COARSE * loss * (forth.abs() + back.abs());
            let at = DoubleDouble::sum(at, (forth - back) / det);
            (at.hi, is_proven(at, 2.0 * (error / det.abs())))
        };
        let ((x, knows_x), (y, knows_y)) = (coordinate(p.x, u.x, v.x), coordinate(p.y, u.y, v.y));
        p = DVec2::new(x, y);
        if knows_x && knows_y {
            return Some(p);
        }
    }
    None
}

/// The axis on which both ends of an edge have one coordinate.
#[inline]
fn axis_parallel(s: Segment) -> Option<usize> {
    if s[0].x == s[1].x { Some(0) } else { (s[0].y == s[1].y).then_some(1) }
}

/// The same on an edge whose ends have one coordinate on an axis: there A_e is 0, and δ = -A_f / v on the other axis.
#[inline]
fn on_axis_parallel(axis: usize, e: Segment, f: Segment) -> Option<DVec2> {
    let swap = |p: DVec2| if axis == 0 { p } else { DVec2::new(p.y, p.x) };
    let ([start, _], [a, b]) = (e.map(swap), f.map(swap));
    let v = b - a;
    let mut p = DVec2::new(start.x, a.y + v.y * ((start.x - a.x) / v.x));
    for _ in 0..if in_window(a) && in_window(b) { STEPS } else { 0 } {
        if !in_window(p) {
            return None;
        }
        let (of_f, size) = area([a, b], p);
        let step = of_f / v.x;
        let y = DoubleDouble::sum(p.y, -step);
        p.y = y.hi;
        if is_proven(y, 2.0 * (RELATIVE * (size / v.x.abs()) + COARSE * step.abs())) {
            return Some(swap(p));
        }
    }
    None
}
