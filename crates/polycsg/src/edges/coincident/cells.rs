//! A grid over all edges.

use crate::base::id::index;
use crate::predicates::Segment;
use glam::DVec2;
use std::ops::Range;

/// A grid over the box of all points.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cells {
    half_low: DVec2,
    half_size: DVec2,
    factor: DVec2,
    columns: u32,
}

impl Cells {
    /// With so many edges in each, on the average.
    pub(super) fn over(points: &[DVec2], edges_per_cell: usize) -> Cells {
        let (low, high) =
            points.iter().fold((DVec2::MAX, DVec2::MIN), |(low, high), &p| (low.min(p), high.max(p)));
        // Halves, so that the width of any finite interval is finite.
        let (half_low, half_size) = (low * 0.5, high * 0.5 - low * 0.5);
        Cells { half_low, half_size, factor: DVec2::ZERO, columns: 1 }.with(points.len() / edges_per_cell)
    }

    /// About so many cells, over the same box; of no width at all, one.
    pub(super) fn with(self, count: usize) -> Cells {
        let columns = index(count.isqrt() + 1);
        let factor = f64::from(columns) / self.half_size;
        Cells { factor: DVec2::select(factor.is_finite_mask(), factor, DVec2::ZERO), columns, ..self }
    }

    /// How many there are.
    pub(super) fn len(self) -> usize {
        self.columns.pow(2) as usize
    }

    /// The cell of the low corner of an edge's box, the same for both directions.
    #[inline]
    pub(super) fn of(self, [a, b]: Segment) -> u32 {
        self.at(a.min(b))
    }

    /// The cell of a point.
    #[inline]
    pub(super) fn at(self, p: DVec2) -> u32 {
        let [column, row] = self.place(p);
        row * self.columns + column
    }

    /// The cells that a box touches, row by row.
    pub(super) fn within(self, low: DVec2, high: DVec2) -> impl Iterator<Item = Range<u32>> {
        let ([left, bottom], [right, top]) = (self.place(low), self.place(high));
        (bottom..=top).map(move |row| row * self.columns + left..row * self.columns + right + 1)
    }

    /// How many there are in a row, and in a column.
    pub(super) fn columns(self) -> usize {
        self.columns as usize
    }

    /// Column and row: weakly monotone in the coordinates.
    #[inline]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "casts saturate")]
    pub(super) fn place(self, p: DVec2) -> [u32; 2] {
        let place = (p * 0.5 - self.half_low) * self.factor;
        [place.x as u32, place.y as u32].map(|i| i.min(self.columns - 1))
    }
}
