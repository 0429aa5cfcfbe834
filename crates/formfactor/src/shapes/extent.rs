//! Boxes with faces along the axes.
use glam::DVec3;

/// A box with its faces along the axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

impl Extent {
    pub(crate) const NOTHING: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// The smallest box around points.
    pub(crate) fn around(points: &[DVec3]) -> Self {
        points.iter().fold(Self::NOTHING, |all, p| all.with(Self { low: *p, high: *p }))
    }

    /// The box, larger by so much on each side.
    pub(crate) fn grown(self, by: f64) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }

    /// Whether two boxes have no point in common.
    pub(crate) fn misses(&self, other: &Self) -> bool {
        self.low.cmpgt(other.high).any() || other.low.cmpgt(self.high).any()
    }

    /// Whether two boxes have no point in common, wherever what is in them is that may lie off its place by `deviation`: twice that is more than
    /// what is left of it where coordinates are rounded.
    pub(crate) fn is_beside(&self, other: &Self, deviation: f64) -> bool {
        self.misses(&other.grown(2.0 * deviation))
    }

    /// Whether a ray misses the box by more than rounding explains: a margin of 1e-12 of the coordinates, far more than the
    /// roundings of this test.
    pub(crate) fn misses_ray(&self, origin: DVec3, direction: DVec3) -> bool {
        let margin = 1e-12 * (self.low.abs() + self.high.abs() + origin.abs());
        let (low, high) = (self.low - margin - origin, self.high + margin - origin);
        let (mut first, mut last) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            if direction[axis] == 0.0 {
                if low[axis] > 0.0 || high[axis] < 0.0 {
                    return true;
                }
            } else {
                let (a, b) = (low[axis] / direction[axis], high[axis] / direction[axis]);
                first = first.max(a.min(b));
                last = last.min(a.max(b));
            }
        }
        first > last
    }

    pub(crate) fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_ray_to_a_point_of_a_box_does_not_miss_it(
            corners in prop::array::uniform3((-9.0..9.0, -9.0..9.0, -9.0..9.0)), origin in (-9.0..9.0, -9.0..9.0, -9.0..9.0),
            share in prop::array::uniform3(prop_oneof![Just(0.0), Just(1.0), 0.0..1.0]),
        ) {
            let extent = Extent::around(&corners.map(DVec3::from));
            let at = extent.low + DVec3::from(share) * (extent.high - extent.low);
            let origin = DVec3::from(origin);
            prop_assert!(!extent.misses_ray(origin, at - origin));
            let beyond = extent.high + (extent.high - origin).abs() + 1.0;
            prop_assert!(extent.misses_ray(beyond, DVec3::ONE));
        }
    }
}
