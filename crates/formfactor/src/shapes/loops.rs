//! Loops in the plane: area, convexity, and their region for polygon Booleans.
use crate::numeric::predicates::turn_in_plane;
use glam::DVec2;
use polycsg::{Csg, FillRule, Scratch};
use std::cmp::Ordering;

/// The area inside an odd number of loops, which are finite.
pub(crate) fn area(loops: &[Vec<DVec2>]) -> f64 {
    leaf(loops).boundary(&mut Scratch::default()).area()
}

/// The set inside an odd number of loops, which are finite.
pub(crate) fn leaf(loops: &[Vec<DVec2>]) -> Csg<'_> {
    Csg::from_rings(loops, FillRule::EvenOdd).expect("coordinates are kept within finite bounds")
}

/// Whether a loop is counter-clockwise, convex, and has an area: decided exactly.
///
/// Every corner turns left or goes straight on, at least one turns, and the direction changes from leftward to rightward once:
/// a loop that winds around twice would do so twice. Points repeated in a row count once, as equal points have no turn.
pub(crate) fn is_convex(points: &[DVec2]) -> bool {
    let before = points.iter().cycle().skip(points.len().saturating_sub(1));
    let points: Vec<DVec2> = points.iter().zip(before).filter(|(p, q)| p != q).map(|(p, _)| *p).collect();
    let count = points.len();
    let point = |i: usize| points[i % count];
    let rightward = |i: usize| {
        let (start, end) = (point(i), point(i + 1));
        end.x > start.x || (end.x == start.x && end.y > start.y)
    };
    let starts = (0..count).filter(|i| !rightward(*i) && rightward(i + 1)).count();
    let turn = |i: usize| turn_in_plane(point(i), point(i + 1), point(i + 2));
    starts == 1
        && (0..count).all(|i| turn(i) != Ordering::Less)
        && (0..count).any(|i| turn(i) == Ordering::Greater)
}
