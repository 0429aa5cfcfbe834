//! Rounds of linking, solving and refining.
use super::allowance::{Allowance, NEARLY, SUM};
use super::asked::Asked;
use super::budget::BandLight;
use super::clusters::Pairs;
use super::direct::Direct;
use super::estimate::{ErrorShares, Errors, causes, errors, estimate, shares};
use super::flow::Linear;
use super::importance::eases;
use super::in_view::in_view;
use super::link::Candidate;
use super::links::Links;
use super::members::PlateMembers;
use super::output::LeafLight;
use super::plates::Plates;
use super::run::Levels;
use super::stand::{Follower, Stand};
use super::tally::tally;
use super::tiling::Tiling;
use super::totals::Totals;
use crate::error::Error;
use crate::scene::camera::Camera;
use crate::solve::{options::Options, pace::Pace, solution::Solution, state::State};
use std::time::Instant;

/// In the first rounds this many times the error is allowed, then a quarter of that, and so on.
const COARSE: [f64; 3] = [16.0, 4.0, 1.0];
/// So often estimates are brought nearer to what is asked for, while this share of the time is left.
const FINER: usize = 8;
const LEFT: f64 = 0.6;
/// So many tiles may there be in the end, or so many times what budgets of links need.
const MANY: usize = 1024;
const MORE: usize = 4;
/// And so many for each patch, where plates are made of these.
const TILES: usize = 2;
/// Patches of plates are looked at again when there are so many times the tiles.
const AT_ONCE: usize = 2;
/// A pass over all links is the last of a level when it refines no more than one in so many: what those are wrong by is told, and counts in the end.
const FEWEST: usize = 100;
/// Products in a round of refinement, and at the end.
const FEW: usize = 8;
const ALL: usize = 400;

/// Solves a scene by levels.
pub(crate) fn solve(
    plates: &Plates<'_>,
    options: &Options,
    start: Instant,
    state: &mut State,
    watch: Follower<'_>,
) -> Result<Solution, Error> {
    let (tiling, members) = (Tiling::of(plates)?, &PlateMembers::of(plates)?);
    let seen = |camera: &Camera| in_view(&Tiling::new(plates.given)?, camera);
    let patches_in_view = options.for_camera.as_ref().map(seen).transpose()?;
    let in_view = patches_in_view.as_ref().map(|seen| plates.any(seen));
    let (links, direct) = (Links::new(&tiling, plates.given, state)?, Direct::new(&tiling));
    let emitted =
        |band: usize| (0..tiling.tiles.len()).map(|tile| [tiling.emittance(tile, band), 0.0, 0.0]).collect();
    let sent: Vec<Vec<Linear>> = (0..plates.given.bands).map(emitted).collect();
    let light = LeafLight::of(&tiling, &links.equilibrium(&tiling, true), &sent, &direct);
    let strain = vec![1.0; tiling.tiles.len()];
    let mut levels = Levels {
        options,
        start,
        tiling,
        members,
        in_view,
        links,
        strain,
        direct,
        sent,
        rounds: 0,
        products: 0,
        light,
        watch,
        fault: None,
    };
    let is_right = levels.run(state)?;
    Ok(Solution { in_view: patches_in_view, ..levels.finish(is_right, state)? })
}

