//! The part of an edge inside a cone: what an occluder hides of it, or what the target's cone leaves of it.
use super::cone::{Edge, OneCone, UNDERFLOW};
use super::exact_side::{Span, exact_side};
use super::interval::{Interval, Parameter, greater};
use crate::numeric::rounding::ROUNDING;
use std::cmp::Ordering;

/// What of an edge is inside a cone.
#[derive(Clone, Copy, Debug)]
pub(super) enum Inside {
    /// Nothing, for certain.
    Nothing,
    /// One interval: a cone is convex. Both ends may be uncertain.
    Part(Interval),
    /// One interval of an edge that lies exactly in the plane of one of the cone's own, which runs the same way or the other way.
    Along { part: Interval, is_same_way: bool },
    /// It may lie in one of the planes, so that the error of a parameter has no bound.
    Open,
}

/// An edge whose ends differ by this many times their error crosses a plane.
pub(super) const CLEAR: f64 = 16.0;
/// By how much the error of a parameter exceeds that of the depths by their difference: 16/15, and roundings.
const SHARE: f64 = 1.07;

/// What of edge `index` of a cone is inside another one, by clipping it against one plane after the other.
pub(super) fn inside(span: &Span, (own, index): (&OneCone<'_>, usize), other: &OneCone<'_>) -> Inside {
    let edge = &own.edges[index];
    let mut left = Interval::WHOLE;
    // Whether it may lie in a plane; whether it lies in planes of edges that run the other way, and the same way.
    let (mut is_open, mut ways) = (false, [false; 2]);
    for (number, plane) in other.edges.iter().enumerate() {
        let [start, end] = [edge.start, edge.end].map(|p| plane.inward.dot(p));
        // A coarse bound on the error decides for most planes.
        let coarse = own.spread.error(plane);
        if start > coarse && end > coarse {
            continue;
        }
        if start < -coarse && end < -coarse {
            return Inside::Nothing;
        }
        let error = larger_error(edge, plane) + own.spread.displaced(plane);
        let side = |end: usize, depth: f64| match depth {
            depth if depth > error => Some(Ordering::Greater),
            depth if depth < -error => Some(Ordering::Less),
            _ => exact_side(span, (own, own.ends(index)[end]), (other, number)),
        };
        match [side(0, start), side(1, end)] {
            [Some(Ordering::Equal), Some(Ordering::Equal)] if leads(edge) && leads(plane) => {
                ways[usize::from(edge.inward.dot(plane.inward) > 0.0)] = true;
            }
            [Some(Ordering::Equal), Some(Ordering::Equal)] => is_open = true,
            [Some(a), Some(b)] if a.is_ge() && b.is_ge() => (),
            [Some(a), Some(b)] if a.is_le() && b.is_le() => return Inside::Nothing,
            // Nearly parallel to the plane and close to it: no crossing can be told.
            _ if (start - end).abs() <= CLEAR * error => is_open = true,
            _ if start > end => left.high = left.high.first(crossing(edge, plane, [start, end])),
            _ => left.low = left.low.last(crossing(edge, plane, [start, end])),
        }
    }
    match ways {
        _ if left.is_empty() => Inside::Nothing,
        _ if is_open => Inside::Open,
        [false, false] => Inside::Part(left),
        // A cone that has it both ways has no width.
        [true, true] => Inside::Open,
        [_, is_same_way] => Inside::Along { part: left, is_same_way },
    }
}

/// Whether it is certain where the plane of an edge leads: not of one that leads to dA.
fn leads(edge: &Edge) -> bool {
    edge.inward.length() > CLEAR * edge.error
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
