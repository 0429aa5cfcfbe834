//! Triangles under a name.
use crate::io::surface::polygon::Polygon;

/// The triangles of one solid, and where they begin.
pub(super) struct Solid {
    pub(super) name: String,
    pub(super) place: String,
    pub(super) triangles: Vec<Polygon>,
}
