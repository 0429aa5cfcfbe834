//! Orders: along an edge, along an abscissa, of abscissae.

use super::distance::{RELATIVE, distance, is_moderate};
use super::fixed;
use super::orient::{UNIT, side, turn};
use super::round::{crossing_by_residuals, crossing_ratio};
use super::segment::{Segment, Side};
use exactfloat::{DoubleDouble, Integer, Ratio, Wide, integers};
use glam::DVec2;
use std::cmp::Ordering;

/// By x, then by y. Both points finite.
#[inline]
pub(crate) fn lexicographic(a: DVec2, b: DVec2) -> Ordering {
    // Not by `partial_cmp`, which also asks whether any is NaN.
    if a.x < b.x || (a.x == b.x && a.y < b.y) {
        Ordering::Less
    } else if a == b {
        Ordering::Equal
    } else {
        Ordering::Greater
    }
}

/// The order along `e` of its crossings with `f` and with `g`; both cross `e` properly.
///
/// With n, m the doubled areas of (f, start of e) and (f, end of e), which have opposite signs, the crossing lies at
/// the parameter |n| / (|n| + |m|), so that the order is the sign of |n_f| |m_g| - |n_g| |m_f|.
///
/// Doubles of 106 bits tell where no exponent is extreme; then integers of fixed size, numbers of 125 bits with any exponent, and
/// integers of any size.
#[cold]
pub(crate) fn crossing_order(e: Segment, f: Segment, g: Segment) -> Ordering {
    let is_moderate = [e, f, g].iter().flatten().all(|&p| is_moderate(p));
    let by_double_doubles = if is_moderate { crossing_order_by_double_doubles(e, f, g) } else { None };
    by_double_doubles
        .or_else(|| fixed::crossing_order(e, f, g))
        .or_else(|| crossing_order_by_bounds(e, f, g))
        .unwrap_or_else(|| crossing_order_by_integers(e, f, g))
}

/// The bounds add up those of the distances with room to spare.
fn crossing_order_by_double_doubles(e: Segment, f: Segment, g: Segment) -> Option<Ordering> {
    let [[nf, mf], [ng, mg]] = [f, g].map(|line| e.map(|end| distance(line, end)));
    let product = |(a, da): (DoubleDouble, f64), (b, db): (DoubleDouble, f64)| {
        (a * b, 2.0 * (a.hi * db + b.hi * da + da * db + RELATIVE * a.hi * b.hi))
    };
    let ((l, dl), (r, dr)) = (product(nf, mg), product(ng, mf));
    let order = (l - r).hi;
    (order.abs() > dl + dr).then(|| order.total_cmp(&0.0))
}

/// The cross product of two vectors.
fn cross([a, b]: [Wide; 2], [c, d]: [Wide; 2]) -> Wide {
    a * d - b * c
}

/// The vector u of an edge from p to q, and c = p × q: seen from the origin no product cancels that another one holds again, for
/// any sizes of coordinates.
fn from_origin(edge: Segment) -> ([Wide; 2], Wide) {
    let [p, q] = edge.map(|p| p.to_array().map(Wide::from));
    ([q[0] - p[0], q[1] - p[1]], cross(p, q))
}

/// The doubled area of (f, a) is c_f + u_f × a, so that
///
/// n_f m_g - n_g m_f = c_f (u_g × u_e) - c_g (u_f × u_e) - (u_g × u_f) c_e
///
/// |n_f| |m_g| - |n_g| |m_f| has the same sign if the start of e lies on different sides of f and g, else the opposite one.
fn crossing_order_by_bounds(e: Segment, f: Segment, g: Segment) -> Option<Ordering> {
    let [(ue, ce), (uf, cf), (ug, cg)] = [e, f, g].map(from_origin);
    let order = (cf * cross(ug, ue) - cg * cross(uf, ue)).compare(cross(ug, uf) * ce)?;
    let is_same_side = side(f[0], f[1], e[0]) == side(g[0], g[1], e[0]);
    Some(if is_same_side { order.reverse() } else { order })
}

#[cold]
fn crossing_order_by_integers(e: Segment, f: Segment, g: Segment) -> Ordering {
    let [[ax, ay], [bx, by], [fax, fay], [fbx, fby], [gax, gay], [gbx, gby]] =
        integers([e[0], e[1], f[0], f[1], g[0], g[1]].map(|p| p.to_array()));
    let distance = |x: &Integer, y: &Integer, p: [&Integer; 4]| {
        Integer::from(((p[0] - x) * (p[3] - y) - (p[1] - y) * (p[2] - x)).into_parts().1)
    };
    let (f, g) = ([&fax, &fay, &fbx, &fby], [&gax, &gay, &gbx, &gby]);
    let (nf, mf) = (distance(&ax, &ay, f), distance(&bx, &by, f));
    let (ng, mg) = (distance(&ax, &ay, g), distance(&bx, &by, g));
    (nf * mg).cmp(&(ng * mf))
}

