//! Lambert's sum over what is within curtains, as a Taylor model.
use super::chart::Chart;
use super::curtain::{Bearing, Curtain, Sign, Vector, cross, determinant, dot, linear_sign, models};
use crate::numeric::taylor::Taylor;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The direction to a corner: `scale` times a product of normals, or the way to a vertex; and one over its length.
struct Ray {
    way: Vector,
    scale: f64,
    inverse: Taylor,
}

/// A cell from which is looked, and how exactly things stand where they stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight<'c> {
    pub(super) chart: &'c Chart,
    pub(super) normal: DVec3,
    pub(super) deviation: f64,
}

impl Sight<'_> {
    /// The form factor of what is within curtains from the points of the cell, given the corners, each with the curtain to the
    /// next; nothing where the cell is so close that series do not converge.
    ///
    /// An edge in the curtain with the normal N, between corners along d and e, adds
    /// n . N / |N| times its angle / (2 pi) = (n . N) lambda phi(cos) / (2 pi |d| |e|), where e x d = lambda N and phi is the
    /// angle over its sine. There lambda is a determinant, so that no length of a normal is needed.
    pub(super) fn factor(&self, corners: &[(Bearing, Curtain)]) -> Option<Taylor> {
        let rays: Option<Vec<Ray>> = corners.iter().map(|(bearing, _)| ray(bearing, self.chart)).collect();
        let rays = rays?;
        let mut sum = Taylor::ZERO;
        for (i, (bearing, along)) in corners.iter().enumerate() {
            let next = (i + 1) % corners.len();
            let (from, to) = (&rays[i], &rays[next]);
            let inverse = from.inverse * to.inverse;
            let cosine = dot(&from.way, &to.way) * inverse;
            let rise = self.rise([bearing, &corners[next].0], along).scaled(from.scale * to.scale) * inverse;
            let is_wide = self.is_flat(along) && cosine.terms[0] < 0.0;
            let ends = [bearing, &corners[next].0];
            sum = sum
                + if is_wide { self.turn(ends, rise, cosine)? } else { rise * cosine.angle_over_sine()? };
        }
        Some(sum.scaled(1.0 / TAU))
    }

    /// The angle with this signed sine and this cosine, of an edge in the cell's plane: a cell may reach such an edge between its
    /// ends, where the angle comes to half a turn. Nothing where the sign is not that of all of the cell.
    fn turn(&self, ends: [&Bearing; 2], sine: Taylor, cosine: Taylor) -> Option<Taylor> {
        let is_certain = if let [Bearing::Point(p), Bearing::Point(q)] = ends {
            let line = Curtain { ends: [*p, *q] }.normal(self.chart).map(|n| self.normal.dot(n));
            matches!(linear_sign(self.chart, line, self.deviation), Sign::Inside(0.0) | Sign::Outside(0.0))
        } else {
            sine.swing() < sine.terms[0].abs()
        };
        let half = Taylor::constant(PI.copysign(sine.terms[0]), f64::EPSILON);
        let left = sine * cosine.scaled(-1.0).angle_over_sine()?;
        is_certain.then_some(half - left)
    }

    /// Whether an edge lies in the cell's plane.
    fn is_flat(&self, along: &Curtain) -> bool {
        along.ends.iter().all(|end| self.normal.dot(self.chart.toward(*end)[0]).abs() <= self.deviation)
    }

    /// n . (e x d) for the corners d and e at the ends of an edge.
    fn rise(&self, corners: [&Bearing; 2], along: &Curtain) -> Taylor {
        let Self { chart, normal, .. } = *self;
        let curtain = along.normal(chart);
        let plain = Taylor::linear(curtain.map(|n| normal.dot(n)));
        let depth = |curtain: &Curtain, point: &DVec3| Taylor::linear(curtain.depth(chart, *point));
        use Bearing::{Crossing, Opposite, Point};
        match corners {
            [Point(p), Point(q)] => {
                let edge = Curtain { ends: [*p, *q] };
                Taylor::linear(edge.normal(chart).map(|n| normal.dot(n) * p.distance(*q)))
            }
            [Point(p), Crossing([_, outward]) | Opposite([_, outward])] => plain * depth(outward, p),
            [Crossing([inward, _]) | Opposite([inward, _]), Point(q)] => plain * depth(inward, q),
            [
                Crossing([inward, _]) | Opposite([inward, _]),
                Crossing([_, outward]) | Opposite([_, outward]),
            ] => plain * determinant([outward.normal(chart), curtain, inward.normal(chart)]),
        }
    }
}

fn ray(bearing: &Bearing, chart: &Chart) -> Option<Ray> {
    let (way, scale) = match bearing {
        Bearing::Point(point) => (models(chart.toward(*point)), 1.0),
        Bearing::Crossing([inward, outward]) => cross(outward.normal(chart), inward.normal(chart)),
        Bearing::Opposite([inward, outward]) => {
            let (way, scale) = cross(inward.normal(chart), outward.normal(chart));
            (way, -scale)
        }
    };
    let inverse = dot(&way, &way).inverse_root()?;
    Some(Ray { way, inverse, scale })
}
