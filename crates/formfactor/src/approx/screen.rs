//! A grid of cells on a plane before dA, with the nearest item of each: a z-buffer.
use super::ray::Item;
use glam::DVec3;
use std::ops::Range;

/// A rectangle of cells on the plane at distance 1 along an axis.
///
/// A row of cells lies in a plane through dA; an item meets that plane in segments, and those are drawn. Nothing needs to
/// be clipped before: what lies behind dA, or below the horizon, where no cells are, is not met.
#[derive(Clone, Debug)]
pub(super) struct Screen {
    /// To the right, up, and forward.
    axes: [DVec3; 3],
    /// Middles of the columns and of the rows.
    columns: Vec<f64>,
    rows: Vec<f64>,
    /// Row after row.
    cells: Vec<Pixel>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Pixel {
    /// 1/t: 0 is infinitely far.
    nearness: f64,
    /// The plane of what is there.
    plane: Option<usize>,
    /// The item, when its front is seen.
    item: Option<usize>,
}

impl Pixel {
    /// Keeps the nearer; of two in one plane, where rounding would decide, the first whose front is seen.
    fn meet(&mut self, item: &Item, nearness: f64) {
        let is_first =
            if self.plane == Some(item.plane) { self.item.is_none() } else { nearness > self.nearness };
        if is_first {
            *self = Pixel { nearness, plane: Some(item.plane), item: item.is_front.then_some(item.id) };
        }
    }
}

/// `count` equal steps of a range.
pub(super) fn steps(range: Range<f64>, count: u32) -> impl Iterator<Item = Range<f64>> + Clone {
    let at = move |i: u32| range.start + (range.end - range.start) * (f64::from(i) / f64::from(count));
    (0..count).map(move |i| at(i)..at(i + 1))
}

fn middles(steps: impl Iterator<Item = Range<f64>>) -> Vec<f64> {
    steps.map(|step| f64::midpoint(step.start, step.end)).collect()
}

impl Screen {
    pub(super) fn new(
        axes: [DVec3; 3],
        columns: impl Iterator<Item = Range<f64>>,
        rows: impl Iterator<Item = Range<f64>>,
    ) -> Self {
        let (columns, rows) = (middles(columns), middles(rows));
        let cells = vec![Pixel::default(); columns.len() * rows.len()];
        Self { axes, columns, rows, cells }
    }

    /// The id of the item in each cell, if it is seen from its front.
    pub(super) fn ids(&self) -> impl Iterator<Item = Option<usize>> {
        self.cells.iter().map(|cell| cell.item)
    }

    /// The id in the cell that a direction passes; `None` too when it passes none.
    pub(super) fn id_toward(&self, direction: DVec3) -> Option<usize> {
        let [x, y, z] = self.axes.map(|axis| axis.dot(direction));
        let column = index(&self.columns, x / z)?;
        let row = index(&self.rows, y / z)?;
        self.cells[row * self.columns.len() + column].item.filter(|_| z > 0.0)
    }

    /// Draws an item where it is nearest so far.
    pub(super) fn draw(&mut self, item: &Item) {
        let place = |p: &DVec3| DVec3::from(self.axes.map(|axis| axis.dot(*p)));
        let loops: Vec<Vec<DVec3>> = item.loops.iter().map(|l| l.iter().map(place).collect()).collect();
        if loops.iter().flatten().all(|p| p.z <= 0.0) {
            return;
        }
        let normal = place(&item.polygon.normal());
        for row in 0..self.rows.len() {
            let y = self.rows[row];
            let mut crossings = crossings(&loops, y);
            let order = |p: &[f64; 2]| p[1] * normal.x - p[0] * (normal.y * y + normal.z);
            crossings.sort_by(|a, b| order(a).total_cmp(&order(b)));
            for pair in crossings.chunks_exact(2) {
                if let Some(covered) = covered(pair[0], pair[1]) {
                    self.fill(row, &covered, item);
                }
            }
        }
    }

    /// Fills the cells of a row whose middles are covered.
    fn fill(&mut self, row: usize, covered: &Range<f64>, item: &Item) {
        let before = |end: f64| self.columns.partition_point(|middle| *middle < end);
        let range = before(covered.start)..before(covered.end);
        let start = row * self.columns.len();
        let [right, up, forward] = self.axes;
        let toward = forward + self.rows[row] * up;
        for column in range {
            let nearness = item.nearness(toward + self.columns[column] * right);
            self.cells[start + column].meet(item, nearness);
        }
    }
}

/// Where edges cross the plane through dA of a row of cells: the components to the right and forward. An edge crosses
/// alike whichever polygon it belongs to, so that cells between two polygons go to one of them.
fn crossings(loops: &[Vec<DVec3>], y: f64) -> Vec<[f64; 2]> {
    let mut found = Vec::new();
    for points in loops {
        for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
            let (from, to) = (a.y - y * a.z, b.y - y * b.z);
            if (from > 0.0) != (to > 0.0) {
                let (low, high, share) =
                    if from <= 0.0 { (a, b, from / (from - to)) } else { (b, a, to / (to - from)) };
                let met = *low + (*high - *low) * share;
                found.push([met.x, met.z]);
            }
        }
    }
    found
}

/// The columns between two points of a row's plane, of which what is not before dA is left out.
fn covered(a: [f64; 2], b: [f64; 2]) -> Option<Range<f64>> {
    let end = |[x, z]: [f64; 2], [other_x, other_z]: [f64; 2]| {
        if z > 0.0 {
            return x / z;
        }
        // The segment leaves toward the side on which it meets z = 0.
        f64::INFINITY.copysign(other_x * z.abs() + x * other_z)
    };
    if a[1] <= 0.0 && b[1] <= 0.0 {
        return None;
    }
    let (a, b) = (end(a, b), end(b, a));
    Some(a.min(b)..a.max(b))
}

/// Which of evenly spaced cells holds a place.
fn index(middles: &[f64], place: f64) -> Option<usize> {
    let (first, last) = (middles.first()?, middles.last()?);
    let half = if middles.len() > 1 { (middles[1] - first) / 2.0 } else { 1.0 };
    // Written so that NaN is outside; the rim belongs to the outermost cells.
    let is_within = place >= first - 2.0 * half && place <= last + 2.0 * half;
    is_within.then(|| middles.partition_point(|middle| middle + half <= place).min(middles.len() - 1))
}
