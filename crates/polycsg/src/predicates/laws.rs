//! What each predicate must answer, from big integers on the configuration's own grid. For tests and for fuzzing.

use super::configurations::{Configuration, stepped};
use super::*;
use glam::DVec2;
use num_bigint::BigInt;
use num_traits::{Float, Signed, Zero};
use std::cmp::Ordering;

/// Whether a predicate is right about a configuration; none where it has no question there.
type Law = fn(&Configuration) -> Option<bool>;

/// Asks every predicate about one configuration, made of a stream of words.
///
/// # Errors
/// The predicate that is wrong, and the points.
#[cfg(fuzzing)]
pub(crate) fn check(mut word: impl FnMut() -> u64) -> Result<(), String> {
    let points = super::configurations::configuration(&mut word);
    let wrong = LAWS.iter().find(|(_, law)| law(&points) == Some(false));
    wrong.map_or(Ok(()), |(name, _)| Err(format!("{name} is wrong about {points:?}")))
}

/// Each predicate's law.
pub(super) const LAWS: [(&str, Law); 10] = [
    ("side", side_is_exact),
    ("turn", turn_is_exact),
    ("crossing_order", crossings_are_in_order),
    ("parameter", certain_parameters_are_in_order),
    ("point_crossing_order", points_and_crossings_are_in_order),
    ("height_order", heights_are_in_order),
    ("crossing_x_order", abscissae_are_in_order),
    ("crossings_x_order", abscissae_of_crossings_are_in_order),
    ("crossing_point", crossings_are_nearest),
    ("margins", what_is_clear_is_so),
];

/// A point, or a direction, in steps of a grid.
type Steps = [BigInt; 2];

/// Doubles in steps of the finest grid that any of them needs.
fn steps(values: &[f64]) -> Vec<BigInt> {
    let decoded = || values.iter().map(|&v| Float::integer_decode(v));
    let lowest = decoded().filter(|d| d.0 != 0).map(|d| d.1).min().unwrap_or(0);
    let step = |(mantissa, exponent, sign): (u64, i16, i8)| {
        let magnitude = BigInt::from(mantissa) * i32::from(sign);
        if mantissa == 0 { magnitude } else { magnitude << (exponent - lowest).unsigned_abs() }
    };
    decoded().map(step).collect()
}

fn points<const N: usize>(points: [DVec2; N]) -> [Steps; N] {
    let flat: Vec<f64> = points.iter().flat_map(|p| [p.x, p.y]).collect();
    let flat = steps(&flat);
    std::array::from_fn(|i| [flat[2 * i].clone(), flat[2 * i + 1].clone()])
}

fn minus(a: &Steps, b: &Steps) -> Steps {
    [&a[0] - &b[0], &a[1] - &b[1]]
}

fn cross(u: &Steps, v: &Steps) -> BigInt {
    &u[0] * &v[1] - &u[1] * &v[0]
}

fn area(a: &Steps, b: &Steps, c: &Steps) -> BigInt {
    cross(&minus(b, a), &minus(c, a))
}

fn order(n: &BigInt) -> Ordering {
    n.cmp(&BigInt::zero())
}

/// Whether two edges cross inside both.
fn do_cross([a, b]: [&Steps; 2], [c, d]: [&Steps; 2]) -> bool {
    let part = |p: BigInt, q: BigInt| (p * q).is_negative();
    part(area(a, b, c), area(a, b, d)) && part(area(c, d, a), area(c, d, b))
}

/// Where along the first edge its line meets the second's: a ratio with a positive denominator.
fn parameter([a, b]: [&Steps; 2], [c, d]: [&Steps; 2]) -> [BigInt; 2] {
    let along = minus(d, c);
    let (n, w) = (cross(&minus(c, a), &along), cross(&minus(b, a), &along));
    if w.is_negative() { [-n, -w] } else { [n, w] }
}

fn compare([n, w]: &[BigInt; 2], [m, v]: &[BigInt; 2]) -> Ordering {
    (n * v).cmp(&(m * w))
}

fn side_is_exact(&[a, b, c, ..]: &Configuration) -> Option<bool> {
    let [p, q, r] = points([a, b, c]);
    Some(side(a, b, c) == Side::from(order(&area(&p, &q, &r))))
}

