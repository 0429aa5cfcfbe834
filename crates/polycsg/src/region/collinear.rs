//! Leaves out the vertices in the middle of straight edges.

use super::{Region, RegionBuilder};
use crate::base::id::index;
use crate::predicates::{Side, lexicographic, side};
use glam::DVec2;
use std::cmp::Ordering;

impl Region {
    /// The same set of points without the vertices that lie exactly on the straight line between their neighbours. Those stay
    /// in which rings touch: they are common vertices. O(n log n).
    ///
    /// Results keep such vertices, so that regions that share a border still share its vertices.
    ///
    /// ```
    /// use polycsg::{FillRule, Region};
    /// let square = |x: f64| Region::from_rings([[[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]], FillRule::NonZero);
    /// let both = square(0.0)?.union(&square(1.0)?);
    /// assert_eq!(both.rings().next().map(<[_]>::len), Some(6));
    /// assert_eq!(both.without_collinear_vertices().rings().next().map(<[_]>::len), Some(4));
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    #[must_use]
    pub fn without_collinear_vertices(&self) -> Region {
        let common = self.common_vertices();
        let is_common = |p: DVec2| common.binary_search_by(|&q| lexicographic(q, p)).is_ok();
        let mut builder = RegionBuilder::with_capacity(self.rings.point_count(), self.rings.len());
        for polygon in self.polygons() {
            builder.polygon(index(polygon.depth));
            for ring in polygon.first..polygon.end {
                // A ring starts in its leftmost point, which is a corner.
                let points = self.rings.closed(ring);
                let turns =
                    points.windows(3).filter(|p| side(p[0], p[1], p[2]) != Side::On || is_common(p[1]));
                let corners: Vec<DVec2> = turns.map(|p| p[1]).collect();
                builder.ring([&points[..1], &corners]);
            }
        }
        builder.build()
    }

    /// The points in which rings touch, sorted.
    fn common_vertices(&self) -> Vec<DVec2> {
        let mut points: Vec<DVec2> = self.rings().flatten().copied().collect();
        points.sort_unstable_by(|a, b| lexicographic(*a, *b));
        let twice = points.windows(2).filter(|pair| lexicographic(pair[0], pair[1]) == Ordering::Equal);
        twice.map(|pair| pair[0]).collect()
    }
}
