//! Parameters along an edge with error bounds: the filter before the exact orders.

use super::orient::{Area, UNIT};
use super::segment::Segment;
use glam::DVec2;
use std::cmp::Ordering;

/// Where along an edge a point lies, from 0 to 1, and a bound on the error of that.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parameter {
    pub(crate) value: f64,
    pub(crate) error: f32,
}

impl Parameter {
    /// The edge's start and its end.
    pub(crate) const START: Parameter = Parameter { value: 0.0, error: 0.0 };
    pub(crate) const END: Parameter = Parameter { value: 1.0, error: 0.0 };

    /// Of a proper crossing, from the doubled areas of the edge's ends against the other edge.
    ///
    /// T = N / (N - M) with N, M of opposite signs; errors of E in both move it by at most 2 E / |N - M| when the
    /// computed |n - m| is at least 2 E, and the two roundings by 4u more.
    #[inline]
    pub(crate) fn of_crossing(n: Area, m: Area) -> Parameter {
        let (p, q) = (n.value.abs(), m.value.abs());
        let (length, error) = (p + q, n.error + m.error);
        let certain = 2.0 * error <= length && length < f64::INFINITY;
        let bound = if certain { 2.0 * error / length + 8.0 * UNIT } else { f64::INFINITY };
        Parameter { value: p / length, error: rounded_up(bound) }
    }

    /// Of a point inside the edge, by the longer axis: three roundings.
    pub(crate) fn of_point(edge: Segment, point: DVec2) -> Parameter {
        let (run, at) = (edge[1] - edge[0], point - edge[0]);
        let value = if run.x.abs() > run.y.abs() { at.x / run.x } else { at.y / run.y };
        Parameter { value, error: if run.is_finite() { rounded_up(8.0 * UNIT) } else { f32::INFINITY } }
    }

    /// The order of two points along one edge, when the bounds prove it; NaN proves nothing.
    #[inline]
    pub(crate) fn certain_order(self, other: Parameter) -> Option<Ordering> {
        let error = f64::from(self.error) + f64::from(other.error);
        if other.value - self.value > error * SLACK {
            Some(Ordering::Less)
        } else if self.value - other.value > error * SLACK {
            Some(Ordering::Greater)
        } else {
            None
        }
    }

    /// Not more than the distance from a point before this one.
    #[inline]
    pub(crate) fn distance_from(self, before: Parameter) -> f64 {
        (self.value - before.value) - (f64::from(self.error) + f64::from(before.error)) * SLACK
    }
}

/// Covers the rounding of a difference of parameters, at most 1/16 of the error bounds, which are 8u at least.
const SLACK: f64 = 1.0 + 1.0 / 8.0;

/// A bound in fewer bits, not smaller.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "rounds, and the factor more than makes up for it")]
fn rounded_up(bound: f64) -> f32 {
    (bound * (1.0 + 1.0 / 4_194_304.0)) as f32
}
