//! Which side of a polygon's plane points are on, in rationals.
use super::Loops;
use crate::exact::ratio;
use glam::DVec3;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

type Point = [BigRational; 3];

/// Whether `point` lies on the side from which loop 0 is counter-clockwise.
pub(super) fn is_before(polygon: &Loops, point: DVec3) -> bool {
    height(&normal(&polygon[0]), &polygon[0], point).is_positive()
}

/// Whether the polygon's plane contains all of the points.
pub(super) fn contains(polygon: &Loops, points: &[DVec3]) -> bool {
    let normal = normal(&polygon[0]);
    points.iter().all(|p| height(&normal, &polygon[0], *p).is_zero())
}

fn height(normal: &Point, outer: &[DVec3], point: DVec3) -> BigRational {
    dot(normal, &between(outer[0], point))
}

/// Newell's sum: twice the area, along the normal.
fn normal(outer: &[DVec3]) -> Point {
    let zero = || BigRational::zero();
    outer[1..].windows(2).fold([zero(), zero(), zero()], |sum, pair| {
        let part = cross(&between(outer[0], pair[0]), &between(outer[0], pair[1]));
        [0, 1, 2].map(|i| &sum[i] + &part[i])
    })
}

/// The same in doubles.
pub(super) fn newell(outer: &[DVec3]) -> DVec3 {
    outer[1..].windows(2).map(|pair| (pair[0] - outer[0]).cross(pair[1] - outer[0])).sum()
}

fn between(from: DVec3, to: DVec3) -> Point {
    [0, 1, 2].map(|i| ratio(to[i]) - ratio(from[i]))
}

fn cross(a: &Point, b: &Point) -> Point {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i])
}

fn dot(a: &Point, b: &Point) -> BigRational {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}