fn turn_is_exact(&[a, b, c, d, ..]: &Configuration) -> Option<bool> {
    let [p, q, r, s] = points([a, b, c, d]);
    Some(turn([a, b], [c, d]) == Side::from(order(&cross(&minus(&q, &p), &minus(&s, &r)))))
}

/// The order along the first edge of its crossings with the second and with the third.
fn order_of_crossings(all: &Configuration) -> Option<Ordering> {
    let [a, b, c, d, g, h] = &points(*all);
    let meets = do_cross([a, b], [c, d]) && do_cross([a, b], [g, h]);
    meets.then(|| compare(&parameter([a, b], [c, d]), &parameter([a, b], [g, h])))
}

fn crossings_are_in_order(all: &Configuration) -> Option<bool> {
    let &[a, b, c, d, g, h] = all;
    Some(crossing_order([a, b], [c, d], [g, h]) == order_of_crossings(all)?)
}

/// The filter's parameter of a crossing.
pub(super) fn filtered([a, b]: Segment, [c, d]: Segment) -> Parameter {
    Parameter::of_crossing(doubled_area(c, d, a), doubled_area(c, d, b))
}

/// What the bounds of two parameters prove.
pub(super) fn certain_order(p: Parameter, q: Parameter) -> Option<Ordering> {
    order_of_bounds([p.low(), p.high()], [q.low(), q.high()])
}

fn order_of_bounds<B: PartialOrd>(p: [B; 2], q: [B; 2]) -> Option<Ordering> {
    let (less, greater) = (p[1] < q[0], p[0] > q[1]);
    (less || greater).then_some(if less { Ordering::Less } else { Ordering::Greater })
}

fn certain_parameters_are_in_order(all: &Configuration) -> Option<bool> {
    let &[a, b, c, d, g, h] = all;
    let exact = order_of_crossings(all)?;
    let certain = certain_order(filtered([a, b], [c, d]), filtered([a, b], [g, h]));
    let [l, r] = [[c, d], [g, h]].map(|f| FineParameter::of_crossing([a, b], f));
    Some(
        [certain, order_of_bounds([l.low, l.high], [r.low, r.high])]
            .iter()
            .flatten()
            .all(|&order| order == exact),
    )
}

/// A point of an edge and a crossing on it: by the predicate, and by parameters where those are certain.
fn points_and_crossings_are_in_order(&[a, b, c, d, g, _]: &Configuration) -> Option<bool> {
    let [p, q, r, s, t] = &points([a, b, c, d, g]);
    let is_within = area(p, q, t).is_zero() && is_inside([a, b], g);
    if !is_within || !do_cross([p, q], [r, s]) {
        return None;
    }
    let (run, at) = (minus(q, p), minus(t, p));
    let axis = usize::from(run[0].is_zero());
    let scale = run[axis].signum();
    let exact = compare(&[&at[axis] * &scale, &run[axis] * &scale], &parameter([p, q], [r, s]));
    let certain = certain_order(Parameter::of_point([a, b], g), filtered([a, b], [c, d]));
    let (l, r) = (FineParameter::of_point([a, b], g), FineParameter::of_crossing([a, b], [c, d]));
    let finely = order_of_bounds([l.low, l.high], [r.low, r.high]);
    let mut told = [Some(point_crossing_order([a, b], g, [c, d])), certain, finely].into_iter().flatten();
    Some(told.all(|order| order == exact))
}

fn heights_are_in_order(&[a, b, c, d, ..]: &Configuration) -> Option<bool> {
    let (e, f) = (rightward([a, b]), rightward([c, d]));
    let x = e[0].x.max(f[0].x);
    if x >= e[1].x.min(f[1].x) {
        return None;
    }
    let [p, q, r, s, at] = &points([e[0], e[1], f[0], f[1], DVec2::new(x, 0.0)]);
    let height = |from: &Steps, to: &Steps| {
        let [dx, dy] = minus(to, from);
        [&from[1] * &dx + (&at[0] - &from[0]) * dy, dx]
    };
    let slope = |from: &Steps, to: &Steps| {
        let [dx, dy] = minus(to, from);
        [dy, dx]
    };
    let exact = compare(&height(p, q), &height(r, s)).then_with(|| compare(&slope(p, q), &slope(r, s)));
    Some(height_order([a, b], [d, c], x) == exact)
}