/// Which of two edges is lower just right of the abscissa `x`; `Equal` when they run together there.
///
/// Both edges span `x`: their leftmost ends lie at or left of it, their rightmost ends right of it.
pub(crate) fn height_order(e: Segment, f: Segment, x: f64) -> Ordering {
    let (e, f) = (rightward(e), rightward(f));
    let ((ye, de), (yf, df)) = (height(e, x), height(f, x));
    if ye + de < yf - df {
        return Ordering::Less;
    }
    if ye - de > yf + df {
        return Ordering::Greater;
    }
    let exactly = || {
        let at = Ratio::from_f64(x);
        let ordinate_on = |s: Segment| at.ordinate_on(s.map(|p| p.to_array()));
        ordinate_on(e).compare(&ordinate_on(f))
    };
    let both_start = (e[0].x == x && f[0].x == x).then(|| lexicographic(e[0], f[0]));
    let at_x = both_start.unwrap_or_else(|| fixed::height_order(e, f, x).unwrap_or_else(exactly));
    at_x.then_with(|| match turn(f, e) {
        Side::Right => Ordering::Less,
        Side::On => Ordering::Equal,
        Side::Left => Ordering::Greater,
    })
}

/// Whether the crossing of `e` and `f` lies left of, on or right of the abscissa `x`.
pub(crate) fn crossing_x_order(e: Segment, f: Segment, x: f64) -> Ordering {
    let exactly = || crossing_ratio(e, f)[0].compare(&Ratio::from_f64(x));
    // Rounding to nearest is monotone and keeps x, so only a tie needs the exact crossing.
    match crossing_by_residuals(e, f).and_then(|p| p.x.partial_cmp(&x)) {
        Some(Ordering::Equal) | None => fixed::crossing_x_order(e, f, x)
            .or_else(|| crossing_x_order_by_bounds(e, f, x))
            .unwrap_or_else(exactly),
        Some(order) => order,
    }
}

fn crossing_x_order_by_bounds(e: Segment, f: Segment, x: f64) -> Option<Ordering> {
    let [shift, area] = abscissa([e, f]);
    sided(shift.compare(area * Wide::from(x))?, [area])
}

/// The order of the abscissae of two crossings.
pub(crate) fn crossings_x_order(at: [Segment; 2], other: [Segment; 2]) -> Ordering {
    let by_bounds = || {
        let ([s, a], [t, b]) = (abscissa(at), abscissa(other));
        sided((s * b).compare(t * a)?, [a, b])
    };
    by_bounds()
        .unwrap_or_else(|| crossing_ratio(at[0], at[1])[0].compare(&crossing_ratio(other[0], other[1])[0]))
}

/// The crossing p of the two lines has u_e × p = -c_e and u_f × p = -c_f, so that p (u_e × u_f) = u_e c_f - u_f c_e: the abscissa
/// as a quotient.
fn abscissa([e, f]: [Segment; 2]) -> [Wide; 2] {
    let [(ue, ce), (uf, cf)] = [e, f].map(from_origin);
    [ue[0] * cf - uf[0] * ce, cross(ue, uf)]
}

/// The order of two quotients by that of their products with denominators, as far as the signs of these are known.
fn sided<const N: usize>(order: Ordering, denominators: [Wide; N]) -> Option<Ordering> {
    denominators.into_iter().try_fold(order, |order, denominator| {
        let is_negative = denominator.compare(Wide::from(0.0))? == Ordering::Less;
        Some(if is_negative { order.reverse() } else { order })
    })
}

/// The edge directed from its lexicographically smaller end.
#[inline]
pub(crate) fn rightward(e: Segment) -> Segment {
    if lexicographic(e[0], e[1]) == Ordering::Greater { [e[1], e[0]] } else { e }
}

/// The ordinate of a rightward, not vertical edge at `x`, and a bound on its error.
///
/// With the parameter in [0, 1] the seven roundings amount to less than 8u (|y0| + |y1|). An edge wider than the largest
/// double has no parameter, so no bound; an overflow of ordinates makes the bound infinite, which fails every comparison.
fn height(e: Segment, x: f64) -> (f64, f64) {
    let run = e[1].x - e[0].x;
    let t = (x - e[0].x) / run;
    let scale = e[0].y.abs() + e[1].y.abs();
    let error = if scale > 1e-290 && run.is_finite() { 16.0 * UNIT * scale } else { f64::INFINITY };
    (e[0].y + t * (e[1].y - e[0].y), error)
}

/// Whether `p`, a point on the line of `e`, lies strictly inside `e`.
pub(crate) fn is_inside(e: Segment, p: DVec2) -> bool {
    let (from, to) = (lexicographic(e[0], p), lexicographic(p, e[1]));
    from == to && from != Ordering::Equal
}

/// Whether the explicit point `p` on `e` comes before or after the crossing of `e` with `g`.
pub(crate) fn point_crossing_order(e: Segment, p: DVec2, g: Segment) -> Ordering {
    match side(g[0], g[1], p) {
        Side::On => Ordering::Equal,
        s if s == side(g[0], g[1], e[0]) => Ordering::Less,
        _ => Ordering::Greater,
    }
}
