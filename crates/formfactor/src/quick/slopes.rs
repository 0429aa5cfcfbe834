//! Rectangles around cones, as dA sees them on a plane.
use super::cone::{Edge, size};
use super::interval::{greater, lesser};
use glam::{DVec2, DVec3, Vec3Swizzles};

/// How slopes of directions are measured: two of three coordinates, divided by the depth along one vector.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    forward: DVec3,
    /// The least depth of a direction that leads forward enough, by its size.
    least: f64,
    /// How much larger than its content a rectangle is on each side.
    margin: f64,
    dropped: usize,
}

/// A rectangle of slopes, around the directions to something.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slopes {
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

impl Slopes {
    const ALL: Self = Self { low: DVec2::NEG_INFINITY, high: DVec2::INFINITY };

    pub(super) fn contains(&self, other: &Self) -> bool {
        self.low.cmple(other.low).all() && self.high.cmpge(other.high).all()
    }

    /// Infinite for what has no rectangle.
    pub(super) fn area(&self) -> f64 {
        (self.high - self.low).element_product()
    }

    /// Whether two rectangles meet that have some first slope in common.
    pub(super) fn meets_beside(&self, other: &Self) -> bool {
        self.low.y <= other.high.y && other.low.y <= self.high.y
    }
}

impl Frame {
    /// Slopes by the depth along `forward`, the axis `dropped` left out.
    pub(super) fn new(forward: DVec3, dropped: usize) -> Self {
        let size = size(forward);
        Self { forward, least: 1e-3 * size, margin: 1e-6 / size, dropped }
    }

    /// A small rectangle around the slopes of a cone; everything where one of its corners does not lead forward enough.
    ///
    /// From a thousandth of its largest value on, the depth is known within 2^-40 of itself, and the slopes are below a
    /// thousand by the size of `forward`: 1e-9 of that is far more than their error.
    pub(super) fn around(&self, edges: &[Edge]) -> Slopes {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for edge in edges {
            let Some(slopes) = self.slopes(edge.start) else { return Slopes::ALL };
            low = DVec2::new(lesser(low.x, slopes.x), lesser(low.y, slopes.y));
            high = DVec2::new(greater(high.x, slopes.x), greater(high.y, slopes.y));
        }
        Slopes { low: low - self.margin, high: high + self.margin }
    }

    /// The slopes of a direction that leads forward enough.
    fn slopes(&self, toward: DVec3) -> Option<DVec2> {
        let depth = self.forward.dot(toward);
        let kept = match self.dropped {
            0 => toward.yz(),
            1 => toward.xz(),
            _ => toward.xy(),
        };
        (depth >= self.least * size(toward)).then(|| kept / depth)
    }
}
