//! The part of an edge inside a cone: what an occluder hides of it, or what the target's cone leaves of it.
use super::cone::{Edge, NEAR, OneCone, UNDERFLOW};
use super::interval::{Interval, Parameter, greater};
use crate::exact::lambert::{Direction, swept};
use crate::numeric::rounding::ROUNDING;
use glam::DVec3;

/// What of an edge is inside a cone.
#[derive(Clone, Copy, Debug)]
pub(super) enum Inside {
    /// Nothing, for certain.
    Nothing,
    /// One interval: a cone is convex. Both ends may be uncertain.
    Part(Interval),
    /// One interval of an edge that lies along one of the cone's own, which runs the same way or the other way. What is between the two
    /// has a form factor of at most `error`.
    Along { part: Interval, is_same_way: bool, error: f64 },
    /// It may lie in one of the planes, so that the error of a parameter has no bound.
    Open,
}

/// An edge whose ends differ by this many times their error crosses a plane.
pub(super) const CLEAR: f64 = 16.0;
/// By how much the error of a parameter exceeds that of the depths by their difference: 16/15, and roundings.
const SHARE: f64 = 1.07;

/// What of `edge`, one of the edges of the cone `own`, is inside the cone that `planes` bound, by clipping it against one plane after the
/// other.
pub(super) fn inside(edge: &Edge, own: OneCone<'_>, planes: &[Edge]) -> Inside {
    let mut left = Interval::WHOLE;
    // Whether it may lie in a plane; whether it lies along edges that run the other way, and the same way.
    let (mut is_open, mut ways) = (false, [false; 2]);
    for plane in planes {
        // Before anything else is decided of the two: both must take each other for one, or neither.
        if is_along(edge, plane) {
            ways[usize::from(is_same_way(edge, plane))] = true;
            continue;
        }
        let [start, end] = [edge.start, edge.end].map(|p| plane.inward.dot(p));
        // A coarse bound on the error decides for most planes.
        let coarse = plane.error * own.spread.reach + UNDERFLOW;
        if start > coarse && end > coarse {
            continue;
        }
        if start < -coarse && end < -coarse {
            return Inside::Nothing;
        }
        let error = larger_error(edge, plane);
        let [start_on, end_on] = [edge.start, edge.end].map(|p| is_end(p, plane));
        if (start > error || start_on) && (end > error || end_on) {
            continue;
        }
        if (start < -error || start_on) && (end < -error || end_on) {
            return Inside::Nothing;
        }
        let across = start - end;
        if across.abs() <= CLEAR * error {
            // Nearly parallel to the plane and close to it: no crossing can be told.
            is_open = true;
        } else if across > 0.0 {
            left.high = left.high.first(crossing(edge, plane, [start, end]));
        } else {
            left.low = left.low.last(crossing(edge, plane, [start, end]));
        }
    }
    match ways {
        _ if left.is_empty() => Inside::Nothing,
        _ if is_open => Inside::Open,
        [false, false] => Inside::Part(left),
        // A cone that has it both ways has no width.
        [true, true] => Inside::Open,
        _ if is_thin(edge, own.edges, planes) => Inside::Open,
        [_, is_same_way] => Inside::Along { part: left, is_same_way, error: between(edge, left, planes) },
    }
}

fn is_same_way(edge: &Edge, plane: &Edge) -> bool {
    edge.inward.dot(plane.inward) > 0.0
}

/// Whether either cone is so thin where two edges lie along each other that taking them for one might turn it over.
fn is_thin(edge: &Edge, own: &[Edge], planes: &[Edge]) -> bool {
    let along = planes.iter().filter(|plane| is_along(edge, plane));
    let mut ways = along.map(|plane| (plane, is_same_way(edge, plane)));
    ways.any(|(plane, is_same_way)| {
        !stands_clear(own, plane, is_same_way) || !stands_clear(planes, edge, is_same_way)
    })
}

/// Whether a cone is clearly on one side of a plane, but for its edges along it: inside, if these run the same way.
fn stands_clear(cone: &[Edge], plane: &Edge, is_inside: bool) -> bool {
    let runs_beside = |edge: &Edge| is_along(edge, plane) && is_same_way(edge, plane) == is_inside;
    let is_beside = |corner: DVec3| {
        cone.iter().any(|edge| (edge.start == corner || edge.end == corner) && runs_beside(edge))
    };
    let is_clear = |corner: DVec3| {
        let (depth, error) = plane.depth(corner);
        if is_inside { depth > NEAR * error } else { depth < -NEAR * error }
    };
    let mut corners = cone.iter().map(|edge| edge.start);
    corners.clone().any(is_clear) && corners.all(|corner| is_clear(corner) || is_beside(corner))
}

/// An end of a plane's own edge lies in the plane, whatever is rounded.
fn is_end(point: DVec3, plane: &Edge) -> bool {
    point == plane.start || point == plane.end
}

/// Whether one of two edges lies in the plane of the other one but for roundings: the same for both orders.
pub(super) fn is_along(one: &Edge, other: &Edge) -> bool {
    lies_in(one, other) || lies_in(other, one)
}

fn lies_in(edge: &Edge, plane: &Edge) -> bool {
    [edge.start, edge.end].iter().all(|end| {
        let (depth, error) = plane.depth(*end);
        depth.abs() <= NEAR * error || is_end(*end, plane)
    })
}

/// A bound on the form factor of what is between a part of an edge and the planes that it is along. Large where one of them has an edge so
/// short that its plane leads anywhere.
fn between(edge: &Edge, part: Interval, planes: &[Edge]) -> f64 {
    let off = |plane: &Edge, at: f64| {
        let toward = edge.start + edge.along * at;
        let (depth, error) = plane.depth(toward);
        let angle = (depth.abs() + error) / (plane.inward.length() * toward.length());
        Direction { toward, error: if is_end(toward, plane) { 0.0 } else { angle } }
    };
    let gap = |plane: &Edge| {
        let [start, end] = [part.low, part.high].map(|mark| off(plane, mark.at.clamp(0.0, 1.0)));
        // Where the neighbours of an end meet the other line counts, too.
        swept(start, end) + start.error + end.error
    };
    planes.iter().filter(|plane| is_along(edge, plane)).map(gap).sum()
}

/// Where an edge crosses a plane, its ends' depths given, which differ by more than `CLEAR` times their error.
///
/// The parameter t = s / (s - e) of a crossing, from the depths s and e of start and end, errs by at most the larger one
/// of their errors by |s - e|, 16/15 times since s - e itself is known to a sixteenth only, and by the roundings of t.
#[inline]
pub(super) fn crossing(edge: &Edge, plane: &Edge, [start, end]: [f64; 2]) -> Parameter {
    let across = start - end;
    let error = SHARE * larger_error(edge, plane) / across.abs() + 4.0 * ROUNDING;
    Parameter { at: start / across, error }
}

/// A bound on the errors of how far inside a plane the ends of an edge are.
#[inline]
fn larger_error(edge: &Edge, plane: &Edge) -> f64 {
    let larger = |a: f64, b: f64| greater(a.abs(), b.abs());
    let (a, b, errors) = (edge.start, edge.end, plane.errors);
    errors.x * larger(a.x, b.x) + errors.y * larger(a.y, b.y) + errors.z * larger(a.z, b.z) + UNDERFLOW
}
