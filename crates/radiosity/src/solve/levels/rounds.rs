//! Rounds of linking, solving and refining.
use super::allowance::{Allowance, SUM};
use super::budget::{BandLight, cut, is_beyond, limits, uneven};
use super::cluster_links::ClusterLink;
use super::clusters::Pairs;
use super::direct::Direct;
use super::equilibrium::largest;
use super::estimate::{estimate, shares};
use super::flow::Linear;
use super::gradients::Gradients;
use super::link::{Candidate, Link};
use super::links::Links;
use super::output::LeafLight;
use super::stand::{Follower, Stand};
use super::tiling::Tiling;
use super::totals::Totals;
use crate::error::Error;
use crate::scene::Scene;
use crate::solve::{options::Options, pace::Pace, solution::Solution, state::State};
use rayon::prelude::*;
use std::{ops::ControlFlow, time::Instant};

/// In the first rounds this many times the error is allowed, then a quarter of that, and so on.
const COARSE: [f64; 3] = [16.0, 4.0, 1.0];
/// So often estimates are brought nearer to what is asked for, while this share of the time is left.
const FINER: usize = 8;
const LEFT: f64 = 0.6;
/// So many tiles may there be in the end, or so many times what budgets of links need.
const MANY: usize = 1024;
const MORE: usize = 4;
/// How often totals are restored and rooms closed in turn at the end.
const RESTORED: usize = 8;
/// Products in a round of refinement, and at the end.
const FEW: usize = 8;
const ALL: usize = 400;

/// A run by levels.
struct Levels<'l> {
    options: &'l Options,
    start: Instant,
    tiling: Tiling<'l>,
    links: Links,
    direct: Direct<'l>,
    /// What each tile sends, band by band.
    sent: Vec<Vec<Linear>>,
    /// How often the light was bettered.
    rounds: usize,
    products: usize,
    /// The light as of the last round.
    light: LeafLight,
    watch: Follower<'l>,
    fault: Option<Error>,
}

/// Solves a scene by levels.
pub(crate) fn solve(
    scene: &Scene,
    options: &Options,
    start: Instant,
    state: &mut State,
    watch: Follower<'_>,
) -> Result<Solution, Error> {
    let tiling = Tiling::new(scene)?;
    let (links, direct) = (Links::new(&tiling, state)?, Direct::new(&tiling));
    let emitted =
        |band: usize| (0..tiling.tiles.len()).map(|tile| [tiling.emittance(tile, band), 0.0, 0.0]).collect();
    let sent: Vec<Vec<Linear>> = (0..scene.bands).map(emitted).collect();
    let light = LeafLight::of(&tiling, &links.equilibrium(&tiling, true), &sent, &direct);
    let mut levels = Levels {
        options,
        start,
        tiling,
        links,
        direct,
        sent,
        rounds: 0,
        products: 0,
        light,
        watch,
        fault: None,
    };
    let is_right = levels.run(state)?;
    levels.finish(is_right, state)
}

