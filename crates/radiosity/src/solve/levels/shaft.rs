//! What can stand between two convex polygons: it meets the convex hull of both.
use super::tiling::Tile;
use crate::extent::Extent;
use formfactor::PlanarPolygon;
use glam::DVec3;

/// A plane with the hull behind it: outward . p <= height.
#[derive(Clone, Copy, Debug)]
struct Wall {
    outward: DVec3,
    height: f64,
}

/// The convex hull of two polygons, as far as its box, the polygons' planes and planes through an edge of one and a corner of the other
/// bound it.
#[derive(Debug)]
pub(super) struct Shaft {
    low: DVec3,
    high: DVec3,
    walls: Vec<Wall>,
    /// What reaches less far into it hides nothing that counts.
    near: f64,
}

impl Shaft {
    /// The shaft between tiles; `near` is a length that does not count.
    pub(super) fn between(tiles: [&Tile; 2], near: f64) -> Shaft {
        let [first, second] = tiles.map(|tile| tile.outline.places().collect::<Vec<DVec3>>());
        let all = || first.iter().chain(&second);
        let mut shaft = Shaft {
            low: all().copied().fold(DVec3::INFINITY, DVec3::min),
            high: all().copied().fold(DVec3::NEG_INFINITY, DVec3::max),
            walls: Vec::new(),
            near,
        };
        // What lies behind one of the polygons hides nothing of it.
        for (tile, points) in tiles.iter().zip([&first, &second]) {
            let outward = -tile.normal;
            shaft.walls.push(Wall { outward, height: outward.dot(points[0]) });
        }
        shaft.enclose(&first, &second);
        shaft.enclose(&second, &first);
        shaft
    }

    /// Adds the planes through an edge of one polygon and a corner of the other that have both on one side.
    fn enclose(&mut self, edges: &[DVec3], corners: &[DVec3]) {
        for (k, &start) in edges.iter().enumerate() {
            let along = edges[(k + 1) % edges.len()] - start;
            for &corner in corners {
                let outward = along.cross(corner - start).normalize_or_zero();
                for outward in [outward, -outward] {
                    let height = outward.dot(start);
                    let behind = |p: &DVec3| outward.dot(*p) <= height + self.near;
                    if outward != DVec3::ZERO && edges.iter().chain(corners).all(behind) {
                        self.walls.push(Wall { outward, height });
                    }
                }
            }
        }
    }

    /// Whether a polygon in such a box is outside, but for what does not count.
    pub(super) fn misses(&self, polygon: &PlanarPolygon, extent: &Extent) -> bool {
        let margin = DVec3::splat(self.near);
        let beside = extent.low.cmpge(self.high - margin) | extent.high.cmple(self.low + margin);
        let beyond =
            |wall: &Wall| polygon.loops().flatten().all(|p| wall.outward.dot(*p) >= wall.height - self.near);
        beside.any() || self.walls.iter().any(beyond)
    }
}
