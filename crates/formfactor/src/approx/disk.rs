//! The target as one disk.
use super::{method::Method, parts::pieces};
use crate::scene::enclosure::Enclosure;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use glam::DVec3;
use std::f64::consts::PI;

/// Replaces the target by a disk of equal area about its centroid [Barreto 2008, (2.2)]:
///
/// F = a^2 cos(theta) cos(theta') / (r^2 + a^2), pi a^2 = A, without visibility.
///
/// It is exact for a disk that dA faces along its axis. The relative error is of second order in size over distance, and no
/// parameter makes it smaller. A centroid below the horizon, or a dA behind the target, gives 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Disk;

impl Method for Disk {
    fn name(&self) -> String {
        "disk".into()
    }

    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64> {
        let seen = |id: &&usize| from.owner() != Some(**id);
        let factor = |id: &usize| {
            let polygon = &enclosure.polygons()[*id];
            let centre = centroid(polygon);
            disk(from.normal(), centre - from.position(), polygon.normal(), polygon.area())
        };
        targets.iter().map(|id| Some(id).filter(seen).map_or(0.0, factor)).collect()
    }
}

fn centroid(polygon: &PlanarPolygon) -> DVec3 {
    let parts = pieces(polygon);
    let weighted: DVec3 = parts.iter().map(|part| part.area() * part.centre()).sum();
    weighted / parts.iter().map(super::parts::Tile::area).sum::<f64>()
}

/// The form factor to a disk of this area and direction, its centre given relative to dA.
pub(super) fn disk(normal: DVec3, centre: DVec3, facing: DVec3, area: f64) -> f64 {
    let squared = centre.length_squared();
    let (rise, turn) = (normal.dot(centre).max(0.0), (-facing.dot(centre)).max(0.0));
    if squared == 0.0 { 0.0 } else { area * (rise * turn / squared) / (PI * squared + area) }
}
