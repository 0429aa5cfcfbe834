//! Rings in one flat array: the storage of raw input and of regions.

use crate::Error;
use glam::DVec2;
use std::ops::Range;

/// Closed chains of points, the first point not repeated.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Rings {
    points: Vec<DVec2>,
    ends: Vec<usize>,
}

impl Rings {
    /// Reads rings of finite points; `-0.0` becomes `0.0`.
    pub(crate) fn read<R, P>(rings: R) -> Result<Rings, Error>
    where
        R: IntoIterator,
        R::Item: AsRef<[P]>,
        P: Copy + Into<DVec2>,
    {
        let mut read = Rings::default();
        for (ring, points) in rings.into_iter().enumerate() {
            for (vertex, &point) in points.as_ref().iter().enumerate() {
                let point: DVec2 = point.into();
                if !point.is_finite() {
                    return Err(Error::NonFinite { ring, vertex });
                }
                read.points.push(point + DVec2::ZERO);
            }
            read.close();
        }
        Ok(read)
    }

    pub(crate) fn with_capacity(points: usize, rings: usize) -> Rings {
        Rings { points: Vec::with_capacity(points), ends: Vec::with_capacity(rings) }
    }

    pub(crate) fn push(&mut self, point: DVec2) {
        self.points.push(point);
    }

    /// Ends the ring whose points were pushed since the last call.
    pub(crate) fn close(&mut self) {
        self.ends.push(self.points.len());
    }

    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The number of points before a ring.
    pub(crate) fn start(&self, ring: usize) -> usize {
        if ring == 0 { 0 } else { self.ends[ring - 1] }
    }

    fn span(&self, ring: usize) -> Range<usize> {
        self.start(ring)..self.ends[ring]
    }

    pub(crate) fn ring(&self, ring: usize) -> &[DVec2] {
        &self.points[self.span(ring)]
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &[DVec2]> + Clone {
        (0..self.len()).map(|ring| self.ring(ring))
    }
}

/// The directed edges of a ring.
pub(crate) fn ring_edges(ring: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> + Clone + '_ {
    (0..ring.len()).map(|i| [ring[i], ring[if i + 1 == ring.len() { 0 } else { i + 1 }]])
}
