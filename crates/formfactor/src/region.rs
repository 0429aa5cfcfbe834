//! Questions about loops in the plane.
use glam::DVec2;
use robust::{Coord, orient2d};

/// Twice the signed area of a loop.
fn doubled_area(points: &[DVec2]) -> f64 {
    let origin = points[0];
    points[1..].windows(2).map(|pair| (pair[0] - origin).perp_dot(pair[1] - origin)).sum()
}

/// The area inside an odd number of loops.
pub(crate) fn area(loops: &[Vec<DVec2>]) -> f64 {
    let holes: f64 = loops[1..].iter().map(|l| doubled_area(l).abs()).sum();
    (doubled_area(&loops[0]) - holes) / 2.0
}

/// Whether a counter-clockwise loop is convex; decided exactly, and never said of a loop that is not.
///
/// Every corner turns left or goes straight on, and the direction passes from leftward to rightward once.
pub(crate) fn is_convex(points: &[DVec2]) -> bool {
    let next = |i: usize| points[(i + 1) % points.len()];
    let rightward = |i: usize| {
        let edge = (points[i % points.len()], next(i % points.len()));
        edge.1.x > edge.0.x || (edge.1.x == edge.0.x && edge.1.y > edge.0.y)
    };
    let turns_left = |i: usize| left_turn(points[i], next(i), next((i + 1) % points.len()));
    let starts = (0..points.len()).filter(|i| !rightward(*i) && rightward(i + 1)).count();
    starts == 1 && (0..points.len()).all(turns_left)
}

/// `orient2d` is exact within this window of magnitudes; outside of it nothing is called convex.
fn left_turn(a: DVec2, b: DVec2, c: DVec2) -> bool {
    let exact = |x: f64| x == 0.0 || (x.abs() > 1e-90 && x.abs() < 1e90);
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    [a, b, c].iter().all(|p| exact(p.x) && exact(p.y)) && orient2d(coord(a), coord(b), coord(c)) >= 0.0
}
