//! Boxes around patches.
use crate::scene::patch::Patch;
use formfactor::PlanarPolygon;
use glam::DVec3;

/// The least box with sides along the axes that holds a patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

impl Extent {
    /// The box of a patch.
    pub(crate) fn of(patch: &Patch) -> Extent {
        Extent::around(&patch.polygon)
    }

    /// The box of a polygon.
    pub(crate) fn around(polygon: &PlanarPolygon) -> Extent {
        let points = || polygon.loops().flatten().copied();
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        Extent { low, high: points().fold(DVec3::NEG_INFINITY, DVec3::max) }
    }

    /// The box of some points.
    pub(crate) fn of_points(points: impl Iterator<Item = DVec3>) -> Extent {
        points.fold(Extent::NOTHING, |extent, point| extent.with(&Extent { low: point, high: point }))
    }

    /// The box of nothing.
    pub(crate) const NOTHING: Extent = Extent { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// The box of both.
    pub(crate) fn with(&self, other: &Extent) -> Extent {
        Extent { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The axis along which it is longest.
    pub(crate) fn longest(&self) -> usize {
        let size = self.high - self.low;
        (1..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest })
    }

    /// The corners.
    pub(crate) fn corners(&self) -> [DVec3; 8] {
        let at = |corner: usize, axis: usize| {
            if corner >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] }
        };
        [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| DVec3::new(at(corner, 0), at(corner, 1), at(corner, 2)))
    }

    /// Whether two boxes are at most `distance` apart along every axis.
    pub(crate) fn is_near(&self, other: &Extent, distance: f64) -> bool {
        let margin = DVec3::splat(distance);
        !(self.low.cmpgt(other.high + margin) | other.low.cmpgt(self.high + margin)).any()
    }

    /// The largest magnitude of a coordinate.
    pub(crate) fn reach(&self) -> f64 {
        self.low.abs().max(self.high.abs()).max_element()
    }
}
