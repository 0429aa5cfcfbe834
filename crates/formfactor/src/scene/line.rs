//! Lines of sight: whether a polygon stands between two places.
use crate::numeric::predicates::turn;
use crate::shapes::{extent::Extent, polygon::PlanarPolygon};
use glam::DVec3;
use std::cmp::Ordering;

/// The way from one place to another.
#[derive(Debug)]
pub(crate) struct LineOfSight {
    start: DVec3,
    end: DVec3,
    /// Some place beside the line.
    beside: DVec3,
    /// Around both ends.
    extent: Extent,
}

impl LineOfSight {
    pub(crate) fn between(start: DVec3, end: DVec3) -> Self {
        let way = (end - start).abs();
        // The axis along which the line runs least.
        let axis = if way.x <= way.y && way.x <= way.z {
            DVec3::X
        } else if way.y <= way.z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let beside = start + way.max_element() * axis;
        Self { start, end, beside, extent: Extent::around(&[start, end]) }
    }

    /// Whether nothing in a box can stand in the way.
    pub(crate) fn misses_box(&self, extent: &Extent) -> bool {
        extent.misses(&self.extent) || extent.misses_ray(self.start, self.end - self.start)
    }

    /// Whether the polygon meets the way strictly between its ends.
    pub(crate) fn is_blocked_by(&self, polygon: &PlanarPolygon) -> bool {
        let [here, there] = [self.start, self.end].map(|p| polygon.plane().side_of(p));
        here != Ordering::Equal && there == here.reverse() && self.passes_inside(polygon)
    }

    /// Whether the line passes an odd number of loops.
    ///
    /// ```text
    ///   a         Seen along the line, the half-plane to `beside` is a ray: the line is inside where that crosses an odd number of
    ///    \        edges. An end on the ray counts as below it: edges that polygons share are crossed alike from both.
    /// o---\--▶
    ///      b
    /// ```
    fn passes_inside(&self, polygon: &PlanarPolygon) -> bool {
        let is_above = |p: DVec3| turn(self.start, self.end, self.beside, p) == Ordering::Greater;
        let crosses = |(a, b): &(DVec3, DVec3)| {
            let (from, to) = (is_above(*a), is_above(*b));
            from != to && (turn(self.start, self.end, *a, *b) == Ordering::Greater) == to
        };
        polygon.edges().filter(crosses).count() % 2 == 1
    }
}
