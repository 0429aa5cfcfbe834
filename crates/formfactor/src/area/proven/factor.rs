//! Lambert's sum over what is within curtains, as a Taylor model.
use super::chart::Chart;
use super::curtain::{Bearing, Curtain, Vector, cross, determinant, dot, models};
use crate::numeric::taylor::Taylor;
use glam::DVec3;
use std::f64::consts::TAU;

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
    /// next; nothing where the cell is so close that series do not converge. Edges that lie in the cell's plane add nothing.
    ///
    /// An edge in the curtain with the normal N, between corners along d and e, adds
    /// n . N / |N| times its angle / (2 pi) = (n . N) lambda phi(cos) / (2 pi |d| |e|), where e x d = lambda N and phi is the
    /// angle over its sine. There lambda is a determinant, so that no length of a normal is needed.
    pub(super) fn factor(&self, corners: &[(Bearing, Curtain)]) -> Option<Taylor> {
        let count = corners.len();
        let mut rays: Vec<Option<Ray>> = Vec::with_capacity(count);
        for (i, (bearing, along)) in corners.iter().enumerate() {
            let before = corners[(i + count - 1) % count].1;
            let is_needed = !(self.is_flat(along) && self.is_flat(&before));
            rays.push(if is_needed { Some(ray(bearing, self.chart)?) } else { None });
        }
        let mut sum = Taylor::ZERO;
        for (i, (bearing, along)) in corners.iter().enumerate() {
            let next = (i + 1) % count;
            let (false, Some(from), Some(to)) = (self.is_flat(along), &rays[i], &rays[next]) else {
                continue;
            };
            let inverse = from.inverse * to.inverse;
            let angle = (dot(&from.way, &to.way) * inverse).angle_over_sine()? * inverse;
            let rise = self.rise([bearing, &corners[next].0], along);
            sum = sum + rise.scaled(from.scale * to.scale) * angle;
        }
        Some(sum.scaled(1.0 / TAU))
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
