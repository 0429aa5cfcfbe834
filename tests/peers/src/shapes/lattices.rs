//! Squares on a lattice, whose edges coincide.

use super::shifted;
use crate::job::{Job, Op, Parts, Polygon};

fn square(i: usize, j: usize) -> Polygon {
    let (x, y) = (i as f64, j as f64);
    vec![vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]]]
}

fn squares(n: usize, keep: impl Fn(usize) -> bool) -> Vec<Polygon> {
    let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    cells.filter(|&(i, j)| keep(i + j)).map(|(i, j)| square(i, j)).collect()
}

/// n × n unit squares side by side: their union is one square.
pub(super) fn grid(n: usize) -> Job {
    Job::union_of_all(squares(n, |_| true), Parts::Coverage)
}

/// The black fields of a board of n × n, and the same shifted by half a field.
pub(super) fn shifted_checkers(n: usize) -> Job {
    let subject = squares(n, |sum| sum % 2 == 0);
    let clip = shifted(&subject, [0.5, 0.5]);
    Job::one(Op::Intersection, subject, clip, Parts::Apart)
}

/// The black fields against the white ones: all edges coincide, and nothing inside is left of them.
pub(super) fn complementary_checkers(n: usize) -> Job {
    let (subject, clip) = (squares(n, |sum| sum % 2 == 0), squares(n, |sum| sum % 2 == 1));
    Job::one(Op::SymmetricDifference, subject, clip, Parts::Apart)
}
