//! Triangles that cover a region.

mod delaunay;
mod indexed;
mod sweep;
#[cfg(test)]
mod tests;

use crate::region::Region;
use glam::DVec2;
use indexed::IndexedRegion;

impl Region {
    /// Triangles that cover the region and nothing else, without overlap, each counter-clockwise.
    ///
    /// Their vertices are the region's own: none is added, and two triangles meet in a whole edge, in a vertex or not at
    /// all. For every region: with n vertices, p polygons and h holes there are n + 2 (h − p) triangles if no rings touch.
    ///
    /// The triangulation is constrained Delaunay: of all that keep the region's edges it has the largest smallest
    /// angle. Exceptions are regions whose coordinates differ by more than 2^340 in size. If x and y can be scaled
    /// apart to mend that, the triangulation is Delaunay in the plane so scaled; else it is any.
    ///
    /// Expected O(n log n). Needs the feature `triangulate`.
    ///
    /// ```
    /// use polycsg::{FillRule, Region};
    /// let square = |low: f64, high: f64| [[low, low], [high, low], [high, high], [low, high]];
    /// let frame = Region::from_rings([square(0.0, 3.0), square(1.0, 2.0)], FillRule::EvenOdd)?;
    /// let triangles = frame.triangulate();
    /// assert_eq!(triangles.len(), 8);
    /// let area = |[a, b, c]: [polycsg::DVec2; 3]| (b - a).perp_dot(c - a) / 2.0;
    /// assert_eq!(triangles.into_iter().map(area).sum::<f64>(), frame.area());
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    pub fn triangulate(&self) -> Vec<[DVec2; 3]> {
        let outline = IndexedRegion::of(self);
        let triangles = delaunay::triangles(&outline).unwrap_or_else(|| sweep::triangles(&outline));
        triangles.into_iter().map(|ids| ids.map(|id| outline.points[id as usize])).collect()
    }
}
