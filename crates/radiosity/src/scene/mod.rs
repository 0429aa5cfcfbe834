//! What is lit: patches, what they reflect and emit, and who looks at them.
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

/// Surfaces, cameras, and what the reader had to say about the file.
///
/// Coordinates are the file's own: its units, its axes.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The surfaces, in the order of the file.
    pub patches: Vec<Patch>,
    /// The cameras, in the order of the file.
    pub cameras: Vec<Camera>,
    /// Number of bands of every reflectance and emission; 3 for red, green, blue.
    pub bands: usize,
    /// The bands' wavelengths in nm, where they are those of light: pictures show what an observer sees of them. Empty
    /// where bands are red, green and blue, or no light at all.
    pub wavelengths: Vec<f64>,
    /// What was odd about the file and how it was taken.
    pub warnings: Vec<Finding>,
    /// What the coordinates mean.
    pub asset: Asset,
}

impl Scene {
    /// The corners of the box around all patches; those of the unit box where there are none.
    #[must_use]
    pub fn extent(&self) -> [DVec3; 2] {
        let points = self.patches.iter().flat_map(|patch| patch.polygon.loops()).flatten();
        let boxes = points.map(|point| [*point, *point]);
        boxes.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([DVec3::ZERO, DVec3::ONE])
    }
}
