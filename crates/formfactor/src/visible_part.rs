//! The visible part of a target as a region.
use crate::exact::shadows::{Shadows, shadows};
use crate::exact::view::View;
use crate::exact::visible::union;
use crate::shapes::differential_area::DifferentialArea;
use crate::shapes::loops::leaf;
use crate::shapes::polygon::PlanarPolygon;
use crate::stats::Stats;
use glam::DVec3;
use polycsg::Region;

/// What a differential area sees of a target: a region of the target's plane, and where it lies in space.
#[derive(Clone, Debug)]
pub struct VisiblePart {
    region: Region,
    target: PlanarPolygon,
}

impl VisiblePart {
    /// The part in two of the three coordinates: the axis along which the target's normal is longest is dropped, and the
    /// other two are in the order that keeps a target counter-clockwise that is so seen from its front.
    #[must_use]
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// The rings in space, outer ones counter-clockwise seen from the front. Vertices of the target are what they were.
    pub fn rings(&self) -> impl Iterator<Item = Vec<DVec3>> + '_ {
        self.region.rings().map(|ring| ring.iter().map(|p| self.target.raise(*p)).collect())
    }

    /// Its area in space.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.region.area() * self.target.steepness()
    }
}

/// The part of the target's front that the differential area sees, as a valid region with holes and islands.
#[must_use]
pub fn visible_part(from: &DifferentialArea, to: &PlanarPolygon, occluders: &[PlanarPolygon]) -> VisiblePart {
    VisiblePart { region: visible_region(from, to, occluders), target: to.clone() }
}

fn visible_region(from: &DifferentialArea, to: &PlanarPolygon, occluders: &[PlanarPolygon]) -> Region {
    let Some(view) = View::new(from, to) else {
        return Region::default();
    };
    match shadows(&view, occluders, &mut Stats::default()) {
        Shadows::Total => Region::default(),
        Shadows::Some(shadows, _) => (leaf(&view.flat) - union(&shadows)).evaluate(),
    }
}
