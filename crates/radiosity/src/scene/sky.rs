//! Light from beyond the scene: the sun and the sky.
use glam::DVec3;

/// Light that comes from one direction alone.
#[derive(Clone, Debug)]
pub struct Sun {
    /// The name in the file.
    pub name: String,
    /// The way the light goes; any length but 0.
    pub direction: DVec3,
    /// Irradiance per band on a surface that faces it, W/m².
    pub irradiance: Vec<f64>,
}

/// The hemisphere above the scene, on the side of [`Asset::up`](crate::Asset::up). It has no light below the horizon.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Radiance at the zenith, per band, W/m²/sr.
    pub radiance: Vec<f64>,
    /// How the radiance depends on the height above the horizon.
    pub kind: SkyKind,
}

/// How bright a sky is at the angle γ above the horizon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SkyKind {
    /// Everywhere as at the zenith.
    #[default]
    Uniform,
    /// (1 + 2 sin γ) / 3 of the zenith: the standard overcast sky (Moon and Spencer 1942; CIE S 011).
    Overcast,
}
