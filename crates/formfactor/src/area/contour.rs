//! The form factor between two polygons with nothing in between, as a double contour integral:
//!
//! A1 F12 = 1 / (2 pi) sum over edges p of one and q of the other of (p . q) integral integral ln r ds dt,
//!
//! s and t running along unit directions p and q, each loop counter-clockwise seen from its front. [Sparrow 1963]
//!
//! Perpendicular edges add nothing, and for parallel ones at a distance h the integral has a closed form by
//! G(z) = (z^2 - h^2) ln(z^2 + h^2) / 4 - 3 z^2 / 4 + h z atan(z / h), the second integral of ln sqrt(z^2 + h^2).
//! So boxes need no quadrature. For other pairs the inner integral has one, and the outer one is taken by Gauss's
//! rules on stretches that are halved where rules differ.
use crate::numeric::gauss::{RULE_3, RULE_5, RULE_8};
use crate::numeric::rounding::rounding_of;
use crate::scene::surfaces::Surface;
use glam::DVec3;
use std::f64::consts::TAU;

/// A directed edge.
type Segment = [DVec3; 2];

/// `A1 F12` from the edges of two polygons and an estimate of its error, rounding included; right only where each is before the other's
/// plane.
pub(super) fn exchange(ps: &[Segment], qs: &[Segment], tolerance: f64) -> [f64; 2] {
    let size = ps.iter().chain(qs).flatten().fold(0.0, |size: f64, p| size.max(p.distance(ps[0][0])));
    let each = tolerance * TAU / f64::from(u32::try_from(ps.len() * qs.len()).unwrap_or(u32::MAX));
    let (mut sum, mut error) = (0.0, 0.0);
    for p in ps {
        for q in qs {
            let [part, part_error] = pair(*p, *q, size, each);
            sum += part;
            error += part_error;
        }
    }
    [sum / TAU, error / TAU]
}

/// Whether the integral has a closed form: edges are parallel or perpendicular.
pub(super) fn is_closed(one: &Surface, other: &Surface) -> bool {
    let way = |[a, b]: &Segment| *b - *a;
    let is_plain = |p: DVec3, q: DVec3| p.dot(q) == 0.0 || p.cross(q) == DVec3::ZERO;
    one.edges.iter().all(|p| other.edges.iter().all(|q| is_plain(way(p), way(q))))
}

/// (p . q) times the integral of ln(r / size), which in sum over closed loops is that of ln r.
fn pair([a, b]: Segment, [c, d]: Segment, size: f64, tolerance: f64) -> [f64; 2] {
    let (way, other) = (b - a, d - c);
    let (length, cosine) = (way.length(), way.dot(other) / (way.length() * other.length()));
    if way.dot(other) == 0.0 {
        return [0.0, 0.0];
    }
    if way.cross(other) == DVec3::ZERO {
        let [value, error] = parallel([a, b], [c, d], size);
        return [value * cosine.signum(), error];
    }
    // A point on an edge is off by two roundings of each coordinate: a quarter of what may put points off planes.
    let blur = rounding_of([a, b, c, d]) / (4.0 * size);
    let inner = |s: f64| along(a + way * s, [c, d], size, blur);
    let away = |s: f64| to_segment(a + way * s, [c, d]) / length;
    let [value, error] = adaptive(&inner, &away, tolerance / (length * cosine.abs()).max(f64::MIN_POSITIVE));
    [value * length * cosine, error * length * cosine.abs()]
}

/// How far a point is from a segment.
pub(super) fn to_segment(point: DVec3, [a, b]: Segment) -> f64 {
    let way = b - a;
    let share = ((point - a).dot(way) / way.length_squared()).clamp(0.0, 1.0);
    point.distance(a + way * share)
}

