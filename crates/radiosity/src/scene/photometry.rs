//! The light of luminaires as it was measured: candela by direction.
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Luminous intensity on a lattice of directions, and linear in both angles in between: what IES and EULUMDAT files hold.
///
/// γ is the angle to the way ahead, from 0 to π, and C the azimuth around it. A file that ends before γ = π has no light beyond.
#[derive(Clone, Debug, PartialEq)]
pub struct Photometry {
    /// C of each half-plane, ascending from 0; the last one is 2π where there is more than one.
    azimuths: Vec<f64>,
    /// γ of each row, ascending.
    heights: Vec<f64>,
    /// Candela, half-plane by half-plane.
    candela: Vec<f64>,
}

/// How a lattice goes on beyond the half-planes that are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Symmetry {
    /// All around as it is.
    None,
    /// The planes from 0 to π are mirrored.
    Half,
    /// The planes from π/2 to 3π/2 are mirrored.
    Across,
    /// The planes from 0 to π/2 are mirrored twice.
    Quarter,
}

impl Photometry {
    /// A table of half-planes: the azimuth and the candela of each; both angles ascend, in radians.
    ///
    /// One half-plane stands for all.
    pub(crate) fn new(heights: Vec<f64>, planes: Vec<(f64, Vec<f64>)>, symmetry: Symmetry) -> Photometry {
        let planes = around(planes, symmetry);
        let azimuths = planes.iter().map(|plane| plane.0).collect();
        Photometry { azimuths, heights, candela: planes.into_iter().flat_map(|plane| plane.1).collect() }
    }

    /// The intensity in cd along a way of any length but 0, in the luminaire's frame: x is C = 0, y a quarter turn on, z ahead.
    #[must_use]
    pub fn candela(&self, way: DVec3) -> f64 {
        let height = way.truncate().length().atan2(way.z);
        let azimuth = way.y.atan2(way.x).rem_euclid(TAU);
        let Some((row, along)) = between(&self.heights, height) else { return 0.0 };
        let at = |plane: usize| {
            let rows = &self.candela[plane * self.heights.len()..][..self.heights.len()];
            rows[row] + along * (rows[(row + 1).min(rows.len() - 1)] - rows[row])
        };
        match between(&self.azimuths, azimuth) {
            Some((plane, across)) if plane + 1 < self.azimuths.len() => {
                at(plane) + across * (at(plane + 1) - at(plane))
            }
            _ => at(0),
        }
    }

    /// The luminous flux in lm: the integral over all directions, exact for what is linear in between.
    #[must_use]
    pub fn lumens(&self) -> f64 {
        let planes: Vec<f64> =
            self.candela.chunks(self.heights.len()).map(|rows| along(&self.heights, rows)).collect();
        if planes.len() == 1 {
            return TAU * planes[0];
        }
        let wedges = self.azimuths.windows(2).zip(planes.windows(2));
        wedges.map(|(c, f)| (c[1] - c[0]) * (f[0] + f[1]) / 2.0).sum()
    }
}

/// ∫ I sin γ dγ for I that is linear between the heights.
fn along(heights: &[f64], rows: &[f64]) -> f64 {
    let part = |(g, i): (&[f64], &[f64])| {
        let slope = (i[1] - i[0]) / (g[1] - g[0]);
        // ∫ (I₀ + s (γ − γ₀)) sin γ = [−I cos γ + s sin γ]
        i[0] * g[0].cos() - i[1] * g[1].cos() + slope * (g[1].sin() - g[0].sin())
    };
    heights.windows(2).zip(rows.windows(2)).map(part).sum()
}

/// The interval that holds an angle, and the share of it that lies before; nothing beyond the ends.
fn between(angles: &[f64], angle: f64) -> Option<(usize, f64)> {
    let next = angles.partition_point(|start| *start <= angle);
    let (first, last) = (next.checked_sub(1)?, angles.len() - 1);
    if first == last {
        // Roundings of the last one are on it.
        return (angle <= angles[last] + 1e-9).then_some((last, 0.0));
    }
    Some((first, (angle - angles[first]) / (angles[next] - angles[first])))
}

/// The half-planes all around, from 0 to 2π; one alone as it is.
fn around(planes: Vec<(f64, Vec<f64>)>, symmetry: Symmetry) -> Vec<(f64, Vec<f64>)> {
    if planes.len() == 1 {
        return vec![(0.0, planes.into_iter().next().map_or(Vec::new(), |plane| plane.1))];
    }
    let mirrored = |planes: &[(f64, Vec<f64>)], about: f64| {
        planes.iter().map(|(c, rows)| ((2.0 * about - c).rem_euclid(TAU), rows.clone())).collect::<Vec<_>>()
    };
    let mut all = planes;
    match symmetry {
        Symmetry::None => {}
        Symmetry::Half => all.extend(mirrored(&all, PI)),
        Symmetry::Across => all.extend(mirrored(&all, PI / 2.0)),
        Symmetry::Quarter => {
            all.extend(mirrored(&all, PI / 2.0));
            all.extend(mirrored(&all, PI));
        }
    }
    all.iter_mut().filter(|plane| plane.0 > TAU - 1e-9).for_each(|plane| plane.0 = 0.0);
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.dedup_by(|b, a| b.0 - a.0 < 1e-9);
    if all[0].0 > 0.0 {
        all.insert(0, (0.0, at_seam(&all)));
    }
    let first = all[0].1.clone();
    all.push((TAU, first));
    all
}

/// The rows at C = 0, between those of the last half-plane and of the first.
fn at_seam(planes: &[(f64, Vec<f64>)]) -> Vec<f64> {
    let ((after, first), (before, last)) = (&planes[0], &planes[planes.len() - 1]);
    let share = (TAU - before) / (TAU - before + after);
    last.iter().zip(first).map(|(last, first)| last + share * (first - last)).collect()
}
