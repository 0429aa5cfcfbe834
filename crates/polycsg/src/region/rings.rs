//! Rings in one flat array: the storage of raw input and of regions.

use crate::error::Error;
use glam::DVec2;
use std::ops::Range;

/// Closed chains of points. Stored with the first point once more behind the last, so that an edge is two points in a
/// row; shown without.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Rings {
    points: Vec<DVec2>,
    /// Where each ring but the first starts, so that one ring takes one allocation.
    starts: Vec<usize>,
    /// Where the next ring starts.
    end: usize,
}

impl Rings {
    /// Reads rings of finite points; `-0.0` becomes `0.0`. Rings of no points are left out.
    pub(crate) fn read<R, P>(rings: R) -> Result<Rings, Error>
    where
        R: IntoIterator,
        R::Item: AsRef<[P]>,
        P: Copy + Into<DVec2>,
    {
        let mut read = Rings::default();
        let rings = rings.into_iter();
        let (least, _) = rings.size_hint();
        read.starts.reserve_exact(least.saturating_sub(1));
        for (ring, points) in rings.enumerate() {
            let points = points.as_ref();
            read.make_room(points.len() + 1, least.saturating_sub(ring));
            read.read_ring(ring, points.iter().map(|&point| point.into()))?;
        }
        Ok(read)
    }

    /// Makes room for the points of a ring and, where that takes a new allocation, of more rings like those so far: of
    /// `left` in all, but no more than four times as many points as there are.
    fn make_room(&mut self, points: usize, left: usize) {
        if self.end > 0 && self.points.capacity() - self.end < points {
            let mean = self.end / self.len() + 1;
            self.points.reserve(points.max(mean.saturating_mul(left).min(4 * self.end)));
        }
    }

    /// Reads one more ring; an error names it by its number.
    pub(crate) fn read_ring(
        &mut self,
        ring: usize,
        points: impl ExactSizeIterator<Item = DVec2>,
    ) -> Result<(), Error> {
        match self.end {
            0 => self.points = Vec::with_capacity(points.len() + 1),
            _ => self.points.reserve(points.len() + 1),
        }
        self.points.extend(points.map(|point| point + DVec2::ZERO));
        let read = &self.points[self.end..];
        // Nothing but NaN and the infinities has a product with 0 that is not 0.
        if read.iter().fold(DVec2::ZERO, |sum, &point| sum + point * 0.0) != DVec2::ZERO {
            let vertex = read.iter().take_while(|point| point.is_finite()).count();
            return Err(Error::NonFinite { ring, vertex });
        }
        self.close();
        Ok(())
    }

    pub(crate) fn with_capacity(points: usize, rings: usize) -> Rings {
        let starts = Vec::with_capacity(rings.saturating_sub(1));
        Rings { points: Vec::with_capacity(points + rings), starts, end: 0 }
    }

    pub(crate) fn clear(&mut self) {
        self.points.clear();
        self.starts.clear();
        self.end = 0;
    }

    pub(crate) fn extend(&mut self, points: &[DVec2]) {
        self.points.extend_from_slice(points);
    }

    /// Ends the ring whose points were pushed since the last call.
    pub(crate) fn close(&mut self) {
        let Some(&first) = self.points.get(self.end) else { return };
        self.points.push(first);
        if self.end > 0 {
            self.starts.push(self.end);
        }
        self.end = self.points.len();
    }

    pub(crate) fn len(&self) -> usize {
        if self.end == 0 { 0 } else { self.starts.len() + 1 }
    }

    /// The number of points of all rings.
    pub(crate) fn point_count(&self) -> usize {
        self.points.len() - self.len()
    }

    /// The number of points of the rings before a ring.
    pub(crate) fn start(&self, ring: usize) -> usize {
        self.slots(ring).start - ring
    }

    /// All points in a row, each ring's first point once more behind it.
    pub(crate) fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Where a ring stands in [`points`](Rings::points), its repeated point included.
    pub(crate) fn slots(&self, ring: usize) -> Range<usize> {
        let start = if ring == 0 { 0 } else { self.starts[ring - 1] };
        start..self.starts.get(ring).copied().unwrap_or(self.end)
    }

    /// The ring that a slot belongs to.
    pub(crate) fn ring_at(&self, slot: usize) -> usize {
        self.starts.partition_point(|&start| start <= slot)
    }

    pub(crate) fn ring(&self, ring: usize) -> &[DVec2] {
        let slots = self.slots(ring);
        &self.points[slots.start..slots.end - 1]
    }

    /// A ring with its first point once more at the end.
    pub(crate) fn closed(&self, ring: usize) -> &[DVec2] {
        &self.points[self.slots(ring)]
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &[DVec2]> + Clone {
        (0..self.len()).map(|ring| self.ring(ring))
    }
}

/// The directed edges of a ring.
pub(crate) fn ring_edges(ring: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> + Clone + '_ {
    (0..ring.len()).map(|i| [ring[i], ring[if i + 1 == ring.len() { 0 } else { i + 1 }]])
}
