//! The part of an edge inside a cone: what an occluder hides of it, or what the target's cone leaves of it.
use super::cone::{Edge, Place};
use super::interval::{Interval, Parameter};
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
}

/// An edge whose ends differ by this many times their error crosses a plane.
const CLEAR: f64 = 16.0;

/// What of `edge` is inside the cone that `planes` bound, by clipping it against one plane after the other. `None` says that
/// the edge may lie in one of the planes, so that the error of a parameter has no bound.
///
/// The parameter t = s / (s - e) of a crossing, from the depths s and e of start and end, errs by at most the larger one
/// of their errors by |s - e|, 1.2 times since s - e itself is known to a sixteenth only, and by the roundings of t.
#[inline(always)]
pub(super) fn inside(edge: &Edge, planes: &[Edge]) -> Option<Inside> {
    let mut left = Interval::WHOLE;
    // Whether it may lie in a plane; whether it is one of the cone's own edges, run the other way, and run the same way.
    let (mut is_open, mut twins) = (false, [false; 2]);
    for plane in planes {
        // A coarse bound on the error decides for most planes.
        match plane.side_of(edge) {
            Some(Place::Inside) => continue,
            Some(_) => return Some(Inside::Nothing),
            None => (),
        }
        let (start, start_error) = plane.depth(edge.start);
        let (end, end_error) = plane.depth(edge.end);
        if start > start_error && end > end_error {
            continue;
        }
        if start < -start_error && end < -end_error {
            return Some(Inside::Nothing);
        }
        let (across, error) = (start - end, start_error.max(end_error));
        if across.abs() <= CLEAR * error {
            // Nearly parallel to the plane and close to it: no crossing can be told.
            is_open = true;
            if let Some(is_same_way) = twin(edge, plane) {
                twins[usize::from(is_same_way)] = true;
            }
            continue;
        }
        let crossing = Parameter::new(start / across, 1.2 * error / across.abs() + 4.0 * ROUNDING);
        if across > 0.0 {
            left.high = left.high.first(crossing);
        } else {
            left.low = left.low.last(crossing);
        }
    }
    if left.is_empty() {
        return Some(Inside::Nothing);
    }
    match (is_open, twins) {
        (false, _) => Some(Inside::Part(left)),
        (true, [false, true]) => Some(Inside::Twin { is_same_way: true }),
        (true, [true, false]) => Some(Inside::Twin { is_same_way: false }),
        // It is no edge of the cone, or one that the cone has both ways, as rounding left the cone no width.
        (true, _) => None,
    }
}

/// Whether two edges are the same, and then whether they run the same way.
fn twin(edge: &Edge, other: &Edge) -> Option<bool> {
    if edge.start == other.start && edge.end == other.end {
        return Some(true);
    }
    (edge.start == other.end && edge.end == other.start).then_some(false)
}