/// The double integral for parallel edges, and its rounding.
fn parallel([a, b]: Segment, [c, d]: Segment, size: f64) -> [f64; 2] {
    let direction = (b - a).normalize();
    let (length, from, to) = ((b - a).length(), direction.dot(c - a), direction.dot(d - a));
    let height = (c - a - direction * from).length();
    let (low, high) = (from.min(to), from.max(to));
    let terms = [(length - low, 1.0), (length - high, -1.0), (-low, -1.0), (-high, 1.0)];
    let each = terms.map(|(z, sign)| {
        let [value, rounding] = second_integral(z / size, height / size);
        [sign * value, rounding].map(|x| x * size * size)
    });
    each.into_iter().fold([0.0; 2], |[sum, error], [value, rounding]| [sum + value, error + rounding])
}

/// What rounding may change of terms like these: logarithms near 0 and arcs cancel, but no argument is off by more than some
/// roundings.
fn rounding(size: f64, square: f64) -> f64 {
    8.0 * f64::EPSILON * size * (1.0 + square.ln().abs())
}

/// G of the module's text, and its rounding.
fn second_integral(z: f64, h: f64) -> [f64; 2] {
    let square = z * z + h * h;
    if square == 0.0 {
        return [0.0; 2];
    }
    let value = (z * z - h * h) * square.ln() / 4.0 - 0.75 * z * z + h * z * z.atan2(h);
    [value, rounding(square, square)]
}

/// The integral of ln(r / size) from a point over an edge, and its rounding; places are known to within `blur` sizes.
fn along(point: DVec3, [c, d]: Segment, size: f64, blur: f64) -> [f64; 2] {
    let direction = (d - c).normalize();
    let from = direction.dot(c - point);
    let (low, high) = (from / size, direction.dot(d - point) / size);
    let height = (c - point - direction * from).length() / size;
    let primitive = |s: f64| {
        let square = s * s + height * height;
        if square == 0.0 {
            return [0.0; 2];
        }
        // It changes by ln r where an end moves along the edge, and by no more than pi / 2 where the point moves aside.
        let moved = blur * (square.ln().abs() / 2.0 + 2.0);
        [s * square.ln() / 2.0 - s + height * s.atan2(height), rounding(square.sqrt(), square) + moved]
    };
    let ([upper, rounded], [lower, rounded_too]) = (primitive(high), primitive(low));
    [size * (upper - lower), size * (rounded + rounded_too)]
}

/// By so much differences are raised.
const SURE: f64 = 8.0;

/// Halvings of one stretch before what its differences say counts as error.
const DEEPEST: u32 = 40;

/// The integral over [0, 1] by rules of three, five and eight nodes, and what the last leaves.
///
/// The integrand is analytic at all points that are nearer to a stretch than the other edge is. So errors fall as r^(-2n) with n nodes, r
/// from the distance over half the stretch, and two differences say by which constant.
fn adaptive(f: &impl Fn(f64) -> [f64; 2], away: &impl Fn(f64) -> f64, tolerance: f64) -> [f64; 2] {
    let (mut value, mut error) = (0.0, 0.0);
    let mut open = vec![(0.0, 1.0, 0)];
    while let Some((low, high, depth)) = open.pop() {
        let (middle, half) = (f64::midpoint(low, high), (high - low) / 2.0);
        let [[few, _], [more, _], [many, rounding]] =
            [&RULE_3[..], &RULE_5, &RULE_8].map(|rule| by_rule(f, rule, low, high));
        let apart = (away(middle) / half - 1.0).max(0.0);
        let falls = |nodes: i32| (apart + apart.hypot(1.0)).powi(-2 * nodes);
        let left = SURE * ((more - few).abs() * falls(5)).max((many - more).abs() * falls(3));
        if left <= (tolerance * (high - low)).max(rounding) || depth == DEEPEST {
            value += many;
            error += left.max(rounding);
        } else {
            open.push((middle, high, depth + 1));
            open.push((low, middle, depth + 1));
        }
    }
    [value, error]
}

/// The integral from one number to another, and the roundings.
fn by_rule(f: &impl Fn(f64) -> [f64; 2], rule: &[[f64; 2]], low: f64, high: f64) -> [f64; 2] {
    let width = high - low;
    rule.iter().fold([0.0; 2], |[value, rounded], [x, weight]| {
        let [own, own_rounded] = f(low + width * x);
        [value + width * weight * own, rounded + width * weight * own_rounded]
    })
}
