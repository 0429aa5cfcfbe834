//! A patch in two dimensions.
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};

/// Coordinates on a patch's plane: x along the longest edge of its outer loop, y to the left of x seen from the
/// front, lengths in a power of two near the patch's size, so that every scene is meshed in the same range.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    origin: DVec3,
    x: DVec3,
    y: DVec3,
    unit: f64,
}

impl Frame {
    /// The frame of a polygon.
    pub(crate) fn new(polygon: &PlanarPolygon) -> Frame {
        let (origin, along) = longest_edge(polygon.loops().next().unwrap_or_default());
        let x = along.normalize_or(polygon.normal().any_orthonormal_vector());
        let reach = polygon.loops().flatten().map(|&p| (p - origin).abs().max_element()).fold(0.0, f64::max);
        Frame { origin, x, y: polygon.normal().cross(x), unit: power_of_two(reach) }
    }

    /// The lengths' unit, in the scene's units.
    pub(crate) fn unit(&self) -> f64 {
        self.unit
    }

    /// A point of the plane, in the frame.
    pub(crate) fn flatten(&self, place: DVec3) -> DVec2 {
        let arm = (place - self.origin) / self.unit;
        DVec2::new(arm.dot(self.x), arm.dot(self.y))
    }

    /// A point of the frame, in space.
    pub(crate) fn lift(&self, flat: DVec2) -> DVec3 {
        self.origin + (self.x * flat.x + self.y * flat.y) * self.unit
    }
}

/// Start and direction of the longest edge; of equal ones the first.
fn longest_edge(points: &[DVec3]) -> (DVec3, DVec3) {
    let next = points.iter().cycle().skip(1);
    let mut longest = (points.first().copied().unwrap_or_default(), DVec3::ZERO);
    for (&start, &end) in points.iter().zip(next) {
        if (end - start).length() > longest.1.length() {
            longest = (start, end - start);
        }
    }
    longest
}

/// The power of two at or below a positive length; 1 for what has none.
pub(crate) fn power_of_two(length: f64) -> f64 {
    if length.is_normal() { length.log2().floor().exp2() } else { 1.0 }
}
