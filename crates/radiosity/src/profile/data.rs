//! What a profile holds.
use glam::DVec3;

/// Radiosity along a line.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Profile {
    /// The name of the scene's file.
    pub scene: String,
    /// The ends of the line, in the scene's coordinates.
    pub ends: [DVec3; 2],
    /// Number of bands of every value.
    pub bands: usize,
    /// The wavelength of each band in nm, where it is known.
    pub wavelengths: Vec<f64>,
    /// The elements that the line crosses, in order. Where it leaves the surface there are none.
    pub crossings: Vec<Crossing>,
}

/// An element that the line crosses.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Crossing {
    /// The patch's name.
    pub patch: String,
    /// The element's number.
    pub element: usize,
    /// The element's own radiosity per band, W/m².
    pub radiosity: Vec<f64>,
    /// What the patch's mean radiosity may be off by per band, W/m², by the estimate for its irradiance and its reflectance; empty where
    /// that is not known. See [`Solution::estimate`](crate::Solution::estimate).
    pub estimate: Vec<f64>,
    /// Where the line enters and leaves it.
    pub ends: [ProfilePoint; 2],
}

/// A place on the line.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProfilePoint {
    /// From the start of the line, in the scene's unit.
    pub distance: f64,
    /// In the scene's coordinates.
    pub place: DVec3,
    /// Interpolated radiosity per band, W/m².
    pub radiosity: Vec<f64>,
}
