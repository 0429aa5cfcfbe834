//! What all readers do with the polygons of a file.
//!
//! ```text
//! merge   triangles that form a planar polygon become that polygon, when exact
//! place   into the world; non-planar polygons are split, those without area left out, with a warning
//! name    every patch gets a name of its own
//! ```
mod merge;
mod place;
mod split;
mod warn;

pub(super) use place::{MAX_PATCHES, Refusal, Surfaces};

use crate::Image;
use glam::{DMat4, DVec2, DVec3};
use std::sync::Arc;

/// A polygon's vertex as the file gives it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Corner {
    pub(super) point: DVec3,
    /// Where in the texture's picture, u to the right, v down; zero where the file says nothing.
    pub(super) place: DVec2,
    /// The shading normal; zero where the file says nothing.
    pub(super) normal: DVec3,
}

/// The outline, counter-clockwise seen from the front, then the holes.
pub(super) type Polygon = Vec<Vec<Corner>>;

/// A polygon in its node's coordinates.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    /// Index of the (first) polygon of the file that it is made of.
    pub(super) number: usize,
    pub(super) loops: Polygon,
    /// The file's triangles, where it was joined from several.
    pub(super) parts: Vec<[Corner; 3]>,
}

/// The facets of some polygons. Those of a format that has nothing but triangles are joined where they form planar
/// polygons; of a picture's coordinates only those are kept that a picture needs.
pub(super) fn facets(polygons: &[Polygon], is_cut: bool, textured: bool) -> Vec<Facet> {
    let place = |corner: Corner| if textured { corner } else { Corner { place: DVec2::ZERO, ..corner } };
    if is_cut {
        let triangle = |polygon: &Polygon| [0, 1, 2].map(|corner| place(polygon[0][corner]));
        return merge::merge(&polygons.iter().map(triangle).collect::<Vec<_>>());
    }
    let facet =
        |(number, loops): (usize, &Polygon)| Facet { number, loops: loops.clone(), parts: Vec::new() };
    polygons.iter().enumerate().map(facet).collect()
}

/// What a surface reflects and emits, in red, green and blue.
#[derive(Clone, Debug)]
pub(super) struct Finish {
    /// The reflectance, or what the picture's colours are multiplied by.
    pub(super) reflectance: [f64; 3],
    /// Radiance.
    pub(super) emission: [f64; 3],
    pub(super) image: Option<Arc<Image>>,
    /// What takes the place of all that.
    pub(super) spectra: Option<Spectra>,
}

/// What a surface reflects and emits in bands of any number.
#[derive(Clone, Debug)]
pub(super) struct Spectra {
    pub(super) reflectance: Vec<f64>,
    /// Radiance.
    pub(super) emission: Vec<f64>,
}

/// Polygons of one material, in a node.
#[derive(Debug)]
pub(super) struct Surface<'s> {
    /// The node's name.
    pub(super) name: &'s str,
    /// Where in the file, for warnings.
    pub(super) place: &'s str,
    pub(super) facets: &'s [Facet],
    /// From the node to the world.
    pub(super) world: DMat4,
    pub(super) finish: Finish,
    /// Whether its back is a surface too.
    pub(super) two_sided: bool,
    /// Which instance, which primitive of it.
    pub(super) origin: crate::Origin,
}

/// A point as a key; −0 and 0 are one.
fn bits(point: DVec3) -> [u64; 3] {
    point.to_array().map(|number| (number + 0.0).to_bits())
}
