//! Regions mapped by affine maps.

use crate::error::Error;
use crate::expression::csg::{Csg, FillRule};
use crate::region::Region;
use glam::{DAffine2, DVec2};

impl Region {
    /// The region under an affine map: moved, turned, scaled, sheared or mirrored.
    ///
    /// Each vertex is mapped in floating point: each coordinate a x + b y + t is within 2^-51 (|a x| + |b y| + |t|) of the
    /// exact one. The region that these vertices bound is then evaluated exactly, so that the result is valid whatever
    /// rounding did. Where rounding made edges cross, crossings become vertices; parts that shrank to nothing are gone.
    ///
    /// Nothing is rounded, and the result is the exact image, under scaling by powers of two within the range, mirrors,
    /// quarter turns given by exact zeros and ones (not by a sine of π/2), and translations whose sums are doubles.
    ///
    /// Expected O(n log n).
    ///
    /// # Errors
    /// [`Error::NonFinite`] when a mapped vertex leaves the range, or when the map holds a NaN or an infinity. It names the ring
    /// in the order of [`rings`](Region::rings), and the vertex.
    ///
    /// ```
    /// use polycsg::{DVec2, FillRule, Region, glam::DAffine2};
    /// let triangle = Region::from_rings([[[0.0, 0.0], [4.0, 0.0], [0.0, 2.0]]], FillRule::NonZero)?;
    /// let moved = triangle.map_affine(DAffine2::from_translation(DVec2::new(10.0, 0.5)))?;
    /// assert_eq!(moved.polygons().next().expect("a triangle").outer()[0], DVec2::new(10.0, 0.5));
    /// let mirrored = triangle.map_affine(DAffine2::from_scale(DVec2::new(-1.0, 1.0)))?;
    /// assert_eq!(mirrored.area(), 4.0); // counter-clockwise again
    /// let turned = triangle.map_affine(DAffine2::from_angle(0.1))?;
    /// assert_eq!(turned.validate(), Ok(()));
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    pub fn map_affine(&self, map: DAffine2) -> Result<Region, Error> {
        let mapped = |ring: &[DVec2]| ring.iter().map(|&p| map.transform_point2(p)).collect::<Vec<_>>();
        // Rings of a region bound it whichever way they run: mirrors need no case of their own.
        Ok(Csg::from_rings(self.rings().map(mapped), FillRule::EvenOdd)?.evaluate())
    }
}
