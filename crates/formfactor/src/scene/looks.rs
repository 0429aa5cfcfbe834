//! How large polygons look from a point, roughly.
use crate::shapes::{extent::Extent, polygon::PlanarPolygon};
use glam::DVec3;

/// Where polygons are, and how large.
#[derive(Clone, Debug, Default)]
pub(super) struct Looks(Vec<Look>);

#[derive(Clone, Copy, Debug)]
struct Look {
    middle: DVec3,
    /// The normal, as long as the polygon's box is large.
    facing: DVec3,
}

impl Looks {
    pub(super) fn of(polygons: &[PlanarPolygon]) -> Self {
        let look = |polygon: &PlanarPolygon| {
            let Extent { low, high } = Extent::around(polygon.points());
            Look { middle: low.midpoint(high), facing: polygon.normal() * low.distance_squared(high) }
        };
        Self(polygons.iter().map(look).collect())
    }

    /// Sorts polygons by how large they look, the largest first.
    ///
    /// Takes O(n log n) for n of them.
    pub(super) fn sort(&self, from: DVec3, ids: &mut [usize]) {
        ids.sort_by_cached_key(|id| std::cmp::Reverse(self.0[*id].size(from).to_bits()));
    }
}

impl Look {
    /// The solid angle of a small disk, which is a number that is not negative.
    fn size(&self, from: DVec3) -> f64 {
        let way = self.middle - from;
        let square = way.length_squared().max(f64::MIN_POSITIVE);
        (self.facing.dot(way) / (square * square.sqrt())).abs()
    }
}