impl Levels<'_> {
    /// Goes on until every patch is within its budget (true), or the watcher, the time or a defect ends the run (false).
    fn run(&mut self, state: &mut State) -> Result<bool, Error> {
        let Pairs { far, near } = self.first_pairs()?;
        let Some(clusters) = self.measure_clusters(&far, state)? else { return Ok(false) };
        self.links.clusters.all = clusters;
        let candidates: Vec<Candidate> =
            near.into_iter().map(|ends| self.links.candidate(&self.tiling, ends)).collect();
        let Some(links) = self.measure(&candidates, state)? else { return Ok(false) };
        self.links.open(&self.tiling, links);
        if !self.shine(state)? {
            return Ok(false);
        }
        self.links.refuse_endless(&self.tiling, |tile, band| self.direct.received(tile, band)[0])?;
        let lights = self.settle(FEW, false);
        if !self.total(&lights, state) {
            return Ok(false);
        }
        let mut lights = lights;
        for times in COARSE {
            let share = |ease: f64| (times * ease).min(COARSE[0]) * SUM * self.options.error;
            let shares: Vec<f64> = self.eases(&lights).into_iter().map(share).collect();
            let Some(found) = self.level(&shares, usize::MAX, state)? else {
                return Ok(false);
            };
            lights = found;
        }
        self.better(lights, state)
    }

    /// Refines the patches whose estimates are beyond what is asked for, as far as that helps; false when the run is to end.
    fn better(&mut self, mut lights: Vec<BandLight>, state: &mut State) -> Result<bool, Error> {
        let mut allowance = Allowance::new(self.tiling.scene.patches.len(), self.options.error);
        let patches = self.members.of_patches.len();
        let most = MANY.max(MORE * self.tiling.tiles.len().max(TILES * patches));
        for _ in 0..FINER {
            let errors = self.errors(&lights);
            let shares = self.seen_shares(&errors);
            if self.is_within(&shares, NEARLY * self.options.error) {
                return Ok(true);
            }
            let ErrorShares { of_plates, of_patches } = shares;
            let is_full = self.tiling.tiles.len() > most || !self.has_time();
            let helps = allowance.after(&of_plates, |worst| causes(&self.tiling, &errors, worst));
            let spread = self.members.spread(&self.tiling);
            let is_strained = spread.strain(&self.tiling, &of_patches, self.options.error, &mut self.strain);
            if is_full || !(helps || is_strained) {
                return Ok(true);
            }
            let eased = |(share, ease): (&f64, f64)| share * ease;
            let allowed: Vec<f64> = allowance.shares().iter().zip(self.eases(&lights)).map(eased).collect();
            // Most of what is strained is right long before all links are within their limits.
            let at_once = if is_strained { most.min(AT_ONCE * self.tiling.tiles.len()) } else { most };
            match self.level(&allowed, at_once, state)? {
                None => return Ok(false),
                Some(better) => lights = better,
            }
        }
        Ok(true)
    }

    /// How many times the error that is asked for each patch may be off by: see [`eases`].
    fn eases(&self, lights: &[BandLight]) -> Vec<f64> {
        let of_view =
            |in_view: &Vec<bool>| eases(&self.tiling, &self.links.all, &self.links.clusters, lights, in_view);
        self.in_view.as_ref().map_or_else(|| vec![1.0; self.tiling.scene.patches.len()], of_view)
    }

    fn errors<'e>(&'e self, lights: &'e [BandLight]) -> Vec<Errors<'e>> {
        errors(&self.tiling, &self.links.all, &self.links.clusters, lights)
    }

    /// The errors of all plates and patches, 0 of those that are out of view.
    fn seen_shares(&self, errors: &[Errors<'_>]) -> ErrorShares {
        let spread = self.members.spread(&self.tiling);
        let mut shares = shares(&self.tiling, &spread, errors);
        let Some(in_view) = &self.in_view else { return shares };
        let unseen = |plate: &usize| !in_view[*plate];
        (0..in_view.len()).filter(unseen).for_each(|plate| shares.of_plates[plate] = 0.0);
        let of_patches = shares.of_patches.iter_mut().zip(&self.members.of_patches);
        of_patches.filter(|(_, plate)| unseen(plate)).for_each(|(share, _)| *share = 0.0);
        shares
    }

    /// Whether estimates are within an error on all that is asked for.
    fn is_within(&self, shares: &ErrorShares, error: f64) -> bool {
        Asked::of(self.members, self.in_view.as_deref()).are_within(shares, error)
    }

    /// Finds what whole tiles exchange in all, as well as it matters in such light; false when the watcher wants to stop.
    fn total(&mut self, lights: &[BandLight], state: &State) -> bool {
        let wanted = self.links.wanted(&self.tiling, lights, self.options.error);
        let mut totals = Totals::default();
        let (mut done, mut pace) = (0, Pace::new());
        while done < wanted.len() {
            if self.report(state).is_break() {
                return false;
            }
            let batch = pace.batch(done, wanted.len());
            done = batch.end;
            totals.find(&self.tiling, &self.links.all[batch.clone()], &wanted[batch]);
        }
        if !wanted.is_empty() {
            self.links.total(totals);
        }
        true
    }

    /// Whether there is time to refine once more, and to show the light after that.
    fn has_time(&self) -> bool {
        let seconds = self.start.elapsed().as_secs_f64();
        self.options.max_seconds.is_none_or(|limit| seconds < (1.0 - LEFT) * limit)
    }

    /// Refines until the errors of every patch's links add up to no more than its share of its light but for a few, or there are more than so many
    /// tiles; gives the light, or nothing when the run is to end.
    fn level(
        &mut self,
        shares: &[f64],
        most: usize,
        state: &mut State,
    ) -> Result<Option<Vec<BandLight>>, Error> {
        loop {
            if !self.shine(state)? {
                return Ok(None);
            }
            let mut lights = self.settle(FEW, false);
            match self.refine(&mut lights, shares, state)? {
                None => return Ok(None),
                Some(0) => return Ok(Some(lights)),
                Some(refined) if refined > self.links.count() / FEWEST && self.tiling.tiles.len() <= most => {
                }
                // What was cut last has light of its own before anyone asks how wrong it is.
                Some(_) if !self.shine(state)? => return Ok(None),
                Some(_) => return Ok(Some(self.settle(FEW, false))),
            }
        }
    }

    /// The solution, with an estimate of its error; as it is shown, unless the run was ended.
    fn finish(mut self, is_right: bool, state: &State) -> Result<Solution, Error> {
        let is_right = is_right && self.shine(state)?;
        let most = if is_right { ALL } else { 0 };
        let lights = self.settle(most, true);
        if self.options.record {
            // The run is over: there is nothing to stop.
            let _ = self.report(state);
        }
        let mut fault = self.fault.take();
        let errors = self.errors(&lights);
        let is_within = self.is_within(&self.seen_shares(&errors), self.options.error);
        let estimate = estimate(&self.tiling, self.members, &errors, self.sent.len());
        drop(errors);
        let (stand, watch) = self.stand();
        let Stand { options, tiling, links, light, .. } = stand;
        let equilibrium = links.equilibrium(tiling, true);
        let shown = match is_right.then(|| stand.shown(&equilibrium, &lights, watch, state)).transpose() {
            Err(defect @ Error::Defect { .. }) => {
                fault = Some(defect);
                None
            }
            shown => shown?.flatten(),
        };
        let is_shown = shown.is_some();
        let solution = shown.unwrap_or_else(|| stand.solution(&equilibrium, light));
        Ok(Solution {
            estimate: Some(estimate),
            transfers: Some(tally(tiling, links)),
            converged: is_shown && light.is_within(options.tolerance) && is_within,
            seconds: stand.start.elapsed().as_secs_f64(),
            fault,
            ..solution
        })
    }
}
