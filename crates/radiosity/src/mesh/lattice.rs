//! Equal rectangular cells over a patch.
use glam::DVec2;
use polycsg::Region;
use std::collections::BTreeSet;

/// How often a cell may be halved.
pub(crate) const LEVELS: u8 = 3;
/// Parts of a side of a cell that is halved as often as may be.
const FINEST: usize = 1 << LEVELS;

/// Cells over a region's bounding rectangle, in a patch's frame.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lattice {
    corner: DVec2,
    /// Width and height of a cell.
    pub(super) step: DVec2,
    /// Columns and rows.
    pub(super) cells: [usize; 2],
}

impl Lattice {
    /// The lattice over a region whose steps are nearest to `spacing`.
    pub(super) fn over(region: &Region, spacing: f64) -> Lattice {
        let points = || region.rings().flatten().copied();
        let corner = points().fold(DVec2::INFINITY, DVec2::min);
        let extent = points().fold(DVec2::NEG_INFINITY, DVec2::max) - corner;
        let cells = [parts(extent.x, spacing), parts(extent.y, spacing)];
        Lattice { corner, step: extent / DVec2::new(cells[0] as f64, cells[1] as f64), cells }
    }

    /// The points inside the rectangle: the corners of all cells, each cell cut in 2^level parts each way. Row by row,
    /// each once.
    pub(super) fn points(&self, levels: &[u8]) -> Vec<DVec2> {
        let mut found = BTreeSet::new();
        for (j, i) in (0..self.cells[1]).flat_map(|j| (0..self.cells[0]).map(move |i| (j, i))) {
            let level = levels.get(j * self.cells[0] + i).copied().unwrap_or(0);
            let (parts, step) = (1usize << level, FINEST >> level);
            let along = |cell: usize| (0..=parts).map(move |k| cell * FINEST + k * step);
            found.extend(along(j).flat_map(|y| along(i).map(move |x| (y, x))));
        }
        let [right, top] = self.cells.map(|cells| cells * FINEST);
        let inner = found.into_iter().filter(|&(y, x)| 0 < x && x < right && 0 < y && y < top);
        let place = |(y, x): (usize, usize)| DVec2::new(x as f64, y as f64) / FINEST as f64;
        inner.map(|point| self.corner + self.step * place(point)).collect()
    }

    /// The lower and the upper corner.
    pub(super) fn bounds(&self) -> [DVec2; 2] {
        let extent = self.step * DVec2::new(self.cells[0] as f64, self.cells[1] as f64);
        [self.corner, self.corner + extent]
    }

    /// The number of the cell that holds a point, row by row.
    pub(super) fn index(&self, point: DVec2) -> usize {
        let [i, j] = self.cell(point);
        j * self.cells[0] + i
    }

    /// Puts a point that only rounding keeps from a line of the lattice on that line, so that the sides of a
    /// rectangle's cells are straight to the last bit. Lengths are in the frame's unit.
    pub(super) fn align(&self, point: DVec2) -> DVec2 {
        let near = self.corner + self.step * ((point - self.corner) / self.step).round();
        let aligned = |axis: usize| (near[axis] - point[axis]).abs() <= 8.0 * f64::EPSILON;
        DVec2::from([0, 1].map(|axis| if aligned(axis) { near[axis] } else { point[axis] }))
    }

    /// Column and row of the cell that holds a point.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells are few, and clamped")]
    pub(super) fn cell(&self, point: DVec2) -> [usize; 2] {
        let cell = (point - self.corner) / self.step;
        [0, 1].map(|axis| (cell[axis].max(0.0) as usize).min(self.cells[axis].saturating_sub(1)))
    }
}

/// In how many parts to cut a length: at least one, and no more than a mesh can hold. The nudge makes equal
/// lengths give equal counts whatever their rounding.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a small positive range"
)]
pub(super) fn parts(length: f64, spacing: f64) -> usize {
    ((length / spacing) * (1.0 - 1e-9)).round().clamp(1.0, 65536.0) as usize
}
