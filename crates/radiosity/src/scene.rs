//! What is lit: patches, what they reflect and emit, and who looks at them.
mod middle;
mod texture;

pub use texture::{Image, Texture};

use crate::inspect::Finding;
use formfactor::PlanarPolygon;
use glam::DVec3;
use serde::{Deserialize, Serialize};

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

/// What the coordinates of a scene mean; they stay as the file has them.
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

/// A planar surface that reflects diffusely and may emit, on its front side.
#[derive(Clone, Debug)]
pub struct Patch {
    /// Unique name: the node's, with `.k` when the node holds several polygons, `.k.m` for pieces of a split one.
    pub name: String,
    /// The shape; its front is the side that gives and takes light, both sides block it.
    pub polygon: PlanarPolygon,
    /// Diffuse reflectance per band, 0 to below 1.
    pub reflectance: Vec<f64>,
    /// Emitted radiance L per band, W/m²/sr; the emitted radiosity is E = πL.
    pub emission: Vec<f64>,
    /// A picture on it, which replaces `reflectance` point by point; `reflectance` is then the mean.
    pub texture: Option<Texture>,
    /// Patches of one object with the same number are facets of one curved surface; none for a facet that is meant
    /// flat.
    pub smoothing: Option<usize>,
    /// Whether it only stands in the way of light, and has no part in it otherwise.
    pub only_blocks: bool,
    /// Where in the file it stands.
    pub origin: Origin,
}

impl Patch {
    /// A plain patch, without texture, that stands in no file.
    ///
    /// ```
    /// use radiosity::{Patch, formfactor::PlanarPolygon};
    ///
    /// let square = PlanarPolygon::new([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]])?;
    /// let lamp = Patch::new("lamp", square, vec![0.5], vec![10.0]); // one band; radiance 10, so 10 pi W/m² are emitted
    /// assert_eq!(lamp.polygon.normal().z, 1.0);
    /// # Ok::<(), radiosity::formfactor::Error>(())
    /// ```
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        polygon: PlanarPolygon,
        reflectance: Vec<f64>,
        emission: Vec<f64>,
    ) -> Patch {
        let name = name.into();
        let (texture, smoothing, only_blocks, origin) = (None, None, false, Origin::default());
        Patch { name, polygon, reflectance, emission, texture, smoothing, only_blocks, origin }
    }

    /// The reflectance per band of a triangle on the patch: its own, or the mean of its texture there.
    #[must_use]
    pub fn reflectance_over(&self, corners: [DVec3; 3]) -> Vec<f64> {
        match &self.texture {
            None => self.reflectance.clone(),
            Some(texture) => {
                let mean = texture.mean(corners);
                (0..self.reflectance.len()).map(|band| mean[band.min(2)]).collect()
            }
        }
    }

    /// Whether it gives light of its own in some band.
    #[must_use]
    pub fn emits(&self) -> bool {
        self.emission.iter().any(|&radiance| radiance > 0.0)
    }
}

/// Where a patch stands in its file, so that a writer can put the result back in its place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// Which geometry instance, counted in the order in which the reader met them.
    pub instance: usize,
    /// Which primitive element (`polylist`, `triangles`, …) of that geometry.
    pub primitive: usize,
    /// Which polygon of that primitive.
    pub polygon: usize,
}

/// A pinhole camera.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Camera {
    /// The camera's name in the file.
    pub name: String,
    /// The pinhole.
    pub position: DVec3,
    /// Where it looks; any length but zero.
    pub direction: DVec3,
    /// What is up in the picture; any length, not parallel to `direction`.
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
