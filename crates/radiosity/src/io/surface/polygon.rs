//! Polygons as a file gives them.
use glam::{DVec2, DVec3};

/// A polygon's vertex as the file gives it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Corner {
    pub(crate) point: DVec3,
    /// Where in the texture's picture, u to the right, v down; zero where the file says nothing.
    pub(crate) place: DVec2,
    /// The shading normal; zero where the file says nothing.
    pub(crate) normal: DVec3,
}

/// The outline, counter-clockwise seen from the front, then the holes.
pub(crate) type Polygon = Vec<Vec<Corner>>;

/// A polygon in its node's coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Facet {
    /// Index of the (first) polygon of the file that it is made of.
    pub(crate) number: usize,
    pub(crate) loops: Polygon,
    /// The file's triangles, where it was joined from several.
    pub(crate) parts: Vec<[Corner; 3]>,
    /// Indices of all polygons of the file that it is made of.
    pub(crate) members: Vec<usize>,
}

/// The points of a ring.
pub(super) fn points(ring: &[Corner]) -> Vec<DVec3> {
    ring.iter().map(|corner| corner.point).collect()
}

/// A point as a key; −0 and 0 are one.
pub(crate) fn bits(point: DVec3) -> [u64; 3] {
    point.to_array().map(|number| (number + 0.0).to_bits())
}