impl Levels<'_> {
    /// Goes on until every patch is within its budget (true), or the watcher, the time or a defect ends the run (false).
    fn run(&mut self, state: &mut State) -> Result<bool, Error> {
        let Pairs { far, near } = self.links.first_pairs(&self.tiling);
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
        let patches = self.tiling.scene.patches.len();
        for times in COARSE {
            let shares = vec![times * SUM * self.options.error; patches];
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
        let most = MANY.max(MORE * self.tiling.tiles.len());
        for _ in 0..FINER {
            let found = shares(&self.tiling, &self.links.all, &self.links.clusters, &lights);
            let is_full = self.tiling.tiles.len() > most || !self.has_time();
            let Some(allowed) = allowance.after(&found).filter(|_| !is_full) else { return Ok(true) };
            match self.level(allowed, most, state)? {
                None => return Ok(false),
                Some(better) => lights = better,
            }
        }
        Ok(true)
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

    /// Refines until the errors of every patch's links add up to no more than its share of its light, or there are more than so many tiles;
    /// gives the light, or nothing when the run is to end.
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
                Some(true) if self.tiling.tiles.len() <= most => {}
                Some(_) => return Ok(Some(lights)),
            }
        }
    }

    /// The links of candidates; nothing when the watcher wants to stop or something is found to be broken.
    fn measure(&mut self, candidates: &[Candidate], state: &mut State) -> Result<Option<Vec<Link>>, Error> {
        let (mut links, mut done, mut pace) = (Vec::new(), 0, Pace::new());
        while done < candidates.len() {
            if self.report(state).is_break() {
                return Ok(None);
            }
            let batch = pace.batch(done, candidates.len());
            done = batch.end;
            match self.links.of(&self.tiling, &candidates[batch], state) {
                Ok(found) => links.extend(found),
                Err(defect @ Error::Defect { .. }) => {
                    self.fault = Some(defect);
                    return Ok(None);
                }
                Err(error) => return Err(error),
            }
        }
        Ok(Some(links))
    }

    /// Finds what lights bring to the leaves; false when the watcher wants to stop or something is found to be broken.
    fn shine(&mut self, state: &State) -> Result<bool, Error> {
        self.links.enclose(&self.tiling);
        let known = self.links.known(&self.tiling);
        let unknown = self.direct.unknown(&self.tiling);
        let (mut done, mut pace) = (0, Pace::new());
        while done < unknown.len() {
            let batch = pace.batch(done, unknown.len());
            done = batch.end;
            match self.direct.find(&self.tiling, &unknown[batch], &known) {
                Ok(()) if done == unknown.len() || self.report(state).is_continue() => {}
                Ok(()) => return Ok(false),
                Err(defect @ Error::Defect { .. }) => {
                    self.fault = Some(defect);
                    return Ok(false);
                }
                Err(error) => return Err(error),
            }
        }
        Ok(true)
    }

    /// The links of pairs of clusters; nothing as for [`measure`](Self::measure).
    fn measure_clusters(
        &mut self,
        pairs: &[[usize; 2]],
        state: &State,
    ) -> Result<Option<Vec<ClusterLink>>, Error> {
        let (mut links, mut done, mut pace) = (Vec::new(), 0, Pace::new());
        while done < pairs.len() {
            if self.report(state).is_break() {
                return Ok(None);
            }
            let batch = pace.batch(done, pairs.len());
            done = batch.end;
            match self.links.of_clusters(&self.tiling, &pairs[batch]) {
                Ok(found) => links.extend(found),
                Err(defect) => {
                    self.fault = Some(defect);
                    return Ok(None);
                }
            }
        }
        Ok(Some(links))
    }

    /// Shows the watcher where the run stands; a break when it, or the time, says to stop.
    fn report(&mut self, state: &State) -> ControlFlow<()> {
        let (stand, watch) = self.stand();
        stand.show(watch, state)
    }

    fn stand(&mut self) -> (Stand<'_>, Follower<'_>) {
        let Levels { options, start, tiling, links, direct, sent, rounds, products, light, watch, .. } = self;
        let stand = Stand {
            options,
            start: *start,
            tiling,
            links,
            direct,
            sent,
            rounds: *rounds,
            products: *products,
            light,
        };
        (stand, watch)
    }

    /// Betters the light of all bands; gives that of every band in which there is any, with what is wrong with it.
    fn settle(&mut self, most: usize, is_last: bool) -> Vec<BandLight> {
        if is_last {
            (0..RESTORED).for_each(|_| self.links.restore(&self.tiling));
        }
        let equilibrium = self.links.equilibrium(&self.tiling, is_last);
        let better = |(band, sent): (usize, &mut Vec<Linear>)| {
            let emitted: Vec<Linear> = equilibrium
                .leaves()
                .iter()
                .map(|&leaf| self.direct.given(&self.tiling, leaf, band))
                .collect();
            let reflectance = equilibrium.reflectance(band);
            let mut light = equilibrium.of_leaves(sent);
            let enough = equilibrium.enough(&reflectance, &light, &emitted, self.options.tolerance);
            let products =
                Gradients::new(&equilibrium, &emitted, &reflectance).better(&mut light, enough, most);
            equilibrium.darken(&emitted, &mut light);
            *sent = equilibrium.spread(&light);
            products
        };
        self.products += self.sent.par_iter_mut().enumerate().map(better).sum::<usize>();
        self.light = LeafLight::of(&self.tiling, &equilibrium, &self.sent, &self.direct);
        self.rounds += 1;
        let is_lit = |band: &usize| {
            [&self.sent[*band], &self.light.received[*band]].into_iter().any(|light| largest(light) > 0.0)
        };
        let lit = (0..self.sent.len()).filter(is_lit);
        let light = |band: usize| {
            let received = equilibrium.spread(&self.light.received[band]);
            let flaws = self.direct.flaws(&self.tiling, band);
            BandLight::new(&self.tiling, &self.links.all, self.sent[band].clone(), &received, band, flaws)
        };
        lit.collect::<Vec<usize>>().into_par_iter().map(light).collect()
    }

    /// Refines the links whose errors exceed the budgets; false when there is nothing to refine, nothing when the run is to end.
    ///
    /// What takes the place of a link is refined as well, in the light as it is now, as long as it is beyond what its patches allow.
    fn refine(
        &mut self,
        lights: &mut [BandLight],
        shares: &[f64],
        state: &mut State,
    ) -> Result<Option<bool>, Error> {
        let limits = limits(&self.tiling, &self.links.all, &self.links.clusters, lights, shares);
        let mut is_cut = false;
        for leaf in uneven(&self.tiling, lights, &limits) {
            is_cut |= self.cut_tile(leaf, self.direct.axis(leaf))?.is_some();
        }
        lights.iter_mut().for_each(|light| light.grow(&self.tiling));
        let kept = self.links.all.clone();
        let (mut kept, mut candidates) = self.part(kept, lights, &limits)?;
        let Some(near) = self.part_clusters(lights, &limits, state)? else { return Ok(None) };
        candidates.extend(near);
        is_cut |= !candidates.is_empty();
        while !candidates.is_empty() {
            let Some(links) = self.measure(&candidates, state)? else { return Ok(None) };
            let (fine, coarse) = self.part(links, lights, &limits)?;
            kept.extend(fine);
            candidates = coarse;
        }
        self.links.replace(kept);
        Ok(Some(is_cut))
    }

    /// Keeps the links of clusters that are within the limits of their patches, or takes links of parts of theirs; gives the pairs of tiles that
    /// are to be linked by themselves.
    fn part_clusters(
        &mut self,
        lights: &[BandLight],
        limits: &[f64],
        state: &State,
    ) -> Result<Option<Vec<Candidate>>, Error> {
        let mut open = std::mem::take(&mut self.links.clusters.all);
        let (mut kept, mut near) = (Vec::with_capacity(open.len()), Vec::new());
        while !open.is_empty() {
            let clusters = &self.links.clusters.clusters;
            let beyond: Vec<bool> =
                open.par_iter().map(|link| is_beyond(&self.tiling, clusters, link, lights, limits)).collect();
            let mut pairs = Pairs::default();
            for (link, is_beyond) in open.into_iter().zip(beyond) {
                match clusters.halve(link.ends) {
                    _ if !is_beyond => kept.push(link),
                    Some(parts) => parts.into_iter().for_each(|part| clusters.part(part, &mut pairs)),
                    None => near.push(link.ends.map(|end| clusters.tiles(end)[0])),
                }
            }
            near.append(&mut pairs.near);
            let Some(links) = self.measure_clusters(&pairs.far, state)? else { return Ok(None) };
            open = links;
        }
        self.links.clusters.all = kept;
        Ok(Some(near.into_iter().map(|ends| self.links.candidate(&self.tiling, ends)).collect()))
    }

    /// The links that are within the limits of their patches, and what takes the place of the others.
    fn part(
        &mut self,
        links: Vec<Link>,
        lights: &mut [BandLight],
        limits: &[f64],
    ) -> Result<(Vec<Link>, Vec<Candidate>), Error> {
        let (mut kept, mut candidates) = (Vec::with_capacity(links.len()), Vec::new());
        for link in links {
            let parts = match cut(&self.tiling, &link, lights, limits) {
                Some(end) => self.halve(&link, end)?,
                None => None,
            };
            match parts {
                Some(parts) => candidates.extend(parts),
                None => kept.push(link),
            }
        }
        lights.iter_mut().for_each(|light| light.grow(&self.tiling));
        Ok((kept, candidates))
    }

    /// The pairs that take the place of a link: one of its ends is cut, or the other where that cannot be.
    fn halve(&mut self, link: &Link, first: usize) -> Result<Option<[Candidate; 2]>, Error> {
        for end in [first, 1 - first] {
            let (tile, bend) = (link.ends[end], link.transfer.bend[end]);
            let halves = self.cut_tile(tile, usize::from(bend[1].abs() > bend[0].abs()))?;
            if let Some(halves) = halves {
                return Ok(Some(link.parts(end, halves)));
            }
        }
        Ok(None)
    }

    /// The halves of a tile, which send what it does; nothing where it is too small.
    fn cut_tile(&mut self, tile: usize, axis: usize) -> Result<Option<[usize; 2]>, Error> {
        let before = self.tiling.tiles.len();
        let halves = self.tiling.halve(tile, axis)?;
        if let Some(halves) = halves.filter(|_| self.tiling.tiles.len() > before) {
            for sent in &mut self.sent {
                let whole = sent[tile];
                sent.extend(halves.map(|half| self.tiling.tiles[half].restrict(whole)));
            }
            self.direct.inherit(&self.tiling);
        }
        Ok(halves)
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
        let (stand, watch) = self.stand();
        let Stand { options, tiling, links, sent, light, .. } = stand;
        let equilibrium = links.equilibrium(tiling, true);
        let estimate = estimate(tiling, &links.all, &links.clusters, &lights, sent.len());
        let worst = shares(tiling, &links.all, &links.clusters, &lights).into_iter().fold(0.0, f64::max);
        let shown = match is_right.then(|| stand.shown(&equilibrium, watch, state)).transpose() {
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
            converged: is_shown && light.is_within(options.tolerance) && worst <= options.error,
            seconds: stand.start.elapsed().as_secs_f64(),
            fault,
            ..solution
        })
    }
}
