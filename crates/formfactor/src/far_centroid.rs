//! The centroid of what is seen of a part that is far for its size: Gauss's rule over all of it finds that from fewer functions than over its edges.
//!
//! ```text
//! d-------c    places by two shares: a (1 - u)(1 - v) + b u (1 - v) + c u v + d (1 - u) v;
//! |  .  . |    each weighs as much as it contributes, times the area that is there for the shares
//! |  .  . |
//! a-------b
//! ```
use crate::numeric::gauss::{RULE_3, RULE_4, RULE_6};
use glam::DVec2;

/// Gauss's rules, and the largest parts, as shares of how far they are, whose centroids they find to 1e-5 of their size: of 1500 of each of ten
/// sizes up to 0.4, strips, triangles and others, seen from anywhere, none was further off.
const SMALL: [(f64, &[[f64; 2]]); 3] = [(0.03, &RULE_3), (0.15, &RULE_4), (0.35, &RULE_6)];

/// The centroid between four corners in a plane, of which two may be the same, seen from `height` over its origin, where places contribute in
/// proportion to `weight`; nothing where that is not far for its size.
pub(crate) fn far_centroid(height: f64, corners: [DVec2; 4], weight: impl Fn(DVec2) -> f64) -> Option<DVec2> {
    let middle = corners.iter().sum::<DVec2>() / 4.0;
    let size = corners.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max);
    let share = size / height.hypot(middle.length());
    let (_, rule) = SMALL.iter().find(|(largest, _)| share <= *largest)?;
    let [a, b, c, d] = corners.map(|corner| corner - middle);
    let (mut sum, mut moment) = (0.0, DVec2::ZERO);
    for [v, of_row] in *rule {
        let (start, along) = (a.lerp(d, *v), b.lerp(c, *v) - a.lerp(d, *v));
        for [u, of_place] in *rule {
            let (place, across) = (start + along * *u, (d - a).lerp(c - b, *u));
            let part = of_row * of_place * along.perp_dot(across) * weight(middle + place);
            sum += part;
            moment += place * part;
        }
    }
    let off = moment / sum;
    (off.length() <= size).then_some(middle + off)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kernel from a height, but for a factor.
    fn kernel(height: f64, rise: f64) -> impl Fn(DVec2) -> f64 {
        move |place| {
            let lean = rise + DVec2::new(0.3, 0.05).dot(place);
            lean / (height * height + place.length_squared()).powi(2)
        }
    }

    /// By halves and halves of these, from the middle of each.
    fn by_parts(weight: &impl Fn(DVec2) -> f64, [a, b, c, d]: [DVec2; 4], depth: u32) -> (f64, DVec2) {
        let [ab, bc, cd, da] = [[a, b], [b, c], [c, d], [d, a]].map(|[p, q]| p.midpoint(q));
        let middle = ab.midpoint(cd);
        if depth == 0 {
            let share = ((b - a).perp_dot(c - a) + (c - a).perp_dot(d - a)) * weight(middle);
            return (share, middle * share);
        }
        let parts = [[a, ab, middle, da], [ab, b, bc, middle], [middle, bc, c, cd], [da, middle, cd, d]];
        let parts = parts.map(|part| by_parts(weight, part, depth - 1));
        parts.into_iter().fold((0.0, DVec2::ZERO), |sum, part| (sum.0 + part.0, sum.1 + part.1))
    }

    #[test]
    fn centroids_are_those_of_many_small_parts() {
        let quads = [
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
            [[-1.0, -0.01], [1.0, -0.01], [1.0, 0.01], [-1.0, 0.01]],
            [[0.0, 0.0], [1.0, 0.2], [0.3, 0.9], [0.3, 0.9]],
            [[0.0, 0.0], [1.0, -0.3], [1.3, 0.9], [0.1, 0.4]],
        ];
        for (turn, corners) in quads.into_iter().enumerate() {
            for [height, aside, rise] in
                [[6.0, 0.0, 1.0], [1.0, 7.0, 0.1], [0.05, 12.0, 0.0], [30.0, 20.0, 1.0]]
            {
                let weight = kernel(height, rise);
                let corners = corners.map(|[x, y]| DVec2::new(x + aside, y));
                let (sum, moment) = by_parts(&weight, corners, 7);
                let found = far_centroid(height, corners, &weight).expect("far for its size");
                assert!(found.distance(moment / sum) < 2e-5, "{turn}: {found} {} {height}", moment / sum);
            }
        }
    }

    #[test]
    fn what_is_near_or_has_no_area_is_left_to_its_edges() {
        let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(DVec2::from);
        assert_eq!(far_centroid(1.0, square, kernel(1.0, 1.0)), None);
        assert_eq!(far_centroid(1.0, [DVec2::ZERO; 4], kernel(1.0, 1.0)), None);
    }
}
