//! Lambert's sum over a sector, as a Taylor model.
use super::chart::Chart;
use super::curtain::{Bearing, Curtain, Vector, cross, determinant, dot, models};
use super::sector::Sector;
use crate::numeric::taylor::Taylor;
use glam::DVec3;
use std::f64::consts::TAU;

/// The direction to a corner: `scale` times a product of normals, or the way to a vertex; and one over its length.
struct Ray {
    way: Vector,
    scale: f64,
    inverse: Taylor,
}

/// The form factor of a sector from the points of a cell with a normal; nothing where the cell is so close to it that series do
/// not converge. Edges that lie in the cell's plane up to `deviation` add nothing.
///
/// An edge in the curtain with the normal N, between corners along d and e, adds
/// n . N / |N| times its angle / (2 pi) = (n . N) lambda phi(cos) / (2 pi |d| |e|), where e x d = lambda N and phi is the
/// angle over its sine. There lambda is a determinant, so that no length of a normal is needed.
pub(super) fn factor(sector: &Sector, chart: &Chart, normal: DVec3, deviation: f64) -> Option<Taylor> {
    let in_plane = |point: &DVec3| normal.dot(chart.toward(*point)[0]).abs() <= deviation;
    let is_flat = |curtain: &Curtain| curtain.ends.iter().all(in_plane);
    let count = sector.corners.len();
    let mut rays: Vec<Option<Ray>> = Vec::with_capacity(count);
    for (i, (bearing, along)) in sector.corners.iter().enumerate() {
        let before = sector.corners[(i + count - 1) % count].1;
        let is_needed = !(is_flat(along) && is_flat(&before));
        rays.push(if is_needed { Some(ray(bearing, chart)?) } else { None });
    }
    let mut sum = Taylor::ZERO;
    for (i, (bearing, along)) in sector.corners.iter().enumerate() {
        let next = (i + 1) % count;
        let (false, Some(from), Some(to)) = (is_flat(along), &rays[i], &rays[next]) else { continue };
        let cosine = dot(&from.way, &to.way) * (from.inverse * to.inverse);
        let angle = cosine.angle_over_sine()? * (from.inverse * to.inverse);
        let rise = rise([bearing, &sector.corners[next].0], along, chart, normal);
        sum = sum + rise.scaled(from.scale * to.scale) * angle;
    }
    Some(sum.scaled(1.0 / TAU))
}

fn ray(bearing: &Bearing, chart: &Chart) -> Option<Ray> {
    let (way, scale) = match bearing {
        Bearing::Point(point) => (models(chart.toward(*point)), 1.0),
        Bearing::Crossing([inward, outward]) => {
            let [inward, outward] = [inward, outward].map(|curtain| models(curtain.normal(chart)));
            let way = cross(&outward, &inward);
            let scale = way.iter().map(|w| w.terms[0] * w.terms[0]).sum::<f64>().sqrt().recip();
            (way.map(|w| w.scaled(scale)), scale)
        }
    };
    let inverse = dot(&way, &way).inverse_root()?;
    Some(Ray { way, inverse, scale })
}

/// n . (e x d) for the corners d and e at the ends of an edge.
fn rise(corners: [&Bearing; 2], along: &Curtain, chart: &Chart, normal: DVec3) -> Taylor {
    let curtain = along.normal(chart);
    let plain = Taylor::linear(curtain.map(|n| normal.dot(n)));
    let depth = |curtain: &Curtain, point: &DVec3| Taylor::linear(curtain.depth(chart, *point));
    match corners {
        [Bearing::Point(p), Bearing::Point(q)] => {
            let edge = Curtain { ends: [*p, *q] };
            Taylor::linear(edge.normal(chart).map(|n| normal.dot(n) * p.distance(*q)))
        }
        [Bearing::Point(p), Bearing::Crossing([_, outward])] => plain * depth(outward, p),
        [Bearing::Crossing([inward, _]), Bearing::Point(q)] => plain * depth(inward, q),
        [Bearing::Crossing([inward, _]), Bearing::Crossing([_, outward])] => {
            plain * determinant([outward.normal(chart), curtain, inward.normal(chart)])
        }
    }
}
