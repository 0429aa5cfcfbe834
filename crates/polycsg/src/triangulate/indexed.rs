//! A region's points by number, as both triangulations take them.

use crate::base::id::index;
use crate::predicates::lexicographic;
use crate::region::{Region, rings::ring_edges};
use glam::DVec2;
use std::cmp::Ordering;

/// A region's distinct points in lexicographic order, and its directed edges between them, sorted.
#[derive(Debug)]
pub(super) struct IndexedRegion {
    pub(super) points: Vec<DVec2>,
    pub(super) edges: Vec<[u32; 2]>,
}

impl IndexedRegion {
    pub(super) fn of(region: &Region) -> IndexedRegion {
        let mut points: Vec<DVec2> = region.rings().flatten().copied().collect();
        points.sort_unstable_by(|&a, &b| lexicographic(a, b));
        points.dedup();
        let id = |p: DVec2| index(points.partition_point(|&q| lexicographic(q, p) == Ordering::Less));
        let mut edges: Vec<[u32; 2]> = region.rings().flat_map(ring_edges).map(|edge| edge.map(id)).collect();
        edges.sort_unstable();
        IndexedRegion { points, edges }
    }
}
