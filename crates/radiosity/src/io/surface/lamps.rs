//! Lamps where their nodes put them: they shine along −z.
use crate::scene::lamp::{Distribution, Lamp};
use glam::{DMat3, DMat4, DVec3};
use std::f64::consts::{PI, TAU};

/// Sides of a polygon in place of an ellipse.
const SIDES: usize = 32;

/// Where a lamp stands, and which way it points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LampPose {
    position: DVec3,
    frame: DMat3,
}

impl LampPose {
    /// As a node's transform says, whatever its scale; nothing where that leaves no direction.
    pub(crate) fn of(world: DMat4) -> Option<LampPose> {
        let back = world.transform_vector3(DVec3::Z).try_normalize()?;
        let side = world.transform_vector3(DVec3::X);
        let right = (side - side.dot(back) * back).try_normalize()?;
        let frame = DMat3::from_cols(right, back.cross(right), -back);
        Some(LampPose { position: world.w_axis.truncate(), frame })
    }

    /// The way in which the light of a sun goes.
    pub(crate) fn ahead(&self) -> DVec3 {
        self.frame.z_axis
    }

    /// A lamp that stands so.
    pub(crate) fn lamp(&self, name: String, distribution: Distribution, intensity: Vec<f64>) -> Lamp {
        Lamp { name, position: self.position, frame: self.frame, distribution, intensity }
    }
}

/// The outline of a lamp of such sizes along x and y, its front toward −z: a rectangle, or a polygon of the area of an ellipse. Nothing
/// where it has no area.
pub(crate) fn area_corners(sizes: [f64; 2], is_round: bool) -> Option<Vec<DVec3>> {
    let [x, y] = sizes.map(|size| size / 2.0);
    if !(x > 0.0 && y > 0.0) {
        return None;
    }
    if !is_round {
        return Some(vec![
            DVec3::new(-x, -y, 0.0),
            DVec3::new(-x, y, 0.0),
            DVec3::new(x, y, 0.0),
            DVec3::new(x, -y, 0.0),
        ]);
    }
    let step = TAU / SIDES as f64;
    // A polygon around a circle of radius r has the area n r² sin(2π/n) / 2.
    let scale = (PI / (SIDES as f64 / 2.0 * step.sin())).sqrt();
    let corner = |k: usize| {
        let (sine, cosine) = (-step * k as f64).sin_cos();
        DVec3::new(scale * x * cosine, scale * y * sine, 0.0)
    };
    Some((0..SIDES).map(corner).collect())
}
