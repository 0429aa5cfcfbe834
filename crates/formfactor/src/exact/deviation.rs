//! What the deviation of a polygon's vertices leaves open about one polygon alone: bounds, and no decisions.
//!
//! A polygon whose vertices are not exactly coplanar stands for its vertices moved onto its plane, each by at most its
//! `deviation`. Where a decision is exact for the vertices as given, the moved ones may decide otherwise. Everything here is
//! 0 for triangles and for polygons whose vertices are exactly coplanar.
use super::lambert::{self, Direction};
use crate::form_factor::FormFactor;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use glam::DVec3;

/// The form factor to a target that turns its back or lies below the horizon: 0, but for what deviation leaves open.
pub(crate) fn unseen(from: &DifferentialArea, to: &PlanarPolygon) -> FormFactor {
    let risen = |p: &DVec3| from.normal().dot(*p - from.position()) >= -2.0 * to.deviation();
    let is_certain = to.deviation() == 0.0 || !to.points().iter().any(risen);
    let error_bound = if is_certain { 0.0 } else { of_facing(from.position(), to) };
    FormFactor { value: 0.0, error_bound: error_bound.min(1.0) }
}

/// A bound on what the side on which `position` lies can change: everything when it lies in the polygon, else what the
/// edges sweep.
pub(crate) fn of_facing(position: DVec3, polygon: &PlanarPolygon) -> f64 {
    let deviation = 2.0 * polygon.deviation();
    if deviation == 0.0 {
        return 0.0;
    }
    let (plane, least) = (polygon.plane(), deviation * polygon.plane().normal.round().length());
    if !plane.is_within(position, least) {
        return 0.0;
    }
    let low = polygon.points().iter().fold(polygon.points()[0], |low, p| low.min(*p)) - deviation;
    let high = polygon.points().iter().fold(polygon.points()[0], |high, p| high.max(*p)) + deviation;
    let is_inside = position.cmpge(low).all() && position.cmple(high).all();
    if is_inside { 1.0 } else { swept(position, polygon, deviation) }
}

/// A bound on the form factor of what a polygon's edges sweep when their ends move by `deviation`.
pub(crate) fn swept(position: DVec3, polygon: &PlanarPolygon, deviation: f64) -> f64 {
    let direction = |p: DVec3| Direction { toward: p - position, error: deviation / p.distance(position) };
    polygon.edges().map(|(a, b)| lambert::swept(direction(a), direction(b))).sum()
}
