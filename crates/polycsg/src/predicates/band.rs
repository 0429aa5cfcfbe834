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

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use proptest::prelude::*;

    fn exact(x: f64) -> BigRational {
        BigRational::from_float(x).expect("a finite number")
    }

    fn product(a: DVec2, b: DVec2) -> BigRational {
        exact(a.x) * exact(b.x) + exact(a.y) * exact(b.y)
    }

    fn corners(window: &Window) -> [DVec2; 4] {
        let Window { low, high, .. } = *window;
        [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]
    }

    fn check(points: &[DVec2], [a, b]: [DVec2; 2]) -> Result<(), TestCaseError> {
        let window = Window::new(a.min(b), a.max(b));
        let direction = points[points.len() - 1] - points[0];
        let band = Band::along(direction, points);
        if band.misses(&window) {
            let normal = band.normal;
            let of_points: Vec<_> = points.iter().map(|&p| product(normal, p)).collect();
            let of_window = corners(&window).map(|p| product(normal, p));
            let (low, high) = (of_points.iter().min(), of_points.iter().max());
            prop_assert!(
                of_window.iter().max() < low || of_window.iter().min() > high,
                "{band:?} {window:?}"
            );
        }
        let [p, q] = [points[0], points[1]];
        let cross = |c: DVec2| {
            (exact(q.x) - exact(p.x)) * (exact(c.y) - exact(p.y))
                - (exact(q.y) - exact(p.y)) * (exact(c.x) - exact(p.x))
        };
        let zero = exact(0.0);
        let sides = corners(&window).map(|c| cross(c).cmp(&zero));
        let beside = sides.iter().all(|side| side.is_lt()) || sides.iter().all(|side| side.is_gt());
        prop_assert_eq!(window.is_beside([p, q]), beside, "{:?} {:?}", [p, q], window);
        Ok(())
    }

    fn near() -> impl Strategy<Value = DVec2> {
        // On a line but for some last bits, so that rounding decides.
        (-40..40_i32, -3..4_i64, -3..4_i64).prop_map(|(t, x, y)| {
            let ulps = |v: f64, n: i64| f64::from_bits(v.to_bits().wrapping_add_signed(n));
            DVec2::new(ulps(1.0 + f64::from(t) / 64.0, x), ulps(1.5 + f64::from(t) / 192.0, y))
        })
    }

    fn anywhere() -> impl Strategy<Value = DVec2> {
        let number = prop_oneof![prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL, Just(0.0), -4.0..4.0];
        prop::array::uniform2(number).prop_map(DVec2::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn what_is_told_is_so_over_the_whole_range(points in prop::collection::vec(anywhere(), 2..6), ends in prop::array::uniform2(anywhere())) {
            check(&points, ends)?;
        }

        #[test]
        fn what_is_told_is_so_near_a_line(points in prop::collection::vec(near(), 2..6), ends in prop::array::uniform2(near())) {
            check(&points, ends)?;
        }
    }
}
