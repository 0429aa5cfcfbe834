//! A point inside a patch.
use super::patch::Patch;
use crate::plane::Plane;
use formfactor::DifferentialArea;
use glam::{DVec2, DVec3};

impl Patch {
    /// A point well inside the patch, with the patch's normal. `None` where rounding leaves no inside.
    ///
    /// In the patch's plane, a line is laid half-way between the two neighbouring vertex heights that are farthest apart; the
    /// point is the middle of the widest stretch of that line inside the patch.
    #[must_use]
    pub fn middle(&self) -> Option<DifferentialArea> {
        let plane = Plane::of(&self.polygon);
        let flat = |points: &[DVec3]| points.iter().map(|&point| plane.flatten(point)).collect::<Vec<_>>();
        let loops: Vec<Vec<DVec2>> = self.polygon.loops().map(flat).collect();
        let mut heights: Vec<f64> = loops.iter().flatten().map(|point| point.y).collect();
        heights.sort_by(f64::total_cmp);
        let [low, high] = widest(heights.windows(2))?;
        let height = low.midpoint(high);
        let mut crossings: Vec<f64> = loops.iter().flat_map(|points| crossings(points, height)).collect();
        crossings.sort_by(f64::total_cmp);
        let [left, right] = widest(crossings.chunks_exact(2))?;
        let place = plane.raise(DVec2::new(left.midpoint(right), height));
        DifferentialArea::new(place, self.polygon.normal()).ok()
    }
}

/// The pair that is farthest apart; of equal ones the last.
fn widest<'n>(pairs: impl Iterator<Item = &'n [f64]>) -> Option<[f64; 2]> {
    let pair = pairs.max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    Some([pair[0], pair[1]])
}

/// Where a loop crosses a height.
fn crossings(points: &[DVec2], height: f64) -> Vec<f64> {
    let edges = points.iter().zip(points.iter().cycle().skip(1));
    let crossed = edges.filter(|(a, b)| (a.y > height) != (b.y > height));
    crossed.map(|(a, b)| a.x + (b.x - a.x) * (height - a.y) / (b.y - a.y)).collect()
}
