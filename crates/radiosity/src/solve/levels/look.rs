//! What points see of tiles.
use super::tiling::{Tile, Tiling};
use formfactor::DifferentialArea;
use glam::DVec3;

/// What rises above a plane by less than this share of how far away it is, is in it.
const NEAR: f64 = 1e-12;

/// What a point sees of a tile: the integrals over it of the kernel times each function.
pub(super) fn look(tiling: &Tiling<'_>, point: &DifferentialArea, to: &Tile, among: &[usize]) -> [f64; 3] {
    if !to.outline.corners.iter().any(|(_, place)| rises(*place, point)) {
        return [0.0; 3];
    }
    let (factor, centroid) = tiling.enclosure.form_factor_and_centroid(point, to.surface, &to.polygon, among);
    // Where hardly anything is seen the centroid is not known.
    let linear = to.outline.linear(tiling.flatten(to.patch, centroid)).map(|value| value.clamp(-2.0, 2.0));
    [factor.value, factor.value * linear[0], factor.value * linear[1]]
}

/// Whether a place is above the plane of a point.
pub(super) fn rises(place: DVec3, point: &DifferentialArea) -> bool {
    let way = place - point.position();
    point.normal().dot(way) > NEAR * way.length()
}
