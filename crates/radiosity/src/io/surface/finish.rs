//! Surfaces: polygons, where they stand, and what they reflect and emit.
use super::polygon::Facet;
use crate::scene::patch::Origin;
use crate::scene::texture::Image;
use glam::DMat4;
use std::sync::Arc;

/// What a surface reflects and emits, in red, green and blue.
#[derive(Clone, Debug)]
pub(in crate::io) struct Finish {
    /// The reflectance, or what the picture's colours are multiplied by.
    pub(in crate::io) reflectance: [f64; 3],
    /// Radiance.
    pub(in crate::io) emission: [f64; 3],
    pub(in crate::io) image: Option<Arc<Image>>,
    /// What takes the place of all that.
    pub(in crate::io) spectra: Option<Spectra>,
}

/// What a surface reflects and emits in bands of any number.
#[derive(Clone, Debug)]
pub(in crate::io) struct Spectra {
    pub(in crate::io) reflectance: Vec<f64>,
    /// Radiance.
    pub(in crate::io) emission: Vec<f64>,
}

/// Polygons of one material, in a node.
#[derive(Debug)]
pub(in crate::io) struct Surface<'s> {
    /// The node's name.
    pub(in crate::io) name: &'s str,
    /// Where in the file, for warnings.
    pub(in crate::io) place: &'s str,
    pub(in crate::io) facets: &'s [Facet],
    /// From the node to the world.
    pub(in crate::io) world: DMat4,
    pub(in crate::io) finish: Finish,
    /// Whether its back is a surface too.
    pub(in crate::io) two_sided: bool,
    /// Which instance, which primitive of it.
    pub(in crate::io) origin: Origin,
}
