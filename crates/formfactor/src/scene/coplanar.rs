//! Which polygons share a plane.
use super::slab::Slab;
use crate::shapes::extent::Extent;
use crate::shapes::polygon::PlanarPolygon;
use glam::DVec3;
use std::collections::BTreeMap;

/// For each polygon the number of its plane: equal for polygons that lie in one plane but for roundings, whichever way they face.
///
/// A polygon is compared with others whose planes are in the same cell of a grid or within [`CLOSE`] of its own. What a rounding
/// sets further apart counts as two planes: this costs time only.
pub(super) fn planes(polygons: &[PlanarPolygon], slabs: &[Slab]) -> Vec<usize> {
    let points: Vec<DVec3> = polygons.iter().flat_map(PlanarPolygon::points).copied().collect();
    let extent = Extent::around(&points);
    let middle = extent.low.midpoint(extent.high);
    let size = extent.low.distance(extent.high);
    let areas: Vec<f64> = polygons.iter().map(PlanarPolygon::area).collect();
    // The larger one knows its plane better.
    let is_same = |id: usize, other: usize| {
        let [large, small] = if areas[id] > areas[other] { [id, other] } else { [other, id] };
        slabs[large].has(&polygons[small])
    };
    let mut known: BTreeMap<Key, Vec<usize>> = BTreeMap::new();
    let mut found: Vec<usize> = Vec::with_capacity(polygons.len());
    for (id, polygon) in polygons.iter().enumerate() {
        let height = polygon.normal().dot(polygon.points()[0] - middle) / size;
        let alike = keys(polygon.normal(), height).chain(keys(-polygon.normal(), -height));
        let same = alike.filter_map(|key| known.get(&key)).flatten().find(|other| is_same(id, **other));
        found.push(same.copied().unwrap_or(id));
        if same.is_none() {
            known.entry(key(polygon.normal(), height)).or_default().push(id);
        }
    }
    found
}

/// A cell of a grid of planes, by the normal and the height.
type Key = [i64; 4];

/// Cells of a grid by the length of a normal.
const CELLS: f64 = 16_384.0;

/// Planes that differ by less than this are looked for in neighbouring cells.
const CLOSE: f64 = 1e-6;

fn key(normal: DVec3, height: f64) -> Key {
    #[allow(clippy::cast_possible_truncation, reason = "none is larger than the number of cells")]
    [normal.x, normal.y, normal.z, height].map(|x| (x * CELLS).floor() as i64)
}

/// The cells within [`CLOSE`] of a plane: mostly one.
fn keys(normal: DVec3, height: f64) -> impl Iterator<Item = Key> {
    let [low, high] = [-CLOSE, CLOSE].map(|more| key(normal + more, height + more));
    let is_new = move |corner: &usize| (0..4).all(|axis| corner >> axis & 1 == 0 || low[axis] != high[axis]);
    let cell =
        move |corner: usize| [0, 1, 2, 3].map(|axis| if corner >> axis & 1 == 0 { low } else { high }[axis]);
    (0..16).filter(is_new).map(cell)
}
