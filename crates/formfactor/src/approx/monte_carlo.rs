//! Monte Carlo: rays at random.
use super::frame::{Rotation, along, frame};
use super::ray::{along_ray, items, seen};
use super::{method::Method, random::Random};
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;
use glam::DVec3;
use std::f64::consts::TAU;

/// How the rays of a [`MonteCarlo`] row are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Sampling {
    /// Each independent of the others.
    Random,
    /// One in each cell of a square grid over radius squared and azimuth; the number of rays is rounded up to a square.
    Stratified,
}

/// Casts cosine-weighted rays: uniform points of the unit disk, raised to the hemisphere [Malley 1988].
///
/// F = rays that meet the target first / all rays.
///
/// The standard error is sqrt(F (1 - F) / n) for n random rays, and falls as n^-3/4 for stratified ones. Equal seeds give equal
/// results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MonteCarlo {
    /// The number of rays; 0 is taken as 1.
    pub rays: u32,
    /// How they are drawn.
    pub sampling: Sampling,
    /// The seed of the random numbers, together with dA's position.
    pub seed: u64,
}

impl Method for MonteCarlo {
    fn name(&self) -> String {
        let sampling = match self.sampling {
            Sampling::Random => "random",
            Sampling::Stratified => "stratified",
        };
        format!("Monte Carlo, {} {sampling} rays", self.rays.max(1))
    }

    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64> {
        let axes = frame(from, Rotation::Angle(0.0));
        let points = self.points(&mut Random::at(self.seed, from.position()));
        let weight = 1.0 / points.len() as f64;
        let rays = points.into_iter().map(|[u, v]| {
            let (sine, cosine) = (TAU * v).sin_cos();
            (along(&axes, [u.sqrt() * cosine, u.sqrt() * sine, (1.0 - u).sqrt()]), weight)
        });
        let factors = cast(enclosure, from, rays);
        targets.iter().map(|id| factors[*id]).collect()
    }
}

impl MonteCarlo {
    /// Points of the unit square.
    fn points(&self, random: &mut Random) -> Vec<[f64; 2]> {
        let rays = self.rays.max(1);
        match self.sampling {
            Sampling::Random => (0..rays).map(|_| [random.unit(), random.unit()]).collect(),
            Sampling::Stratified => {
                let root = rays.isqrt();
                let side = if root * root < rays { root + 1 } else { root };
                let cells = (0..side).flat_map(|i| (0..side).map(move |j| [f64::from(i), f64::from(j)]));
                cells.map(|cell| cell.map(|at| (at + random.unit()) / f64::from(side))).collect()
            }
        }
    }
}

/// The weights of the rays that see each polygon, by id.
pub(super) fn cast(
    enclosure: &Enclosure,
    from: &DifferentialArea,
    rays: impl IntoIterator<Item = (DVec3, f64)>,
) -> Vec<f64> {
    let items = items(enclosure, from);
    let mut factors = vec![0.0; enclosure.polygons().len()];
    for (direction, weight) in rays {
        let near = along_ray(enclosure, &items, from.position(), direction);
        for item in seen(near, direction) {
            factors[item.id] += weight;
        }
    }
    factors
}
