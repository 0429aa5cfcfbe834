//! Surfaces: polygons, where they stand, and what they reflect and emit.
use super::polygon::Facet;
use crate::scene::{patch::Origin, texture::Image};
use glam::DMat4;
use std::sync::Arc;

/// What a surface reflects and emits, in red, green and blue.
#[derive(Clone, Debug)]
pub(crate) struct Finish {
    /// The material's name; empty where it has none.
    pub(crate) material: Arc<str>,
    /// The reflectance, or what the picture's colours are multiplied by.
    pub(crate) reflectance: [f64; 3],
    /// Radiance.
    pub(crate) emission: [f64; 3],
    pub(crate) image: Option<Arc<Image>>,
    /// What takes the place of all that.
    pub(crate) spectra: Option<Spectra>,
}

/// What a surface reflects and emits in bands of any number.
#[derive(Clone, Debug)]
pub(crate) struct Spectra {
    pub(crate) reflectance: Vec<f64>,
    /// Radiance.
    pub(crate) emission: Vec<f64>,
}

/// Polygons of one material, in a node.
#[derive(Debug)]
pub(crate) struct Surface<'s> {
    /// The node's name.
    pub(crate) name: &'s str,
    /// Where in the file, for warnings.
    pub(crate) place: &'s str,
    pub(crate) facets: &'s [Facet],
    /// From the node to the world.
    pub(crate) world: DMat4,
    pub(crate) finish: Finish,
    /// Whether its back is a surface too.
    pub(crate) two_sided: bool,
    /// Which instance, which primitive of it.
    pub(crate) origin: Origin,
}
