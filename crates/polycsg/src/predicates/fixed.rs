//! The predicates on integers of fixed size, where the coordinates' exponents allow these; none where they do not.

use super::{Segment, Side};
use exactfloat::fixed::{self, compare_products};
use glam::DVec2;
use std::cmp::Ordering;

type Point = [i64; 2];

fn scaled<const N: usize>(points: [DVec2; N]) -> Option<[Point; N]> {
    fixed::scaled(points.map(|p| p.to_array()))
}

/// The cross product of `b - a` and `d - c`.
fn cross(a: Point, b: Point, c: Point, d: Point) -> i128 {
    let run = |from: Point, to: Point| [to[0] - from[0], to[1] - from[1]].map(i128::from);
    let ([ux, uy], [vx, vy]) = (run(a, b), run(c, d));
    ux * vy - uy * vx
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
