//! What all readers do with the polygons of a file.
//!
//! ```text
//! place     into the world, with names
//! planar    non-planar polygons and bow ties are split, those without area left out, with a warning
//! flaws     what was wrong with a surface's polygons, told once
//! merge     triangles that form a planar polygon become that polygon, when exact
//! split     a polygon cut into triangles
//! lamps     lamps where their nodes put them
//! finish    what a surface reflects and emits
//! polygon   polygons as a file gives them
//! changes   what became of them when the scene was repaired
//! sidedness which of them keep two sides then
//! ```
pub(super) mod changes;
pub(super) mod finish;
mod flaws;
pub(super) mod lamps;
mod merge;
pub(super) mod place;
mod planar;
pub(super) mod polygon;
mod sidedness;
pub(super) mod split;

use crate::scene::patch::Patch;
use glam::DVec2;
use polygon::{Corner, Facet, Polygon};

/// Whether polygons are triangles only, as exporters cut them, so that they may be joined.
pub(super) fn is_cut(polygons: &[Polygon]) -> bool {
    polygons.iter().all(|polygon| matches!(polygon.as_slice(), [ring] if ring.len() == 3))
}

/// A patch cut into triangles, for formats that have nothing else; with places in its picture.
pub(super) fn cut(patch: &Patch) -> Vec<[Corner; 3]> {
    let place = |point| patch.texture.as_ref().map_or(DVec2::ZERO, |texture| texture.place(point));
    let corner = |&point: &_| Corner { point, place: place(point), ..Corner::default() };
    let loops: Polygon = patch.polygon.loops().map(|ring| ring.iter().map(corner).collect()).collect();
    match loops.as_slice() {
        [ring] if ring.len() == 3 => vec![[ring[0], ring[1], ring[2]]],
        _ => split::split(&loops),
    }
}

/// The facets of some polygons. Those of a format that has nothing but triangles are joined where they form planar
/// polygons; of a picture's coordinates only those are kept that a picture needs.
pub(super) fn facets(polygons: &[Polygon], is_cut: bool, textured: bool) -> Vec<Facet> {
    let place = |corner: Corner| if textured { corner } else { Corner { place: DVec2::ZERO, ..corner } };
    if is_cut {
        let triangle = |polygon: &Polygon| [0, 1, 2].map(|corner| place(polygon[0][corner]));
        return merge::merge(&polygons.iter().map(triangle).collect::<Vec<_>>());
    }
    let facet = |(number, loops): (usize, &Polygon)| Facet {
        number,
        loops: loops.clone(),
        parts: Vec::new(),
        members: vec![number],
    };
    polygons.iter().enumerate().map(facet).collect()
}
