//! Long edges that lie close together.

use super::polar;
use crate::job::{Job, Op, Parts, Ring};

/// Two stars of n edges each about one centre: long radial edges, each of which meets a few of the other star's.
pub(super) fn stars(n: usize) -> Job {
    let star = |turn: f64, inner: f64, outer: f64| -> Ring {
        let (sin, cos) = (turn * std::f64::consts::TAU / n as f64).sin_cos();
        let ring = polar(n, [0.0, 0.0], |i, _| if i % 2 == 0 { outer } else { inner });
        ring.into_iter().map(|[x, y]| [cos * x - sin * y, sin * x + cos * y]).collect()
    };
    let (subject, clip) = (vec![vec![star(0.0, 0.5, 1.0)]], vec![vec![star(0.37, 0.45, 0.95)]]);
    Job::one(Op::Intersection, subject, clip, Parts::Apart)
}

/// A diagonal comb of n edges, nearly parallel and as long as the comb is wide, cut in half by one long edge.
pub(super) fn comb(n: usize) -> Job {
    let teeth = (n / 2).max(1);
    let length = teeth as f64;
    let tooth = |i: usize| {
        let x = i as f64;
        [[x, 0.0], [x + 0.5 + length, length]]
    };
    let mut ring: Ring = (0..teeth).flat_map(tooth).collect();
    ring.extend([[length, 0.0], [length, -1.0], [0.0, -1.0]]);
    ring.reverse();
    let (right, middle) = (2.0 * length + 2.0, 0.5 * length + 0.25);
    let below = vec![[-2.0, -2.0], [right, -2.0], [right, middle], [-2.0, middle]];
    Job::one(Op::Intersection, vec![vec![ring]], vec![vec![below]], Parts::Apart)
}
