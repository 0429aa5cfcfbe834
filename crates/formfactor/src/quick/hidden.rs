//! What a cone holds of an edge.
use super::cone::{Edge, Place};
use super::interval::{Interval, Parameter};
use crate::numeric::rounding::ROUNDING;

/// What a cone holds of an edge.
#[derive(Clone, Copy, Debug)]
pub(super) enum Hidden {
    /// A part, or nothing.
    Part(Interval),
    /// The edge is one of the cone's own, run along the same way or the other way.
    Twin { is_same_way: bool },
}

/// An edge whose ends differ by this many times their error crosses a plane.
const CLEAR: f64 = 16.0;

/// What the cone inside `planes` holds of `edge`: no part, for certain, or some. The outer `None` says that the edge may
/// lie in one of the planes and that more depends on it than the error.
///
/// The parameter t = s / (s - e) of a crossing, from the depths s and e of start and end, errs by at most the larger one
/// of their errors by |s - e|, 1.2 times since s - e itself is known to a sixteenth only, and by the roundings of t.
#[inline(always)]
pub(super) fn hidden(edge: &Edge, planes: &[Edge]) -> Option<Option<Hidden>> {
    let mut span = Interval::WHOLE;
    // Whether it may lie in a plane, and whether it is one of the cone's own edges, run the other way or the same way.
    let (mut is_open, mut twins) = (false, [false; 2]);
    for plane in planes {
        match plane.side_of(edge) {
            Some(Place::Inside) => continue,
            Some(_) => return Some(None),
            None => (),
        }
        let (start, start_error) = plane.depth(edge.start);
        let (end, end_error) = plane.depth(edge.end);
        if start > start_error && end > end_error {
            continue;
        }
        if start < -start_error && end < -end_error {
            return Some(None);
        }
        let (across, error) = (start - end, start_error.max(end_error));
        if across.abs() <= CLEAR * error {
            is_open = true;
            if let Some(is_same_way) = twin(edge, plane) {
                twins[usize::from(is_same_way)] = true;
            }
            continue;
        }
        let met = Parameter::new(start / across, 1.2 * error / across.abs() + 4.0 * ROUNDING);
        if across > 0.0 {
            span.high = span.high.first(met);
        } else {
            span.low = span.low.last(met);
        }
    }
    if span.is_nothing() {
        return Some(None);
    }
    match (is_open, twins) {
        (false, _) => Some(Some(Hidden::Part(span))),
        (true, [false, true]) => Some(Some(Hidden::Twin { is_same_way: true })),
        (true, [true, false]) => Some(Some(Hidden::Twin { is_same_way: false })),
        // No edge of the cone, or one that it has both ways: then rounding left it no width.
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
