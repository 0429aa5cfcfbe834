//! How far from linear the light of parts of leaves is.
use super::flow::{Linear, value};

/// At corners, which are farther out than the points on both sides, so many times as much may be missing.
const CORNER: f64 = 3.0;

/// How far from linear the light of parts of leaves may be.
pub(super) struct Evenness<'m> {
    /// What it may be off by.
    pub(super) share: f64,
    /// What counts as dim, band by band.
    pub(super) dim: &'m [f64],
}

impl Evenness<'_> {
    /// The axis along which the light of five points bends most, if that, or what corners are off the plane through these points, is more
    /// than it may be. Corners come with the linear functions there, and their light.
    pub(super) fn uneven<'c>(
        &self,
        light: &[f64],
        corners: impl Iterator<Item = ([f64; 2], &'c [f64])>,
        allowed: f64,
    ) -> Option<usize> {
        let bands = self.dim.len();
        let at = |point: usize, band: usize| light[point * bands + band];
        let worst = |off: &dyn Fn(usize) -> [f64; 2]| self.worst((0..bands).map(off));
        let bend = |ends: [usize; 2]| {
            worst(&|band| {
                let [middle, mean] = [at(0, band), f64::midpoint(at(ends[0], band), at(ends[1], band))];
                [mean - middle, middle.max(mean)]
            })
        };
        let [long, short] = [[1, 2], [3, 4]].map(bend);
        let planes = planes(light);
        let out = corners.map(|(linear, corner)| self.off(&planes, linear, corner));
        let most = out.fold(0.0, f64::max) / CORNER;
        (long.max(short).max(most) > allowed).then_some(usize::from(short > long))
    }

    /// How far the light at a place, with the linear functions there, is off what planes say, as a share.
    pub(super) fn off(&self, planes: &[Linear], linear: [f64; 2], light: &[f64]) -> f64 {
        let off = |(plane, light): (&Linear, &f64)| [light - value(*plane, linear), plane[0].max(*light)];
        self.worst(planes.iter().zip(light).map(off))
    }

    /// The largest share of what is off in a band of how bright it is there.
    pub(super) fn worst(&self, off: impl Iterator<Item = [f64; 2]>) -> f64 {
        let share = |([off, bright], dim): ([f64; 2], &f64)| {
            let unit = bright + dim;
            if unit > 0.0 { off.abs() / unit } else { 0.0 }
        };
        off.zip(self.dim).map(share).fold(0.0, f64::max)
    }
}

/// The linear light that five points receive, band by band: from the centroid and the tips of the axes.
fn planes(light: &[f64]) -> Vec<Linear> {
    let bands = light.len() / 5;
    let plane = |band: usize| {
        let at = |point: usize| light[point * bands + band];
        [at(0), (at(1) - at(2)) / 2.0, (at(3) - at(4)) / 2.0]
    };
    (0..bands).map(plane).collect()
}
