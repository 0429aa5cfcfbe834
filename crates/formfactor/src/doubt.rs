//! What rounding leaves open about polygons whose vertices are not exactly coplanar: bounds, and no decisions.
//!
//! Such a polygon stands for its vertices moved onto its plane, each by at most its `deviation`. Where a decision is
//! exact for the vertices as given, the moved ones may decide otherwise. Everything here is 0 for triangles and for
//! polygons whose vertices are exactly coplanar.
use crate::horizon::Vertex;
use crate::lambert::{self, Sight};
use crate::region::leaf;
use crate::view::View;
use crate::visible::boundary_sum;
use crate::{DifferentialArea, PlanarPolygon};
use glam::{DVec2, DVec3};
use polycsg::Scratch;

/// Of a target that turns its back or lies below the horizon.
pub(crate) fn of_unseen(from: &DifferentialArea, to: &PlanarPolygon) -> f64 {
    let risen = |p: &DVec3| from.normal().dot(*p - from.position()) >= -2.0 * to.deviation();
    if to.deviation() == 0.0 || !to.points().iter().any(risen) { 0.0 } else { of_facing(from.position(), to) }
}

/// Of the side on which `position` lies: everything when it lies in the polygon, else what the edges sweep.
pub(crate) fn of_facing(position: DVec3, polygon: &PlanarPolygon) -> f64 {
    let doubt = 2.0 * polygon.deviation();
    if doubt == 0.0 {
        return 0.0;
    }
    let height = polygon.plane().side(position).value.hi.abs();
    if height > doubt * polygon.plane().normal.round().length() {
        return 0.0;
    }
    let low = polygon.points().iter().fold(polygon.points()[0], |low, p| low.min(*p)) - doubt;
    let high = polygon.points().iter().fold(polygon.points()[0], |high, p| high.max(*p)) + doubt;
    let inside = position.cmpge(low).all() && position.cmple(high).all();
    if inside { 1.0 } else { polygon.edges().map(|(a, b)| swept(position, a, b, doubt)).sum() }
}

/// Of a polygon that touches the plane of dA and the target's edge from `a` to `b`: a band along the edge.
pub(crate) fn of_touch(view: &View, a: DVec3, b: DVec3, occluder: &PlanarPolygon) -> f64 {
    let (position, slack) = (view.from.position(), occluder.deviation() + view.to.deviation());
    if slack == 0.0 {
        return 0.0;
    }
    let reached = occluder.points().iter().chain([&a, &b]).map(|p| p.distance(position));
    let blur = 2.0 * slack / reached.fold(f64::INFINITY, f64::min);
    let sight = |p: DVec3| Sight { toward: p - position, blur };
    lambert::swept(sight(a), sight(b))
}

/// Of a polygon that touches the target's plane, or is coplanar with it but for rounding.
pub(crate) fn of_contact(view: &View, occluder: &PlanarPolygon) -> f64 {
    let doubt = height(view, occluder);
    if doubt == 0.0 || !occluder.points().iter().any(|p| is_within(view, *p, doubt)) {
        return 0.0;
    }
    if is_coplanar(view, occluder) {
        return overlap(view, occluder);
    }
    let slack = slack_at_target(view, occluder);
    occluder.edges().map(|(a, b)| swept(view.from.position(), a, b, slack)).sum()
}

/// Adds to vertices on the target's plane how far the line may be where the occluder meets it.
pub(crate) fn loosen(view: &View, occluder: &PlanarPolygon, loops: &mut [Vec<Vertex>]) {
    let doubt = height(view, occluder);
    if doubt > 0.0 {
        let slack = slack_at_target(view, occluder);
        let at_target =
            |v: &&mut Vertex| v.given.is_none_or(|i| is_within(view, occluder.points()[i], doubt));
        loops.iter_mut().flatten().filter(at_target).for_each(|v| v.slack += slack);
    }
}

/// Whether an occluder may be coplanar with the target: it then counts as if it were.
pub(crate) fn is_coplanar(view: &View, occluder: &PlanarPolygon) -> bool {
    let doubt = height(view, occluder);
    doubt > 0.0 && occluder.points().iter().all(|p| is_within(view, *p, doubt))
}

/// Whether a point is no higher over the target's plane, on either side.
fn is_within(view: &View, point: DVec3, height: f64) -> bool {
    view.to.plane().side(point).value.hi.abs() <= height
}

/// How far off the two polygons' vertices may be, as a height over the target's plane.
fn height(view: &View, occluder: &PlanarPolygon) -> f64 {
    2.0 * (view.to.deviation() + occluder.deviation()) * view.to.plane().normal.round().length()
}

/// How far the line may be where the two planes meet: the vertices' deviation over the sine of the planes' angle.
fn slack_at_target(view: &View, occluder: &PlanarPolygon) -> f64 {
    let sine = view.to.normal().cross(occluder.normal()).length();
    4.0 * (view.to.deviation() + occluder.deviation()) / sine
}

/// The form factor of the part of the target that a polygon in its plane overlaps.
fn overlap(view: &View, polygon: &PlanarPolygon) -> f64 {
    let flat: Vec<Vec<DVec2>> =
        polygon.loops().map(|l| l.iter().map(|p| view.to.flat(*p)).collect()).collect();
    let common = leaf(&view.flat) & leaf(&flat);
    let factor = boundary_sum(view, &common, &mut Scratch::default()).form_factor(0.0);
    let slack = 2.0 * polygon.deviation();
    let edges = polygon.edges().map(|(a, b)| swept(view.from.position(), a, b, slack));
    factor.value + factor.error_bound + edges.sum::<f64>()
}

/// What an edge sweeps whose ends move by `slack`.
fn swept(position: DVec3, a: DVec3, b: DVec3, slack: f64) -> f64 {
    let sight = |p: DVec3| Sight { toward: p - position, blur: slack / p.distance(position) };
    lambert::swept(sight(a), sight(b))
}
