//! Smooth outlines, nested rings and sieves, each against a shifted copy.

use super::{polar, shifted};
use crate::job::{Job, Op, Parts, Polygon, Ring};

/// Two smooth outlines of n edges each that cross a few times.
pub(super) fn blobs(n: usize) -> Job {
    let blob = |centre: [f64; 2], phase: f64| -> Polygon {
        vec![polar(n, centre, |_, angle| {
            1.0 + 0.2 * (5.0 * angle + phase).sin() + 0.05 * (17.0 * angle).cos()
        })]
    };
    let (subject, clip) = (vec![blob([0.0, 0.0], 0.0)], vec![blob([0.31, 0.17], 1.0)]);
    Job::one(Op::Intersection, subject, clip, Parts::Apart)
}

/// n concentric annuli of sixteen edges a ring, and a copy shifted by 2.3 times their distance.
pub(super) fn annuli(n: usize) -> Job {
    let ring = |r: f64| polar(16, [0.0, 0.0], move |_, _| r);
    let annulus = |i: usize| -> Polygon {
        let outer = (i + 1) as f64;
        let mut hole = ring(outer - 0.5);
        hole.reverse();
        vec![ring(outer), hole]
    };
    let subject: Vec<Polygon> = (0..n).map(annulus).collect();
    let clip = shifted(&subject, [2.1, 0.94]);
    Job::one(Op::Intersection, subject, clip, Parts::Apart)
}

/// A square with about n hexagonal holes, and a shifted copy.
pub(super) fn holes(n: usize) -> Job {
    let side = (n as f64).sqrt().ceil();
    let along = (0..).map(|i| f64::from(i) + 0.5).take_while(|&c| c < side);
    let hole = |x: f64, y: f64| -> Ring {
        let mut ring = polar(6, [x, y], |i, _| 0.3 + 0.02 * i as f64);
        ring.reverse();
        ring
    };
    let mut sieve = vec![vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]];
    sieve.extend(along.clone().flat_map(|x| along.clone().map(move |y| hole(x, y))).take(n));
    let clip = shifted(std::slice::from_ref(&sieve), [0.37, 0.21]);
    Job::one(Op::Intersection, vec![sieve], clip, Parts::Apart)
}
