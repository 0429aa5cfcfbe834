//! What rises so little above the horizon that it does not count.
//!
//! From a face of a mesh its neighbours are edge-on but for roundings, and edges of a wall lie in the horizon of its points. What rises
//! above the horizon by a sine of s at most has a form factor of at most s^2: far below all roundings, if s is a few of them.
use super::cone::{Corner, size};
use super::interval::greater;
use crate::numeric::{predicates::place, rounding::ROUNDING};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use glam::DVec3;
use std::cmp::Ordering;

/// How far above the horizon a target is cut off, as a share of its distance: far more than roundings.
const LIFT: f64 = 9.094_947_017_729_282e-13;
/// What is left out at a cut is far less than what roundings leave open.
const LEFT_OUT: f64 = 1e-18;

/// Where a target that passes the horizon is cut off.
#[derive(Clone, Copy, Debug)]
pub(super) struct Band {
    /// How high, along the given normal.
    pub(super) height: f64,
    /// A bound on the form factor of what is left out.
    pub(super) error: f64,
}

impl Band {
    /// Edges in the horizon are clear of its upper end. None where too much would be left out.
    pub(super) fn above(from: &DifferentialArea, to: &PlanarPolygon, corners: &[Corner]) -> Option<Self> {
        let reach = corners.iter().fold(0.0, |reach, corner| greater(reach, size(corner.at)));
        let height = LIFT * reach * from.given_normal().length();
        let error = most(to, corners[0].at, reach, 2.0 * LIFT * reach)?;
        (error <= LEFT_OUT).then_some(Self { height, error })
    }
}

/// A bound on the form factor of a piece of a polygon, which is little where it hardly rises above the horizon: 0 where it does not, decided
/// exactly where its vertices are. None where dA may be in its plane.
pub(crate) fn most_seen(from: &DifferentialArea, (to, piece): (&PlanarPolygon, &[DVec3])) -> Option<f64> {
    let (up, origin) = (from.given_normal(), from.position());
    let is_above = |p: &DVec3| place(up, origin, *p) == Ordering::Greater;
    if to.deviation() == 0.0 && !piece.iter().any(is_above) {
        return Some(0.0);
    }
    let reach = piece.iter().fold(0.0, |reach, p| greater(reach, size(*p - origin)));
    let heights = piece.iter().map(|p| up.dot(*p - origin) / up.length());
    let risen = heights.fold(f64::NEG_INFINITY, f64::max) + 16.0 * ROUNDING * reach + to.deviation();
    if risen < 0.0 { Some(0.0) } else { most(to, piece[0] - origin, reach, risen) }
}

/// A bound on the form factor of what rises no higher than `risen`, of a target no farther than `reach` with a corner `at` a place relative to
/// dA; none where dA may be in its plane.
fn most(to: &PlanarPolygon, at: DVec3, reach: f64, risen: f64) -> Option<f64> {
    let nearest = to.normal().dot(at).abs() - 16.0 * ROUNDING * reach - to.deviation();
    let sine = risen / nearest;
    (nearest > 0.0).then_some(sine * sine)
}
