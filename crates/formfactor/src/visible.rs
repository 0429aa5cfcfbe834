//! The visible part of a target.
use crate::{DifferentialArea, PlanarPolygon};
use glam::DVec3;
use polycsg::Region;

/// What a differential area sees of a target: a region of the target's plane, and where it lies in space.
#[derive(Clone, Debug)]
pub struct VisiblePart {
    region: Region,
}

impl VisiblePart {
    /// The part in the two kept coordinates of the target's plane.
    #[must_use]
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// The rings in space.
    pub fn rings(&self) -> impl Iterator<Item = Vec<DVec3>> + '_ {
        self.region.rings().map(|r| r.iter().map(|p| p.extend(0.0)).collect())
    }
}

/// The part of the target that the differential area sees.
#[must_use]
pub fn visible_part(
    _from: &DifferentialArea,
    _to: &PlanarPolygon,
    _occluders: &[PlanarPolygon],
) -> VisiblePart {
    VisiblePart { region: Region::default() }
}
