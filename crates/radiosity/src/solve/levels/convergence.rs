//! What the change of the light from level to level tells of errors.
//!
//! ```text
//! what links may err by, added up     10 %        4 %        1.5 %
//! the light of a patch                1.00        1.02       1.018
//!                                        it changed by a third of what the sum said it might: so much of the next sum is believed
//! ```
use super::budget::BandLight;
use super::cluster_links::ClusterLinks;
use super::estimate::errors;
use super::link::Link;
use super::tiling::Tiling;

/// A patch tells something of errors where its sum fell to this share or less: changes are of errors before and after.
const FELL: f64 = 0.5;
/// Levels are compared where at least this share of the patches tells something.
const TELLING: f64 = 0.5;
/// So many of so many patches changed by less than what is believed.
const MOST: [usize; 2] = [19, 20];
/// Of a sum no less than this share is believed, and no more than so many times as much.
const BELIEVED: [f64; 2] = [0.5, 10.0];
/// So many times as much as the change of the light tells is believed: that it changed little may be chance.
const CAUTION: f64 = 1.5;
/// At the next level a patch that is not right has the root of the part of its share that it would need were errors in proportion to it, as they are
/// in proportion to more, but no less and no more than such parts of the last one.
const TIGHTER: [f64; 2] = [0.25, 0.8];
/// Such a part is left to a patch that is right: errors of others come from it by reflection, mostly where their own shares did not better them.
const RIGHT: f64 = 0.95;
/// Where an estimate is to hold: on this share of the area, and on all patches of more than such a share.
const AREA: f64 = 0.95;
const SMALL: f64 = 1e-4;

/// What all patches receive at a level, and the sums of what that may be off by: powers, for each band in which there is light.
#[derive(Clone, Debug)]
struct Level {
    received: Vec<Vec<f64>>,
    sums: Vec<Vec<f64>>,
}

/// What is known of errors after some levels.
#[derive(Debug, Default)]
pub(super) struct Convergence {
    last: Option<Level>,
    /// What share of the sums is believed, patch by patch for each band; all of it at first.
    believed: Vec<Vec<f64>>,
}

impl Convergence {
    /// Takes note of a level: compares it with the last one that was so much coarser that it tells something.
    pub(super) fn reach(
        &mut self,
        tiling: &Tiling<'_>,
        links: &[Link],
        clusters: &ClusterLinks,
        lights: &[BandLight],
    ) {
        let received = lights.iter().map(|light| light.received.clone()).collect();
        let level = Level { received, sums: errors(tiling, links, clusters, lights) };
        if let Some(before) = &self.last {
            let Some(believed) = believed(before, &level) else { return };
            self.believed = believed;
        }
        self.last = Some(level);
    }

    /// What the light of every patch may be off by: powers, for each band in which there is light.
    pub(super) fn errors(
        &self,
        tiling: &Tiling<'_>,
        links: &[Link],
        clusters: &ClusterLinks,
        lights: &[BandLight],
    ) -> Vec<Vec<f64>> {
        let mut all = errors(tiling, links, clusters, lights);
        for (sums, believed) in all.iter_mut().zip(&self.believed) {
            sums.iter_mut().zip(believed).for_each(|(sum, share)| *sum *= share);
        }
        all
    }

    /// By how many times the errors of patches exceed what is asked for.
    pub(super) fn excesses(
        &self,
        tiling: &Tiling<'_>,
        links: &[Link],
        clusters: &ClusterLinks,
        lights: &[BandLight],
        asked: f64,
    ) -> Excesses {
        let mut excesses = vec![0.0f64; tiling.scene.patches.len()];
        for (errors, light) in self.errors(tiling, links, clusters, lights).iter().zip(lights) {
            for (excess, (error, unit)) in excesses.iter_mut().zip(errors.iter().zip(&light.unit)) {
                *excess = excess.max(if *unit > 0.0 { error / (asked * unit) } else { 0.0 });
            }
        }
        Excesses(excesses)
    }
}

/// By how many times the error of each patch exceeds what is asked for.
#[derive(Debug)]
pub(super) struct Excesses(Vec<f64>);

impl Excesses {
    /// What part of its share each patch keeps at the next level; less of those that are right unless all was bettered by the last one.
    pub(super) fn parts(&self, is_better: bool) -> impl Iterator<Item = f64> {
        let [low, high] = TIGHTER;
        let right = if is_better { RIGHT } else { high };
        self.0
            .iter()
            .map(move |excess| if *excess > 1.0 { excess.powf(-0.5).clamp(low, high) } else { right })
    }

    /// The patches that are not right.
    pub(super) fn wrong(&self) -> impl Iterator<Item = usize> {
        (0..self.0.len()).filter(|patch| self.0[*patch] > 1.0)
    }

