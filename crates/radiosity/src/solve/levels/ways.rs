//! The six ways along the axes and against them, which tiles face more or less.

use glam::DVec3;

/// How far something is along each axis, and against it.
pub(super) type Ways = [f64; 6];

/// A unit vector's parts along the six ways.
pub(super) fn ways(along: DVec3) -> Ways {
    let [x, y, z] = along.to_array();
    [x, -x, y, -y, z, -z].map(|part| part.max(0.0))
}

/// Of the ways of two unit vectors no less than the cosine between them, and that where one of the two is along an axis.
pub(super) fn dot(one: &Ways, other: &Ways) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ways_of_two_vectors_bound_their_cosine() {
        let of = |k: u32| {
            let [a, b] = [f64::from(k % 9) * 0.7, f64::from(k / 9) * 0.35 - 1.5];
            DVec3::new(a.cos() * b.cos(), a.sin() * b.cos(), b.sin())
        };
        for (one, other) in (0..81).flat_map(|one| (0..81).map(move |other| (of(one), of(other)))) {
            assert!(dot(&ways(one), &ways(other)) >= one.dot(other) - 1e-15);
            assert!((dot(&ways(one), &ways(DVec3::Y)) - one.y.max(0.0)).abs() < 1e-15);
        }
    }
}
