//! Axes about dA's normal.
use super::random::Random;
use crate::shapes::differential_area::DifferentialArea;
use glam::DVec3;
use std::f64::consts::TAU;

/// How a hemicube is turned about the normal.
///
/// The errors of neighbouring points whose cells are aligned with the same edge are alike, which shows as a pattern. Turned at
/// random they show as noise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Rotation {
    /// By an angle in radians from an axis that the normal alone decides.
    Angle(f64),
    /// By an angle for each point, a function of this seed and of the point's position.
    Random(u64),
}

impl Rotation {
    fn angle(self, position: DVec3) -> f64 {
        match self {
            Rotation::Angle(angle) => angle,
            Rotation::Random(seed) => TAU * Random::at(seed, position).unit(),
        }
    }
}

/// Two axes in dA's horizon and its normal: right-handed, unit.
pub(super) fn frame(from: &DifferentialArea, rotation: Rotation) -> [DVec3; 3] {
    let (along, across) = from.normal().any_orthonormal_pair();
    let (sine, cosine) = rotation.angle(from.position()).sin_cos();
    [cosine * along + sine * across, cosine * across - sine * along, from.normal()]
}

/// A direction given by its components along the axes.
pub(super) fn along(axes: &[DVec3; 3], [x, y, z]: [f64; 3]) -> DVec3 {
    x * axes[0] + y * axes[1] + z * axes[2]
}
