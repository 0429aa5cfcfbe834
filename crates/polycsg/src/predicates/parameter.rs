//! Parameters along an edge with error bounds: the filter before the exact orders.

use super::distance::{RELATIVE, distance, is_moderate};
use super::orient::{Area, UNIT};
use super::segment::Segment;
use exactfloat::DoubleDouble;
use glam::DVec2;

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
    const UNKNOWN: Parameter = Parameter { value: 0.0, error: f32::INFINITY };

    /// Of a proper crossing, from the doubled areas of the edge's ends against the other edge.
    ///
    /// T = N / (N - M) with N, M of opposite signs; errors of E in both move it by at most 2 E / |N - M| when the
    /// computed |n - m| is at least 2 E, and the two roundings by 4u more.
    #[inline]
    pub(crate) fn of_crossing(n: Area, m: Area) -> Parameter {
        let (p, q) = (n.value.abs(), m.value.abs());
        let (length, error) = (p + q, n.error + m.error);
        let certain = 2.0 * error <= length && length < f64::INFINITY;
        if !certain {
            return Parameter::UNKNOWN;
        }
        Parameter { value: p / length, error: rounded_up(2.0 * error / length + 8.0 * UNIT) }
    }

    /// Of a point inside the edge, by the longer axis: three roundings.
    pub(crate) fn of_point(edge: Segment, point: DVec2) -> Parameter {
        let (run, at) = (edge[1] - edge[0], point - edge[0]);
        if !run.is_finite() {
            return Parameter::UNKNOWN;
        }
        let value = if run.x.abs() > run.y.abs() { at.x / run.x } else { at.y / run.y };
        Parameter { value, error: rounded_up(8.0 * UNIT) }
    }

    /// A lower bound of the parameter.
    #[inline]
    pub(crate) fn low(self) -> f64 {
        self.value - f64::from(self.error) * SLACK
    }

    /// An upper bound of the parameter.
    #[inline]
    pub(crate) fn high(self) -> f64 {
        self.value + f64::from(self.error) * SLACK
    }

    /// Not more than the distance from a point before this one.
    #[inline]
    pub(crate) fn distance_from(self, before: Parameter) -> f64 {
        (self.value - before.value) - (f64::from(self.error) + f64::from(before.error)) * SLACK
    }
}

/// Covers the rounding of a difference of parameters, at most 1/16 of the error bounds, which are 8u at least.
const SLACK: f64 = 1.0 + 1.0 / 8.0;

/// Bounds of where along an edge a point lies, from 0 to 1, in multiples of 2^-100.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FineParameter {
    pub(crate) low: i128,
    pub(crate) high: i128,
}

impl FineParameter {
    /// The edge's start.
    pub(crate) const START: FineParameter = FineParameter { low: 0, high: 0 };
    const UNKNOWN: FineParameter = FineParameter { low: i128::MIN, high: i128::MAX };

    /// Of the crossing of `e` with `f`, a proper one.
    ///
    /// As [`Parameter::of_crossing`], with twice the bound for the roundings of the bound itself.
    pub(crate) fn of_crossing(e: Segment, f: Segment) -> FineParameter {
        if ![e, f].iter().flatten().all(|&p| is_moderate(p)) {
            return FineParameter::UNKNOWN;
        }
        let [(n, dn), (m, dm)] = e.map(|end| distance(f, end));
        let (length, error) = (n + m, dn + dm);
        if 2.0 * error >= length.hi {
            return FineParameter::UNKNOWN;
        }
        FineParameter::around(n / length, 4.0 * (error / length.hi + RELATIVE))
    }

    /// Of a point inside the edge, by the longer axis: differences are exact.
    pub(crate) fn of_point(e: Segment, p: DVec2) -> FineParameter {
        if ![e[0], e[1], p].into_iter().all(is_moderate) {
            return FineParameter::UNKNOWN;
        }
        let ratio = |a: f64, b: f64, p: f64| DoubleDouble::difference(p, a) / DoubleDouble::difference(b, a);
        let run = (e[1] - e[0]).abs();
        let value = if run.x > run.y { ratio(e[0].x, e[1].x, p.x) } else { ratio(e[0].y, e[1].y, p.y) };
        FineParameter::around(value, RELATIVE)
    }

    /// What lies within an error of a number of 2 at most.
    fn around(value: DoubleDouble, error: f64) -> FineParameter {
        #[expect(clippy::cast_possible_truncation, reason = "what this cuts off is added to the error")]
        let [hi, lo, error] = [value.hi, value.lo, error].map(|x| (x * FINE) as i128);
        FineParameter { low: hi + lo - error - 3, high: hi + lo + error + 3 }
    }
}

/// The multiples of a [`FineParameter`]: 2^100.
const FINE: f64 = f64::from_bits((1023 + 100) << 52);

/// A bound in fewer bits, not smaller.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "rounds, and the factor more than makes up for it")]
fn rounded_up(bound: f64) -> f32 {
    (bound * (1.0 + 1.0 / 4_194_304.0)) as f32
}
