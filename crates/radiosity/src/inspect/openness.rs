//! How much of the view from the patches leaves the scene, and what a row of form factors costs.
use super::cost::Cost;
use crate::scene::Scene;
use crate::solve::occluders::Occluders;
use formfactor::{DifferentialArea, Enclosure};
use rayon::prelude::*;
use serde::Serialize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// At most so many patches are looked from, and fewer where there are many to look at: among 15 000 each look takes a second or two.
const VIEWS: usize = 256;
const FEWEST: usize = 4;
/// So many form factors are enough for a look.
const FACTORS: usize = 30_000;
/// So many form factors are found before it is asked whether to stop.
const BATCH: usize = 16;
/// A view that misses less is closed: the form factors' rounding.
const ROUNDING: f64 = 1e-9;

/// The widest opening of a scene.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Opening {
    /// The patch from whose middle the largest share of the view leaves the scene.
    pub patch: String,
    /// That share: 1 minus the sum of the form factors.
    pub share: f64,
}

impl Opening {
    /// Whether the opening is no more than rounding.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.share.abs() < ROUNDING
    }
}

/// From how many of the patches of a scene it is looked.
fn looks(patches: usize) -> usize {
    (FACTORS / patches.max(1)).clamp(FEWEST, VIEWS)
}

/// The widest opening seen from the middle of up to 256 patches, those looked from before `stop` says to stop, and the cost measured on the
/// way.
pub(super) fn openness(scene: &Scene, stop: &(dyn Fn() -> bool + Sync)) -> (Option<Opening>, Cost) {
    if stop() {
        return (None, Cost::measured(scene, 0, Duration::ZERO));
    }
    let Occluders { polygons, of_patch } = Occluders::join(scene);
    let enclosure = Enclosure::new(polygons);
    let factor = |from: &DifferentialArea, to: usize| {
        enclosure.form_factor_to_part(from, of_patch[to], &scene.patches[to].polygon).value
    };
    let step = scene.patches.len().max(1).div_ceil(looks(scene.patches.len()));
    let views: Vec<usize> =
        (0..scene.patches.len()).step_by(step).filter(|patch| !scene.patches[*patch].only_blocks).collect();
    let (start, found) = (Instant::now(), AtomicUsize::new(0));
    let shares: Vec<Option<f64>> = views
        .par_iter()
        .map(|&patch| {
            let from = scene.patches[patch].middle()?.owned_by(of_patch[patch]);
            let mut sum = 0.0;
            for to in 0..scene.patches.len() {
                if to % BATCH == 0 && stop() {
                    return None;
                }
                sum += factor(&from, to);
                found.fetch_add(1, Ordering::Relaxed);
            }
            Some(1.0 - sum)
        })
        .collect();
    let cost = Cost::measured(scene, found.into_inner(), start.elapsed());
    let seen = views.iter().zip(shares).filter_map(|(&patch, share)| Some((patch, share?)));
    let widest = seen.reduce(|a, b| if b.1.abs() > a.1.abs() { b } else { a });
    let opening = widest.map(|(patch, share)| Opening { patch: scene.patches[patch].name.clone(), share });
    (opening, cost)
}

#[cfg(test)]
mod tests {
    use super::{FACTORS, FEWEST, looks};

    #[test]
    fn looks_of_thousands_of_patches_are_few() {
        for patches in [0, 1, 17, 300, 5000, 15_000, 100_000] {
            assert!((FEWEST..=256).contains(&looks(patches)));
            assert!(patches * looks(patches) <= FACTORS.max(4 * patches), "{patches}");
        }
    }
}
