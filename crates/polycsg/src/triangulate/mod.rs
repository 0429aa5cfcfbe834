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
    /// Triangles that cover exactly the region, without overlap, each counter-clockwise.
    ///
    /// No vertex is added, and two triangles meet in a whole edge, in a vertex or not at all. This works for every region. With
    /// n vertices, p polygons and h holes there are n + 2 (h − p) triangles if no rings touch.
    ///
    /// The triangulation is constrained Delaunay: of all that keep the region's edges it has the largest smallest
    /// angle. Exceptions are regions whose coordinates differ in size by a factor of more than 2^340. If scaling x and y apart brings
    /// them closer, the triangulation is Delaunay in the plane scaled like that. Otherwise it is any triangulation.
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
    #[must_use]
    pub fn triangulate(&self) -> Vec<[DVec2; 3]> {
        let outline = IndexedRegion::of(self);
        let triangles = delaunay::triangles(&outline).unwrap_or_else(|| sweep::triangles(&outline));
        triangles.into_iter().map(|ids| ids.map(|id| outline.points[id as usize])).collect()
    }
}
