//! A grid over all edges.

use crate::base::{corners::corners, id::index};
use glam::DVec2;
use std::ops::Range;

/// A grid over the box of all points.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cells {
    half_low: DVec2,
    factor: DVec2,
    columns: u32,
}

impl Cells {
    /// About so many cells over all points; where these have no width at all, one.
    pub(super) fn over(points: &[DVec2], count: usize) -> Cells {
        let [low, high] = corners(points);
        // Halves, so that the width of any finite interval is finite.
        let (half_low, half_size) = (low * 0.5, high * 0.5 - low * 0.5);
        let columns = index(count.isqrt() + 1);
        let factor = f64::from(columns) / half_size;
        let factor = DVec2::select(factor.is_finite_mask(), factor, DVec2::ZERO);
        Cells { half_low, factor, columns }
    }

    /// How many there are.
    pub(super) fn len(self) -> usize {
        self.columns.pow(2) as usize
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
