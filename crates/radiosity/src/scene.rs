//! What is lit: patches, what they reflect and emit, and who looks at them.
use formfactor::PlanarPolygon;
use glam::DVec3;

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
    /// What was odd about the file and how it was taken, one sentence each.
    pub warnings: Vec<String>,
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
    /// Where in the file it stands.
    pub origin: Origin,
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
#[derive(Clone, Debug, PartialEq)]
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
