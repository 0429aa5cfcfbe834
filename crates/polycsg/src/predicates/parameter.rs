//! Parameters along an edge with error bounds: the filter before the exact orders.

use super::Segment;
use super::orient::{Area, UNIT};
use glam::DVec2;
use std::cmp::Ordering;

/// Where along an edge a point lies, from 0 to 1, and a bound on the error of that.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Parameter {
    value: f64,
    error: f64,
}

impl Parameter {
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
        Parameter { value: p / length, error: bound }
    }

    /// Of a point inside the edge, by the longer axis: three roundings.
    pub(crate) fn of_point(edge: Segment, point: DVec2) -> Parameter {
        let (run, at) = (edge[1] - edge[0], point - edge[0]);
        let value = if run.x.abs() > run.y.abs() { at.x / run.x } else { at.y / run.y };
        Parameter { value, error: 8.0 * UNIT }
    }

    /// The order of two points along one edge, when the bounds prove it; NaN proves nothing.
    #[inline]
    pub(crate) fn certain_order(self, other: Parameter) -> Option<Ordering> {
        if self.value + self.error < other.value - other.error {
            Some(Ordering::Less)
        } else if self.value - self.error > other.value + other.error {
            Some(Ordering::Greater)
        } else {
            None
        }
    }
}
