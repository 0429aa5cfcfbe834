//! Signs, exact over the whole range of doubles: the only place that decides one.
use exactfloat::{orient2d, orient3d};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// Whether a point lies in the plane of three others.
pub(crate) fn is_coplanar([a, b, c]: [DVec3; 3], point: DVec3) -> bool {
    orient3d(a.to_array(), b.to_array(), c.to_array(), point.to_array()) == 0.0
}

/// How three points turn: greater counter-clockwise, equal on a line.
pub(crate) fn turn([a, b, c]: [DVec2; 3]) -> Ordering {
    let determinant = orient2d(a.to_array(), b.to_array(), c.to_array());
    determinant.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

/// Whether the ray from a point to the right crosses an edge: a point is inside where it crosses an odd number.
///
/// ```text
///          b                the lower end counts as below the ray, the upper one as above: a ray through a vertex
///   p ──── ╱ ──▶            crosses one of the two edges that go on there
///         a
/// ```
pub(crate) fn ray_crosses(point: DVec2, [a, b]: [DVec2; 2]) -> bool {
    (a.y > point.y) != (b.y > point.y) && (turn([a, b, point]) == Ordering::Greater) == (b.y > a.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_are_exact_where_products_round_or_leave_the_range() {
        let [a, b] = [DVec2::ZERO, DVec2::new(3.0, 1.0)];
        for scale in [2f64.powi(-1000), 1.0, 2f64.powi(1000)] {
            let [b, on] = [b * scale, DVec2::new(0.75, 0.25) * scale];
            assert_eq!(turn([a, b, on]), Ordering::Equal);
            assert_eq!(turn([a, b, DVec2::new(on.x, on.y.next_up())]), Ordering::Greater);
            assert_eq!(turn([a, b, DVec2::new(on.x, on.y.next_down())]), Ordering::Less);
            let corners = [a, b, on.perp()].map(|p| p.extend(p.x));
            assert!(is_coplanar(corners, DVec2::new(scale, scale).extend(scale)));
            assert!(!is_coplanar(corners, DVec2::new(scale, scale).extend(scale.next_up())));
        }
    }

    #[test]
    fn a_ray_crosses_a_triangle_once_from_inside_and_never_or_twice_from_outside() {
        let corners = [[0.0, 0.0], [4.0, 1.0], [1.0, 3.0]].map(DVec2::from);
        let crossings = |x: f64, y: f64| {
            let point = DVec2::new(x, y);
            (0..3).filter(|&k| ray_crosses(point, [corners[k], corners[(k + 1) % 3]])).count()
        };
        assert_eq!([crossings(1.0, 1.0), crossings(2.0, 1.0), crossings(1.0, 2.9)], [1; 3]);
        assert_eq!([crossings(-1.0, 1.0), crossings(-1.0, 2.0)], [2; 2]);
        assert_eq!([crossings(5.0, 1.0), crossings(1.0, -1.0), crossings(-1.0, 3.0)], [0; 3]);
    }
}
