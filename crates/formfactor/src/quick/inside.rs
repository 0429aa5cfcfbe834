//! The part of an edge inside a cone: what an occluder hides of it, or what the target's cone leaves of it.
use super::cone::{Edge, UNDERFLOW};
use super::interval::{Interval, Parameter, greater};
use crate::numeric::rounding::ROUNDING;

/// What of an edge is inside a cone.
#[derive(Clone, Copy, Debug)]
pub(super) enum Inside {
    /// Nothing, for certain.
    Nothing,
    /// One interval: a cone is convex. Both ends may be uncertain.
    Part(Interval),
    /// The edge is one of the cone's own, run along the same way or the other way.
    Twin { is_same_way: bool },
    /// It may lie in one of the planes, so that the error of a parameter has no bound.
    Open,
}

/// An edge whose ends differ by this many times their error crosses a plane.
pub(super) const CLEAR: f64 = 16.0;
/// By how much the error of a parameter exceeds that of the depths by their difference: 16/15, and roundings.
const SHARE: f64 = 1.07;

/// What of `edge` is inside the cone that `planes` bound, by clipping it against one plane after the other. `reach` is at least the
/// size of its ends.
pub(super) fn inside(edge: &Edge, reach: f64, planes: &[Edge]) -> Inside {
    let mut left = Interval::WHOLE;
    // Whether it may lie in a plane; whether it is one of the cone's own edges, run the other way, and run the same way.
    let (mut is_open, mut twins) = (false, [false; 2]);
    for plane in planes {
        let [start, end] = [edge.start, edge.end].map(|p| plane.inward.dot(p));
        // A coarse bound on the error decides for most planes.
        let coarse = plane.error * reach + UNDERFLOW;
        if start > coarse && end > coarse {
            continue;
        }
        if start < -coarse && end < -coarse {
            return Inside::Nothing;
        }
        let error = larger_error(edge, plane);
        if start > error && end > error {
            continue;
        }
        if start < -error && end < -error {
            return Inside::Nothing;
        }
        let across = start - end;
        if across.abs() <= CLEAR * error {
            // Nearly parallel to the plane and close to it: no crossing can be told.
            is_open = true;
            if let Some(is_same_way) = twin(edge, plane) {
                twins[usize::from(is_same_way)] = true;
            }
        } else if across > 0.0 {
            left.high = left.high.first(crossing(edge, plane, [start, end]));
        } else {
            left.low = left.low.last(crossing(edge, plane, [start, end]));
        }
    }
    if left.is_empty() {
        return Inside::Nothing;
    }
    match (is_open, twins) {
        (false, _) => Inside::Part(left),
        (true, [false, true]) => Inside::Twin { is_same_way: true },
        (true, [true, false]) => Inside::Twin { is_same_way: false },
        // It is no edge of the cone, or one that the cone has both ways, as rounding left the cone no width.
        (true, _) => Inside::Open,
    }
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

/// Whether two edges are the same, and then whether they run the same way.
fn twin(edge: &Edge, other: &Edge) -> Option<bool> {
    if edge.start == other.start && edge.end == other.end {
        return Some(true);
    }
    (edge.start == other.end && edge.end == other.start).then_some(false)
}