/// The crossing's coordinates as ratios with one positive denominator.
fn crossing([a, b]: [&Steps; 2], [c, d]: [&Steps; 2]) -> [[BigInt; 2]; 2] {
    let [n, w] = parameter([a, b], [c, d]);
    let run = minus(b, a);
    [0, 1].map(|axis| [&a[axis] * &w + &run[axis] * &n, w.clone()])
}

fn abscissae_are_in_order(&[a, b, c, d, g, _]: &Configuration) -> Option<bool> {
    let [p, q, r, s, at] = &points([a, b, c, d, DVec2::new(g.x, 0.0)]);
    let [x, _] = do_cross([p, q], [r, s]).then(|| crossing([p, q], [r, s]))?;
    Some(crossing_x_order([a, b], [c, d], g.x) == x[0].cmp(&(&at[0] * &x[1])))
}

fn abscissae_of_crossings_are_in_order(&[a, b, c, d, g, h]: &Configuration) -> Option<bool> {
    let [p, q, r, s, t, u] = &points([a, b, c, d, g, h]);
    let do_meet = do_cross([p, q], [r, s]) && do_cross([p, q], [t, u]);
    let [[x, _], [other, _]] = do_meet.then(|| [[r, s], [t, u]].map(|f| crossing([p, q], f)))?;
    Some(crossings_x_order([[a, b], [c, d]], [[g, h], [b, a]]) == compare(&x, &other))
}

/// Both coordinates are nearest, the even one of two as near, and neither order nor direction of the edges matters.
fn crossings_are_nearest(&[a, b, c, d, ..]: &Configuration) -> Option<bool> {
    let [p, q, r, s] = &points([a, b, c, d]);
    if !do_cross([p, q], [r, s]) {
        return None;
    }
    let found = crossing_point([a, b], [c, d]);
    let is_nearest = |axis: usize| {
        let value = found[axis];
        let smaller = if value == 0.0 { -5e-324 } else { stepped(value, -1) };
        let neighbours = [stepped(value, 1), smaller];
        neighbours.into_iter().all(|other| {
            let shifted = points([a, b, c, d, DVec2::new(value, other)]);
            let [p, q, r, s, [value_steps, other_steps]] = &shifted;
            let [n, w] = &crossing([p, q], [r, s])[axis];
            let off = |v: &BigInt| (v * w - n).abs();
            match off(value_steps).cmp(&off(other_steps)) {
                Ordering::Less => true,
                Ordering::Equal => value == other || value.to_bits() & 1 == 0,
                Ordering::Greater => false,
            }
        })
    };
    let is_same = [([c, d], [a, b]), ([b, a], [c, d]), ([d, c], [b, a])]
        .iter()
        .all(|&(e, f)| crossing_point(e, f) == found);
    Some(found.is_finite() && is_nearest(0) && is_nearest(1) && is_same)
}

/// Edges that are said to be clear of one another lie as far apart as said, or cross as said.
fn what_is_clear_is_so(&[a, b, c, d, ..]: &Configuration) -> Option<bool> {
    let size = [a, b, c, d].iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let margins = Margins::for_size(size);
    if margins.close.is_infinite() {
        return None;
    }
    let [p, q, r, s, [close, _]] = &points([a, b, c, d, DVec2::new(margins.close, 0.0)]);
    let is_apart = |[p, q]: [&Steps; 2], [r, s]: [&Steps; 2]| {
        let ([dx, dy], ends) = (minus(q, p), [area(p, q, r), area(p, q, s)]);
        let least = close * close * (&dx * &dx + &dy * &dy);
        order(&ends[0]) == order(&ends[1]) && ends.iter().all(|area| area * area > least)
    };
    let ends_of_f = [doubled_area(a, b, c), doubled_area(a, b, d)];
    if margins.are_apart([a, b], ends_of_f) {
        return Some(is_apart([p, q], [r, s]));
    }
    let ends_of_e = [doubled_area(c, d, a), doubled_area(c, d, b)];
    let crosses_from = |side: Ordering| do_cross([p, q], [r, s]) && order(&area(p, q, r)) == side;
    match margins.relation([[a, b], [c, d]], ends_of_f, ends_of_e) {
        Clear::Apart => Some(is_apart([r, s], [p, q])),
        Clear::CrossFromLeft => Some(crosses_from(Ordering::Greater)),
        Clear::CrossFromRight => Some(crosses_from(Ordering::Less)),
        Clear::Unclear => None,
    }
}