    /// The most of all patches that have to be right.
    pub(super) fn most(&self, tiling: &Tiling<'_>) -> f64 {
        let mut areas = vec![0.0; self.0.len()];
        let roots = tiling.tiles.iter().filter(|tile| tile.parent.is_none());
        roots.for_each(|tile| areas[tile.patch] += tile.area);
        most(self.0.iter().copied().zip(areas).collect())
    }
}

/// The most of the patches that count, and of what is left of the area without as much as need not be right; of each patch what it is, and its area.
fn most(mut patches: Vec<(f64, f64)>) -> f64 {
    let whole: f64 = patches.iter().map(|(_, area)| area).sum();
    patches.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut rest = (1.0 - AREA) * whole;
    let counts = |(_, area): &&(f64, f64)| {
        rest -= area;
        *area > SMALL * whole || rest < 0.0
    };
    patches.iter().find(counts).map_or(0.0, |(excess, _)| *excess)
}

/// What share of the sums is believed: as much as nearly all patches changed of what their sums fell by, or as a patch itself did. Nothing
/// where too few sums fell far.
fn believed(before: &Level, now: &Level) -> Option<Vec<Vec<f64>>> {
    let of_band = |band: usize| -> Vec<Option<f64>> {
        let change = |patch: usize| {
            let [was, is] = [before, now].map(|level| level.sums[band][patch]);
            let [before, now] = [before, now].map(|level| level.received[band][patch]);
            (is < FELL * was).then(|| (now - before).abs() / (was - is))
        };
        (0..now.sums[band].len()).map(change).collect()
    };
    let shares: Vec<Vec<Option<f64>>> = (0..now.sums.len()).map(of_band).collect();
    let mut all: Vec<f64> = shares.iter().flatten().flatten().copied().collect();
    let wrong = before.sums.iter().flatten().filter(|sum| **sum > 0.0).count();
    if all.is_empty() || (all.len() as f64) < TELLING * wrong as f64 {
        return None;
    }
    all.sort_by(f64::total_cmp);
    let [some, of] = MOST;
    let most = all[(all.len() - 1) * some / of];
    let [low, high] = BELIEVED;
    let own = |share: Option<f64>| (CAUTION * share.unwrap_or(0.0).max(most)).clamp(low, high);
    Some(shares.into_iter().map(|band| band.into_iter().map(own).collect()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_patches_count_together_only() {
        let small = |excess: f64, count: usize| vec![(excess, 0.5 * SMALL); count];
        assert_eq!(most(vec![(0.4, 0.5), (2.0, 0.5)]), 2.0);
        assert_eq!(most([vec![(0.4, 0.9999)], small(9.0, 2)].concat()), 0.4);
        // They are a tenth of all.
        assert_eq!(most([vec![(0.4, 0.9)], small(9.0, 2000)].concat()), 9.0);
        assert_eq!(most(Vec::new()), 0.0);
    }

    #[test]
    fn patches_that_are_not_right_are_refined_most() {
        let parts = |is_better: bool| Excesses(vec![0.5, 1.1, 4.0, 1e9]).parts(is_better).collect::<Vec<_>>();
        assert_eq!(parts(true), [RIGHT, TIGHTER[1], 0.5, TIGHTER[0]]);
        assert_eq!(parts(false), [TIGHTER[1], TIGHTER[1], 0.5, TIGHTER[0]]);
    }

    fn level(received: f64, sum: f64) -> Level {
        Level { received: vec![vec![received; 4]], sums: vec![vec![sum; 4]] }
    }

    #[test]
    fn as_much_of_a_sum_is_believed_as_the_light_changed_of_what_it_fell_by() {
        let of = |before: Level, now: Level| believed(&before, &now).map(|believed| believed[0].clone());
        let share = of(level(1.0, 0.5), level(1.1, 0.1)).unwrap();
        share.iter().for_each(|share| assert!((share - CAUTION * 0.25).abs() < 1e-12));
        assert_eq!(of(level(1.0, 0.5), level(1.0, 0.1)), Some(vec![BELIEVED[0]; 4]));
        assert_eq!(of(level(1.0, 0.5), level(9.0, 0.1)), Some(vec![BELIEVED[1]; 4]));
        assert_eq!(of(level(1.0, 0.5), level(1.1, 0.4)), None, "hardly anything was refined");
        assert_eq!(of(level(1.0, 0.0), level(1.0, 0.0)), None, "nothing was wrong");
        // One changed by more than the others: of that alone more is believed.
        let mut before = level(1.0, 0.5);
        before.received[0].extend([1.0; 26]);
        before.sums[0].extend([0.5; 26]);
        let mut now = Level { received: vec![vec![1.1; 30]], sums: vec![vec![0.1; 30]] };
        now.received[0][7] = 1.4;
        let share = of(before, now).unwrap();
        let [one, other] = [share[7], share[8]].map(|share| share / CAUTION);
        assert!((one - 1.0).abs() < 1e-12 && (other - 0.25).abs() < 1e-12, "{share:?}");
    }
}
