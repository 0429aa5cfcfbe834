//! Closed forms, each written from its derivation. Nothing here is of the crate's own.
use formfactor::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Loops, the first counter-clockwise seen from the front.
pub(crate) type Loops = Vec<Vec<DVec3>>;

/// dA parallel to a rectangle a × b at distance c, below its corner. Of Lambert's contour sum F = Σ β N·Γ / 2π the two sides
/// through the corner add nothing: their planes hold the normal.
pub(crate) fn parallel_corner(a: f64, b: f64, c: f64) -> f64 {
    let side = |reach: f64, length: f64| {
        let distance = reach.hypot(c);
        reach / distance * (length / distance).atan()
    };
    (side(a, b) + side(b, a)) / TAU
}

/// dA perpendicular to a rectangle, b wide and a high from dA's plane on, at distance c from its corner: only the sides at the
/// bottom and at the top have an N·Γ that is not 0.
pub(crate) fn standing_corner(a: f64, b: f64, c: f64) -> f64 {
    let slant = a.hypot(c);
    ((b / c).atan() - c / slant * (b / slant).atan()) / TAU
}

/// A rectangle seen from below the origin of its plane, or from before it, by a corner form: the four corners with signs.
pub(crate) fn by_corners([a0, a1]: [f64; 2], [b0, b1]: [f64; 2], corner: impl Fn(f64, f64) -> f64) -> f64 {
    let signed = |a: f64, b: f64| a.signum() * b.signum() * corner(a.abs(), b.abs());
    signed(a1, b1) - signed(a0, b1) - signed(a1, b0) + signed(a0, b0)
}

/// dA below the middle of a regular polygon of n sides with inradius 1 at height h: n equal terms of Lambert's sum.
pub(crate) fn below_regular(n: f64, h: f64) -> f64 {
    let distance = 1.0_f64.hypot(h);
    n * 2.0 * ((PI / n).tan() / distance).atan() / distance / TAU
}

/// The area of a polygon times its form factor to another one, where each is wholly before the other and nothing hides: Stokes's
/// theorem on both makes of it ∮∮ ln r dr1·dr2 / 2π (Sparrow 1963), a sum over pairs of edges.
pub(crate) fn exchange(source: &Loops, target: &Loops) -> f64 {
    let pairs = edges(source).flat_map(|one| edges(target).map(move |other| (one, other)));
    pairs.map(|(one, other)| pair(one, other)).sum::<f64>() / TAU
}

/// The form factor from one to the other.
pub(crate) fn unhidden(source: &Loops, target: &Loops) -> f64 {
    exchange(source, target) / area(source)
}

pub(crate) fn area(loops: &Loops) -> f64 {
    let origin = loops[0][0];
    edges(loops).map(|[a, b]| (a - origin).cross(b - origin) / 2.0).sum::<DVec3>().length()
}

fn edges(loops: &Loops) -> impl Iterator<Item = [DVec3; 2]> {
    loops.iter().flat_map(|l| l.iter().zip(l.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]))
}

/// (d1·d2) ∬ ln r over two edges: nothing where they are perpendicular, closed where parallel, elsewhere closed along one
/// and by the tanh-sinh rule along the other, which takes the logarithm at a common end as it is.
fn pair([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> f64 {
    let (one, other) = (b - a, d - c);
    let cosine = one.dot(other) / (one.length() * other.length());
    if cosine.abs() < 1e-15 {
        0.0
    } else if cosine.abs() > 1.0 - 1e-15 {
        let [from, to] = if cosine > 0.0 { [c, d] } else { [d, c] };
        cosine.signum() * parallel([a, b], [from, to])
    } else {
        cosine * one.length() * tanh_sinh(|share| along(a.lerp(b, share), [c, d]))
    }
}

/// ∬ ln r over two edges of one direction: second differences of what differentiated twice by w is ln √(w² + s²).
fn parallel([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> f64 {
    let way = (b - a).normalize();
    let [start, length, other] = [c - a, b - a, d - c].map(|v| v.dot(way));
    let apart = (c - a - start * way).length();
    let twice = |w: f64| {
        let r = w.hypot(apart);
        let log = if r > 0.0 { (w * w - apart * apart) / 2.0 * r.ln() } else { 0.0 };
        log - 0.75 * w * w + apart * w * angle(w, apart)
    };
    twice(start + other) - twice(start) - twice(start + other - length) + twice(start - length)
}

/// ∫ ln r from a point along an edge.
fn along(point: DVec3, [c, d]: [DVec3; 2]) -> f64 {
    let way = (d - c).normalize();
    let [from, to] = [c - point, d - point].map(|v| v.dot(way));
    let apart = (c - point - from * way).length();
    let once = |w: f64| {
        let r = w.hypot(apart);
        (if r > 0.0 { w * r.ln() } else { 0.0 }) - w + apart * angle(w, apart)
    };
    once(to) - once(from)
}

/// atan(w / s), also for s = 0, where it is multiplied by 0.
fn angle(w: f64, s: f64) -> f64 {
    if s > 0.0 { (w / s).atan() } else { 0.0 }
}

/// ∫ f over [0, 1] (Takahasi and Mori 1974): the trapezoidal rule after x = (1 + tanh(π/2 sinh t)) / 2.
fn tanh_sinh(f: impl Fn(f64) -> f64) -> f64 {
    const STEPS: i32 = 160;
    const REACH: f64 = 3.3;
    let step = REACH / f64::from(STEPS);
    let node = |i: i32| {
        let t = step * f64::from(i);
        let (x, slope) = (FRAC_PI_2 * t.sinh(), FRAC_PI_2 * t.cosh());
        slope / (2.0 * x.cosh() * x.cosh()) * f((1.0 + x.tanh()) / 2.0)
    };
    (-STEPS..=STEPS).map(node).sum::<f64>() * step
}

/// Between infinite strips, by strings across (a to d, b to c) and along (a to c, b to d) around what is in between, for a
/// source ab of this width (Hottel 1954).
pub(crate) fn strings(crossed: [f64; 2], uncrossed: [f64; 2], width: f64) -> f64 {
    (crossed[0] + crossed[1] - uncrossed[0] - uncrossed[1]) / (2.0 * width)
}
