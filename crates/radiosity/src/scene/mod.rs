//! The scene: patches, what they reflect and emit, lights without surfaces, and cameras.
//!
//! ```text
//! middle     a point inside a patch
//! patch      a polygon, what it reflects and emits, and where it stands in its file
//! texture    pictures on patches
//! camera     who looks at the scene
//! lamp       lamps that are points
//! photometry the light of luminaires as it was measured
//! sky        light from beyond the scene: the sun and the sky
//! units      watts and lumens
//! asset      which way is up, and how long a unit is
//! finding    what is odd about a scene or its file
//! ```
pub(crate) mod asset;
pub(crate) mod camera;
pub(crate) mod finding;
pub(crate) mod lamp;
mod middle;
pub(crate) mod patch;
pub(crate) mod photometry;
pub(crate) mod sky;
pub(crate) mod texture;
pub(crate) mod units;

use asset::Asset;
use camera::Camera;
use finding::Finding;
use glam::DVec3;
use lamp::Lamp;
use patch::Patch;
use sky::{Sky, Sun};
use units::Units;

/// A scene: surfaces, lights, cameras, and warnings of the reader.
///
/// Coordinates are in the file's unit and axes.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The surfaces, in the order of the file.
    pub patches: Vec<Patch>,
    /// Lamps that are points, in the order of the file.
    pub lamps: Vec<Lamp>,
    /// Light from one direction each.
    pub suns: Vec<Sun>,
    /// The sky; none for a scene in the dark.
    pub sky: Option<Sky>,
    /// The cameras, in the order of the file.
    pub cameras: Vec<Camera>,
    /// Number of bands of every reflectance and emission; 3 for red, green, blue.
    pub bands: usize,
    /// The wavelength of each band in nm; pictures then show what an observer sees. Empty where the bands are red, green and
    /// blue, or are not visible light.
    pub wavelengths: Vec<f64>,
    /// What the reader found odd about the file, and how it read that.
    pub warnings: Vec<Finding>,
    /// The up axis and the unit.
    pub asset: Asset,
    /// What powers are counted in.
    pub units: Units,
}

impl Scene {
    /// Whether anything gives light in some band: a patch, a lamp, the sun or the sky.
    #[must_use]
    pub fn has_light(&self) -> bool {
        let lit = |bands: &Vec<f64>| bands.iter().any(|value| *value > 0.0);
        self.patches.iter().any(Patch::emits)
            || self.lamps.iter().any(|lamp| lit(&lamp.intensity))
            || self.suns.iter().any(|sun| lit(&sun.irradiance))
            || self.sky.iter().any(|sky| lit(&sky.radiance))
    }

    /// Lumens in a unit of power of each band: as many values as bands.
    ///
    /// A watt of grey is 179 lm, whatever the shade; of bands with wavelengths each has what the eye sees of it, 683 lm/W at most.
    #[must_use]
    pub fn lumens(&self) -> Vec<f64> {
        self.units.lumens(self.bands, &self.wavelengths)
    }

    /// The luminous value of one per band: lx of an irradiance, lm of a power.
    #[must_use]
    pub fn luminous(&self, values: &[f64]) -> f64 {
        self.lumens().iter().zip(values).map(|(lumens, value)| lumens * value).sum()
    }

    /// What of each band makes a unit of luminous light, where all have as much.
    #[must_use]
    pub fn white(&self) -> f64 {
        let whole: f64 = self.lumens().iter().sum();
        if whole > 0.0 { 1.0 / whole } else { 0.0 }
    }

    /// The lower and the upper corner of the box around all patches; of the unit box where there are none.
    #[must_use]
    pub fn extent(&self) -> [DVec3; 2] {
        let points = self.patches.iter().flat_map(|patch| patch.polygon.loops()).flatten();
        let boxes = points.map(|point| [*point, *point]);
        boxes.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([DVec3::ZERO, DVec3::ONE])
    }
}
