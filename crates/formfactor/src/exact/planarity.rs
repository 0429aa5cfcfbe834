//! What the deviation of vertices leaves open about a target and an occluder that touch: bounds, and no decisions.
//!
//! An occluder that is coplanar with the target, or that touches its plane or the plane of dA and one of its edges, is
//! decided upon as its vertices are given. Moved onto its plane it may block a little. All bounds are 0 where neither
//! polygon has a deviation.
use super::lambert::{self, Direction};
use super::{deviation::swept, horizon::Vertex, view::View};
use crate::shapes::{loops::leaf, polygon::PlanarPolygon};
use glam::{DVec2, DVec3};
use polycsg::Scratch;

/// A bound for an occluder that touches the plane of dA and the target's edge from `a` to `b`: a band along the edge.
pub(crate) fn of_touch(view: &View, a: DVec3, b: DVec3, occluder: &PlanarPolygon) -> f64 {
    let (position, deviation) = (view.from.position(), occluder.deviation() + view.to.deviation());
    if deviation == 0.0 {
        return 0.0;
    }
    let reached = occluder.points().iter().chain([&a, &b]).map(|p| p.distance(position));
    let error = 2.0 * deviation / reached.fold(f64::INFINITY, f64::min);
    let direction = |p: DVec3| Direction { toward: p - position, error };
    lambert::swept(direction(a), direction(b))
}

/// A bound for an occluder that touches the target's plane, or is coplanar with it but for its deviation.
pub(crate) fn of_contact(view: &View, occluder: &PlanarPolygon) -> f64 {
    if is_coplanar(view.to, occluder) {
        return overlap(view, occluder);
    }
    match at_target(view.to, occluder) {
        0.0 => 0.0,
        moved => swept(view.from.position(), occluder, moved),
    }
}

/// Adds to vertices on the target's plane how far the line may be where the occluder meets it.
pub(crate) fn loosen(view: &View, occluder: &PlanarPolygon, loops: &mut [Vec<Vertex>]) {
    let height = deviation_height(view.to, occluder);
    if height > 0.0 {
        let deviation = deviation_at_target(view.to, occluder);
        let at_target =
            |v: &&mut Vertex| v.given.is_none_or(|i| view.to.plane().is_within(occluder.points()[i], height));
        loops.iter_mut().flatten().filter(at_target).for_each(|v| v.deviation += deviation);
    }
}

/// Whether an occluder may be coplanar with the target: it then counts as if it were.
pub(crate) fn is_coplanar(to: &PlanarPolygon, occluder: &PlanarPolygon) -> bool {
    let height = deviation_height(to, occluder);
    height > 0.0 && occluder.points().iter().all(|p| to.plane().is_within(*p, height))
}

/// How far the line may be where an occluder meets the target's plane; 0 where none of its vertices is at the plane.
pub(crate) fn at_target(to: &PlanarPolygon, occluder: &PlanarPolygon) -> f64 {
    let height = deviation_height(to, occluder);
    if height == 0.0 || !occluder.points().iter().any(|p| to.plane().is_within(*p, height)) {
        return 0.0;
    }
    deviation_at_target(to, occluder)
}

/// How far off the two polygons' vertices may be, as a height over the target's plane.
fn deviation_height(to: &PlanarPolygon, occluder: &PlanarPolygon) -> f64 {
    2.0 * (to.deviation() + occluder.deviation()) * to.plane().normal.round().length()
}

/// How far the line may be where the two planes meet: the vertices' deviation over the sine of the planes' angle.
fn deviation_at_target(to: &PlanarPolygon, occluder: &PlanarPolygon) -> f64 {
    let sine = to.normal().cross(occluder.normal()).length();
    4.0 * (to.deviation() + occluder.deviation()) / sine
}

/// The form factor of the part of the target that a polygon in its plane overlaps.
fn overlap(view: &View, polygon: &PlanarPolygon) -> f64 {
    let flat: Vec<Vec<DVec2>> =
        polygon.loops().map(|l| l.iter().map(|p| view.flat_of(*p)).collect()).collect();
    let common = leaf(&view.flat) & leaf(&flat);
    let factor = view.sum_over(&common, &mut Scratch::default()).form_factor(0.0);
    factor.value + factor.error_bound + swept(view.from.position(), polygon, 2.0 * polygon.deviation())
}
