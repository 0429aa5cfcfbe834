//! Who looks at a scene.
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A pinhole camera.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Camera {
    /// The camera's name in the file.
    pub name: String,
    /// Where the eye is.
    pub position: DVec3,
    /// The direction of view; any length but zero.
    pub direction: DVec3,
    /// The direction that is up in the picture; any length, not parallel to `direction`.
    pub up: DVec3,
    /// Vertical field of view in radians, between 0 and π.
    pub vertical_fov: f64,
    /// Width over height of the picture.
    pub aspect: f64,
}

impl Camera {
    /// Whether its numbers make a view.
    pub(crate) fn is_sound(&self) -> bool {
        let upright = self.direction.cross(self.up).try_normalize().is_some();
        let open = self.vertical_fov > 0.0 && self.vertical_fov < std::f64::consts::PI;
        upright && open && self.position.is_finite() && self.aspect.is_normal() && self.aspect > 0.0
    }
}
