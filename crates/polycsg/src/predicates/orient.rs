//! Orientation signs: which side of a line, which turn between two directions.

use super::fixed;
use super::segment::{Segment, Side};
use exactfloat::{integers, orient2d, sign};
use glam::DVec2;
use std::cmp::Ordering;

/// A determinant as a float, and a bound on its distance from the exact one.
///
/// The bound is infinite where an overflow or an underflow may have spoilt the value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Area {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

/// `(3 + 16u)u` with `u = 2^-53`: Shewchuk, "Adaptive precision floating-point arithmetic", 1997, section 4.3.
const RELATIVE_ERROR: f64 = (3.0 + 16.0 * UNIT) * UNIT;
pub(super) const UNIT: f64 = f64::EPSILON / 2.0;
/// Below this sum of products the rounding errors of subnormal products (2^-1074 each) are not covered by the
/// slack `16u² · sum` of the relative bound; at and above it they are.
const SAFE_SUM: f64 = f64::from_bits((1023 - 900) << 52);

impl Area {
    #[inline]
    fn of(l: f64, r: f64) -> Area {
        let sum = l.abs() + r.abs();
        let error = if sum >= SAFE_SUM { RELATIVE_ERROR * sum } else { f64::INFINITY };
        Area { value: l - r, error }
    }

    /// The sign, when the bound proves it.
    #[inline]
    fn certain(self) -> Option<Side> {
        if self.value > self.error {
            Some(Side::Left)
        } else if self.value < -self.error {
            Some(Side::Right)
        } else {
            None
        }
    }
}

/// Twice the signed area of the triangle `a b c`, positive when it runs counter-clockwise.
#[inline]
pub(crate) fn doubled_area(a: DVec2, b: DVec2, c: DVec2) -> Area {
    Area::of((a.x - c.x) * (b.y - c.y), (a.y - c.y) * (b.x - c.x))
}

/// The side of the line from `a` to `b` on which `c` lies.
#[inline]
pub(crate) fn side(a: DVec2, b: DVec2, c: DVec2) -> Side {
    side_of(doubled_area(a, b, c), a, b, c)
}

/// As [`side`], for a caller that already has the [`doubled_area`] of `a b c`.
#[inline]
pub(crate) fn side_of(area: Area, a: DVec2, b: DVec2, c: DVec2) -> Side {
    match area.certain() {
        Some(side) => side,
        None => side_exact(a, b, c),
    }
}

/// Which way direction `g[0] → g[1]` turns from direction `e[0] → e[1]`.
#[inline]
pub(crate) fn turn(e: Segment, g: Segment) -> Side {
    let (d, f) = (e[1] - e[0], g[1] - g[0]);
    match Area::of(d.x * f.y, d.y * f.x).certain() {
        Some(side) => side,
        None => turn_exact(e, g),
    }
}

/// Where a direction points, counter-clockwise from just above straight down: along an axis or into a quadrant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Compass {
    SouthEast,
    East,
    NorthEast,
    North,
    NorthWest,
    West,
    SouthWest,
    South,
}

impl Compass {
    #[inline]
    pub(crate) fn of([start, end]: Segment) -> Compass {
        use Compass::{East, North, NorthEast, NorthWest, South, SouthEast, SouthWest, West};
        const WAYS: [[Compass; 3]; 3] =
            [[SouthWest, West, NorthWest], [South, North, North], [SouthEast, East, NorthEast]];
        let place = |a: f64, b: f64| usize::from(a <= b) + usize::from(a < b);
        WAYS[place(start.x, end.x)][place(start.y, end.y)]
    }

    /// Whether all such directions are one.
    pub(crate) fn is_axis(self) -> bool {
        matches!(self, Compass::East | Compass::North | Compass::West | Compass::South)
    }
}

/// The sign of `l - r` from the signs of the four factors `l = p q`, `r = s t`, where those suffice.
fn sign_of_difference(p: Ordering, q: Ordering, s: Ordering, t: Ordering) -> Option<Side> {
    let (l, r) = (p as i8 * q as i8, s as i8 * t as i8);
    (l != r || l == 0).then(|| Side::from(l.cmp(&r)))
}

/// IEEE comparison of finite numbers.
fn compare(a: f64, b: f64) -> Ordering {
    a.partial_cmp(&b).unwrap_or(Ordering::Equal)
}

#[cold]
fn side_exact(a: DVec2, b: DVec2, c: DVec2) -> Side {
    let by_signs =
        sign_of_difference(compare(a.x, c.x), compare(b.y, c.y), compare(a.y, c.y), compare(b.x, c.x));
    if let Some(side) = by_signs {
        return side;
    }
    Side::from(compare(orient2d(a.to_array(), b.to_array(), c.to_array()), 0.0))
}

#[cold]
fn turn_exact(e: Segment, g: Segment) -> Side {
    let by_signs = sign_of_difference(
        compare(e[1].x, e[0].x),
        compare(g[1].y, g[0].y),
        compare(e[1].y, e[0].y),
        compare(g[1].x, g[0].x),
    );
    by_signs.or_else(|| fixed::turn(e, g)).unwrap_or_else(|| {
        let [[ax, ay], [bx, by], [cx, cy], [dx, dy]] =
            integers([e[0], e[1], g[0], g[1]].map(|p| p.to_array()));
        Side::from(sign(&((bx - ax) * (dy - cy) - (by - ay) * (dx - cx))))
    })
}
