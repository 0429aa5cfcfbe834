//! Which polygons share a plane.
use crate::shapes::polygon::PlanarPolygon;
use glam::DVec3;
use std::collections::BTreeMap;

/// For each polygon the number of its plane: equal for polygons that lie in one plane exactly, whichever way they face.
///
/// Polygons are compared where their planes agree in single precision. Where a rounding sets two apart there, they count as two
/// planes: this costs time only.
pub(crate) fn planes(polygons: &[PlanarPolygon]) -> Vec<usize> {
    let mut known: BTreeMap<[u32; 4], Vec<usize>> = BTreeMap::new();
    let mut found: Vec<usize> = Vec::with_capacity(polygons.len());
    for (id, polygon) in polygons.iter().enumerate() {
        let alike = known.entry(key(polygon)).or_default();
        let same = alike.iter().find(|other| polygon.lies_in_plane_of(&polygons[**other]));
        found.push(same.copied().unwrap_or(id));
        if same.is_none() {
            alike.push(id);
        }
    }
    found
}

/// The plane in single precision, its normal with the sign that makes its largest component positive.
fn key(polygon: &PlanarPolygon) -> [u32; 4] {
    let normal = polygon.normal();
    let upward: DVec3 = if normal[polygon.axes()[2]] < 0.0 { -normal } else { normal };
    let height = upward.dot(polygon.points()[0]);
    #[allow(clippy::cast_possible_truncation, reason = "a key in single precision is meant")]
    [upward.x, upward.y, upward.z, height].map(|x| (x as f32 + 0.0).to_bits())
}
