//! The scene: patches, what they reflect and emit, and cameras.
//!
//! ```text
//! middle     a point inside a patch
//! patch      a polygon, what it reflects and emits, and where it stands in its file
//! texture    pictures on patches
//! camera     who looks at the scene
//! asset      which way is up, and how long a unit is
//! finding    what is odd about a scene or its file
//! ```
pub(crate) mod asset;
pub(crate) mod camera;
pub(crate) mod finding;
mod middle;
pub(crate) mod patch;
pub(crate) mod texture;

use asset::Asset;
use camera::Camera;
use finding::Finding;
use glam::DVec3;
use patch::Patch;

/// A scene: surfaces, cameras, and warnings of the reader.
///
/// Coordinates are in the file's unit and axes.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The surfaces, in the order of the file.
    pub patches: Vec<Patch>,
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
}

impl Scene {
    /// The lower and the upper corner of the box around all patches; of the unit box where there are none.
    #[must_use]
    pub fn extent(&self) -> [DVec3; 2] {
        let points = self.patches.iter().flat_map(|patch| patch.polygon.loops()).flatten();
        let boxes = points.map(|point| [*point, *point]);
        boxes.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([DVec3::ZERO, DVec3::ONE])
    }
}
