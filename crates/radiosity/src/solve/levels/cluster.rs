//! A cluster: tiles near each other, as what is far away sees them.
use super::tiling::{Tile, Tiling};
use super::ways::{Ways, ways};
use crate::extent::Extent;
use glam::DVec3;
use std::{cmp::Ordering, ops::Range};

/// What is far from a cluster is so far that this reaches no more of the way than such a share, …
const REACH: f64 = 0.6;
/// … or so much where it is a tile of many patches, each of which is told its light.
const REACH_OF_MANY: f64 = 0.3;
/// Of clusters with more normals it is not asked whether all turn away.
const NORMALS: usize = 8;
/// Normals that differ by less than this from the axis of their cone are along it.
const FLAT: f64 = 1e-12;
/// What rises above a flat cluster by less than this share of its distance does not.
const LOW: f64 = 1e-9;

/// Whole tiles near each other, or one that may be a part.
#[derive(Clone, Debug)]
pub(super) struct Cluster {
    /// Places in the order of all tiles.
    pub(super) members: Range<usize>,
    pub(super) halves: Option<[usize; 2]>,
    pub(super) extent: Extent,
    pub(super) centre: DVec3,
    pub(super) radius: f64,
    /// What is far is farther away than this.
    pub(super) reach: f64,
    /// The normals of its tiles, each once.
    normals: Vec<DVec3>,
    /// All normals are within an angle of this, in radians.
    axis: DVec3,
    spread: f64,
    /// The least height of all corners along the axis.
    low: f64,
    /// The areas of its tiles by the ways that they face.
    pub(super) faces: Ways,
}

impl Cluster {
    /// One tile.
    pub(super) fn of_tile(tiling: &Tiling<'_>, tile: usize) -> Cluster {
        let extent = Extent::of_points(tiling.tiles[tile].outline.places());
        Cluster::of(tiling, &[tile], 0..1, extent)
    }

    pub(super) fn of(tiling: &Tiling<'_>, tiles: &[usize], members: Range<usize>, extent: Extent) -> Cluster {
        let all = || tiles.iter().map(|tile| &tiling.tiles[*tile]);
        let centre = (extent.low + extent.high) / 2.0;
        let places = || all().flat_map(|tile| tile.outline.places());
        let radius = places().map(|place| place.distance(centre)).fold(0.0, f64::max);
        let is_of_many = |tile: &Tile| tiling.grain[tile.patch].is_some_and(|grain| tile.area > grain);
        let reach = if all().any(is_of_many) { REACH_OF_MANY } else { REACH };
        let mut normals: Vec<DVec3> = all().map(|tile| tile.normal).collect();
        normals.sort_unstable_by(|a, b| a.to_array().partial_cmp(&b.to_array()).unwrap_or(Ordering::Equal));
        normals.dedup();
        let axis = all().map(|tile| tile.normal).sum::<DVec3>().normalize_or_zero();
        let spread = all().map(|tile| (1.0 - axis.dot(tile.normal)).max(0.0)).fold(0.0, f64::max);
        let faces = all().fold([0.0; 6], |mut sums, tile| {
            sums.iter_mut().zip(ways(tile.normal)).for_each(|(sum, part)| *sum += tile.area * part);
            sums
        });
        Cluster {
            members,
            halves: None,
            faces,
            normals,
            extent,
            centre,
            radius,
            reach: radius / reach,
            axis,
            low: places().map(|place| axis.dot(place)).fold(f64::INFINITY, f64::min),
            spread: if spread <= FLAT { 0.0 } else { (1.0 - spread).clamp(-1.0, 1.0).acos() },
        }
    }

    /// Whether a place may be before some tile of it, wherever that is in it.
    pub(super) fn looks_at(&self, place: DVec3) -> bool {
        let way = (place - self.centre).normalize_or_zero();
        self.normals.iter().any(|normal| normal.dot(way) > 0.0)
    }

    /// Whether some tile of it may face where a way to its centre comes from.
    pub(super) fn may_face(&self, way: DVec3) -> bool {
        self.normals.len() > NORMALS || self.normals.iter().any(|normal| normal.dot(way) < self.radius)
    }

    /// The areas of tiles times the largest cosine between their normals and ways to another cluster: of all its tiles, and of those whose planes
    /// pass through that.
    pub(super) fn rise(&self, tiling: &Tiling<'_>, tiles: &[usize], to: &Cluster) -> [f64; 2] {
        let corners = to.extent.corners();
        let mut sums = [0.0; 2];
        for tile in tiles.iter().map(|tile| &tiling.tiles[*tile]) {
            let on = tile.outline.corners[0].1;
            let cosine = |place: &DVec3| tile.normal.dot(*place - on) / place.distance(self.centre);
            let cosines = corners.each_ref().map(cosine);
            let rise = tile.area * cosines.into_iter().fold(0.0, f64::max).min(1.0);
            let is_through = cosines.iter().any(|cosine| *cosine < -LOW);
            sums[0] += rise;
            sums[1] += if is_through { rise } else { 0.0 };
        }
        sums
    }

    /// Whether some tile of it may have a part of another cluster before it.
    pub(super) fn may_see(&self, other: &Cluster) -> bool {
        let way = other.centre - self.centre;
        if self.spread == 0.0 {
            // All its tiles lie at least as high as the lowest corner.
            let low = self.low + LOW * way.length();
            return other.extent.corners().iter().any(|place| self.axis.dot(*place) > low);
        }
        let reach = (self.radius + other.radius) / way.length();
        if reach >= 1.0 {
            return true;
        }
        let between = self.axis.dot(way / way.length()).clamp(-1.0, 1.0).acos();
        between - self.spread - reach.asin() < std::f64::consts::FRAC_PI_2
    }
}
