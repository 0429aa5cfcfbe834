//! What is drawn.
use crate::mesh::element::Mesh;
use crate::scene::texture::Image;
use glam::DVec2;

/// A mesh with light and pictures on it.
pub(crate) struct Painting<'p> {
    pub(crate) mesh: &'p Mesh,
    /// At every vertex: radiosity, or what falls on a patch that shows a picture.
    pub(crate) light: &'p [[f64; 3]],
    /// Where in its picture each vertex of such a patch lies.
    pub(crate) places: &'p [DVec2],
    /// The picture of each patch that shows one.
    pub(crate) images: &'p [Option<&'p Image>],
}
