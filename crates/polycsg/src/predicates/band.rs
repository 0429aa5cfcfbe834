//! Filters for index structures: whether points certainly lie on one side of a box.

use super::orient::{UNIT, side};
use super::segment::{Segment, Side};
use glam::DVec2;

/// An axis-parallel box with its sides, that questions are asked about.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
    /// What a rounded product of a normal with one of its points may be off.
    error: f64,
}

/// What lies between two parallel lines: the points whose products with `normal` are in `from..=to`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Band {
    normal: DVec2,
    from: f64,
    to: f64,
}

/// A bound on the error of `n.x * p.x + n.y * p.y`, for a normal whose components are 1 at most.
///
/// The two products and their sum are rounded, which makes `2u (|x| + |y|)`, and `2^-1074` where a product underflows. The
/// bound is four times that, so that it covers its own rounding and that of adding it. It may be infinite.
fn error_of(p: DVec2) -> f64 {
    8.0 * UNIT * (p.x.abs() + p.y.abs()) + f64::MIN_POSITIVE
}

impl Window {
    pub(crate) fn new(low: DVec2, high: DVec2) -> Window {
        Window { low, high, error: error_of(low.abs().max(high.abs())) }
    }

    /// The outer half-planes of the box's sides that a box lies in, a bit for each.
    #[inline]
    pub(crate) fn outer_sides(&self, low: DVec2, high: DVec2) -> u8 {
        u8::from(high.x < self.low.x)
            | u8::from(low.x > self.high.x) << 1
            | u8::from(high.y < self.low.y) << 2
            | u8::from(low.y > self.high.y) << 3
    }

    /// Whether the box lies on one side of the line through an edge.
    pub(crate) fn is_beside(&self, [a, b]: Segment) -> bool {
        let [leftmost, rightmost] = self.extremes(b.x > a.x, b.y > a.y);
        side(a, b, rightmost) == Side::Left || side(a, b, leftmost) == Side::Right
    }

    /// The corners furthest to the left and to the right of a direction that leads to the right or not, and up or not.
    #[inline]
    fn extremes(&self, right: bool, up: bool) -> [DVec2; 2] {
        let x = if up { [self.low.x, self.high.x] } else { [self.high.x, self.low.x] };
        let y = if right { [self.high.y, self.low.y] } else { [self.low.y, self.high.y] };
        [DVec2::new(x[0], y[0]), DVec2::new(x[1], y[1])]
    }
}

impl Band {
    pub(crate) const PLANE: Band = Band { normal: DVec2::ZERO, from: f64::NEG_INFINITY, to: f64::INFINITY };

    /// The narrowest band along a direction around points.
    pub(crate) fn along(direction: DVec2, points: &[DVec2]) -> Band {
        let normal = direction.perp() / direction.abs().max_element();
        if !normal.is_finite() {
            return Band::PLANE;
        }
        let grown = |(from, to, size): (f64, f64, DVec2), &p: &DVec2| {
            let product = normal.x * p.x + normal.y * p.y;
            (product.min(from), product.max(to), p.abs().max(size))
        };
        let (from, to, size) = points.iter().fold((f64::INFINITY, f64::NEG_INFINITY, DVec2::ZERO), grown);
        Band { normal, from: from - error_of(size), to: to + error_of(size) }
    }

    /// The narrower of two bands.
    pub(crate) fn narrower(self, other: Band) -> Band {
        let width = |band: Band| (band.to - band.from) / band.normal.length();
        if width(other) < width(self) { other } else { self }
    }

    /// Whether a box certainly has no point in the band.
    #[inline]
    pub(crate) fn misses(&self, window: &Window) -> bool {
        let normal = self.normal;
        // Left of the band's direction is where the normal points.
        let [leftmost, rightmost] = window.extremes(normal.y > 0.0, normal.x < 0.0);
        let product = |p: DVec2| normal.x * p.x + normal.y * p.y;
        product(leftmost) + window.error < self.from || product(rightmost) - window.error > self.to
    }
}
