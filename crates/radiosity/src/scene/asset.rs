//! Which way is up, and how long a unit is.
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The up axis and the unit of a scene. Coordinates stay as the file has them.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Asset {
    /// The axis that points up; y where the file says nothing.
    pub up: DVec3,
    /// Length of the file's unit in metres; 1 where the file says nothing.
    pub unit: f64,
}

impl Default for Asset {
    /// y up, in metres.
    fn default() -> Asset {
        Asset { up: DVec3::Y, unit: 1.0 }
    }
}
