//! Planes as thick as roundings and deviation make them.
//!
//! Form factors between areas are computed in doubles, and what is given was rounded before: polygons of one wall, or the corners of
//! a box that was turned, are off a common plane by some roundings. Here they count as on it. The bounds of proven factors have
//! strips of this width around all edges.
use crate::numeric::rounding::rounding_of;
use crate::shapes::polygon::PlanarPolygon;
use glam::DVec3;
use std::cmp::Ordering;

/// A polygon's plane with its thickness to either side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    on: DVec3,
    normal: DVec3,
    pub(crate) thickness: f64,
}

impl Slab {
    pub(crate) fn of(polygon: &PlanarPolygon) -> Self {
        let points = polygon.points();
        let thickness = rounding_of(points.iter().copied()) + polygon.deviation();
        Self { on: points[0], normal: polygon.normal(), thickness }
    }

    /// On which side of the plane a point lies: before it, behind it, or on it but for roundings.
    pub(crate) fn side_of(&self, point: DVec3) -> Ordering {
        let height = self.normal.dot(point - self.on);
        if height.abs() <= self.thickness.max(rounding_of([point])) {
            Ordering::Equal
        } else {
            height.total_cmp(&0.0)
        }
    }

    /// Whether all of a polygon lies on the plane.
    pub(crate) fn has(&self, polygon: &PlanarPolygon) -> bool {
        polygon.points().iter().all(|p| self.side_of(*p).is_eq())
    }
}
