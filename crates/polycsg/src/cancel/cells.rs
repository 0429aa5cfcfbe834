//! A grid over all edges.

use crate::predicates::Segment;
use crate::truth::index;
use glam::DVec2;
use std::ops::Range;

/// So many edges are in a cell on the average.
const EDGES_PER_CELL: usize = 64;

/// A grid over the box of all points.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cells {
    half_low: DVec2,
    factor: DVec2,
    columns: u32,
}

impl Cells {
    pub(super) fn over(points: &[DVec2]) -> Cells {
        let (low, high) =
            points.iter().fold((DVec2::MAX, DVec2::MIN), |(low, high), &p| (low.min(p), high.max(p)));
        let columns = index((points.len() / EDGES_PER_CELL).isqrt() + 1);
        // Halves, so that the width of any finite interval is finite; of no width at all, one cell.
        let factor = f64::from(columns) / (high * 0.5 - low * 0.5);
        let factor = DVec2::select(factor.is_finite_mask(), factor, DVec2::ZERO);
        Cells { half_low: low * 0.5, factor, columns }
    }

    /// How many there are.
    pub(super) fn len(self) -> usize {
        self.columns.pow(2) as usize
    }

    /// The cell of an edge's middle, the same for both directions.
    #[inline]
    pub(super) fn of(self, [a, b]: Segment) -> u32 {
        self.at_half(a * 0.25 + b * 0.25)
    }

    /// The cell of a point.
    #[inline]
    pub(super) fn at(self, p: DVec2) -> u32 {
        self.at_half(p * 0.5)
    }

    /// The cells that a box touches, row by row.
    pub(super) fn within(self, low: DVec2, high: DVec2) -> impl Iterator<Item = Range<u32>> {
        let ([left, bottom], [right, top]) = (self.place(low * 0.5), self.place(high * 0.5));
        (bottom..=top).map(move |row| row * self.columns + left..row * self.columns + right + 1)
    }

    #[inline]
    fn at_half(self, half: DVec2) -> u32 {
        let [column, row] = self.place(half);
        row * self.columns + column
    }

    /// Column and row: weakly monotone in the coordinates.
    #[inline]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "casts saturate")]
    fn place(self, half: DVec2) -> [u32; 2] {
        let place = (half - self.half_low) * self.factor;
        [place.x as u32, place.y as u32].map(|i| i.min(self.columns - 1))
    }
}
