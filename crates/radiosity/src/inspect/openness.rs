//! How much of the view from the patches leaves the scene, and what a row of form factors costs.
use super::Cost;
use crate::plane::Plane;
use crate::{Patch, Scene};
use formfactor::{DifferentialArea, Enclosure};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use serde::Serialize;
use std::time::Instant;

/// At most so many patches are looked from, and fewer where there are many to look at.
const VIEWS: usize = 256;
/// So many form factors are enough for a look.
const FACTORS: usize = 30_000;
/// A view that misses less is closed: the form factors' rounding.
const ROUNDING: f64 = 1e-9;

/// The widest opening.
#[derive(Clone, Debug, Serialize)]
pub struct Opening {
    /// The patch from whose middle most of the view leaves the scene.
    pub patch: String,
    /// What share: 1 minus the sum of the form factors.
    pub share: f64,
}

impl Opening {
    /// Whether it is no more than rounding.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.share.abs() < ROUNDING
    }
}

/// The widest opening seen from the middle of up to 256 patches, and the cost measured on the way.
pub(super) fn openness(scene: &Scene) -> (Option<Opening>, Cost) {
    let enclosure = Enclosure::new(scene.patches.iter().map(|patch| patch.polygon.clone()).collect());
    let count = scene.patches.len().max(1);
    let step = count.div_ceil((FACTORS / count).clamp(8, VIEWS));
    let views: Vec<usize> =
        (0..scene.patches.len()).step_by(step).filter(|patch| !scene.patches[*patch].only_blocks).collect();
    let start = Instant::now();
    let shares: Vec<Option<f64>> = views
        .par_iter()
        .map(|&patch| {
            let from = middle(&scene.patches[patch])?.owned_by(patch);
            Some(1.0 - enclosure.row(&from).iter().map(|factor| factor.value).sum::<f64>())
        })
        .collect();
    let cost = Cost::measured(scene, views.len(), start.elapsed());
    let seen = views.iter().zip(shares).filter_map(|(&patch, share)| Some((patch, share?)));
    let widest = seen.reduce(|a, b| if b.1.abs() > a.1.abs() { b } else { a });
    let opening = widest.map(|(patch, share)| Opening { patch: scene.patches[patch].name.clone(), share });
    (opening, cost)
}

/// A point inside the patch: half-way across the widest stretch of a line between two of its vertices' heights.
pub(crate) fn middle(patch: &Patch) -> Option<DifferentialArea> {
    let plane = Plane::of(&patch.polygon);
    let flat = |points: &[DVec3]| points.iter().map(|&point| plane.flatten(point)).collect::<Vec<_>>();
    let loops: Vec<Vec<DVec2>> = patch.polygon.loops().map(flat).collect();
    let mut heights: Vec<f64> = loops.iter().flatten().map(|point| point.y).collect();
    heights.sort_by(f64::total_cmp);
    let gap = heights.windows(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    let height = gap[0].midpoint(gap[1]);
    let mut crossings: Vec<f64> = loops.iter().flat_map(|points| crossings(points, height)).collect();
    crossings.sort_by(f64::total_cmp);
    let stretch = crossings.chunks_exact(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    let place = plane.raise(DVec2::new(stretch[0].midpoint(stretch[1]), height));
    DifferentialArea::new(place, patch.polygon.normal()).ok()
}

/// Where a loop crosses a height.
fn crossings(points: &[DVec2], height: f64) -> Vec<f64> {
    let edges = points.iter().zip(points.iter().cycle().skip(1));
    let crossed = edges.filter(|(a, b)| (a.y > height) != (b.y > height));
    crossed.map(|(a, b)| a.x + (b.x - a.x) * (height - a.y) / (b.y - a.y)).collect()
}
