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
