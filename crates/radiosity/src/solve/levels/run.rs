//! A run by levels: what its steps share.
use super::budget::BandLight;
use super::cluster_links::ClusterLink;
use super::direct::Direct;
use super::equilibrium::largest;
use super::flow::Linear;
use super::gradients::Gradients;
use super::link::{Candidate, Link};
use super::links::Links;
use super::members::PlateMembers;
use super::output::LeafLight;
use super::stand::{Follower, Stand};
use super::tiling::Tiling;
use crate::error::Error;
use crate::solve::{options::Options, pace::Pace, state::State};
use rayon::prelude::*;
use std::{ops::ControlFlow, time::Instant};

/// How often totals are restored and rooms closed in turn at the end.
const RESTORED: usize = 8;

/// A run by levels.
pub(super) struct Levels<'l> {
    pub(super) options: &'l Options,
    pub(super) start: Instant,
    pub(super) tiling: Tiling<'l>,
    pub(super) members: &'l PlateMembers<'l>,
    /// Which patches the camera sees, where the run is for one.
    pub(super) in_view: Option<Vec<bool>>,
    pub(super) links: Links,
    /// How many times its errors count in each tile.
    pub(super) strain: Vec<f64>,
    pub(super) direct: Direct<'l>,
    /// What each tile sends, band by band.
    pub(super) sent: Vec<Vec<Linear>>,
    /// How often the light was bettered.
    pub(super) rounds: usize,
    pub(super) products: usize,
    /// The light as of the last round.
    pub(super) light: LeafLight,
    pub(super) watch: Follower<'l>,
    pub(super) fault: Option<Error>,
}

impl Levels<'_> {
    /// The links of candidates; nothing when the watcher wants to stop or something is found to be broken.
    pub(super) fn measure(
        &mut self,
        candidates: &[Candidate],
        state: &mut State,
    ) -> Result<Option<Vec<Link>>, Error> {
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
    pub(super) fn shine(&mut self, state: &State) -> Result<bool, Error> {
        self.links.closed.add(&self.tiling);
        let known = self.links.closed.known(&self.tiling);
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
    pub(super) fn measure_clusters(
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
    pub(super) fn report(&mut self, state: &State) -> ControlFlow<()> {
        let (stand, watch) = self.stand();
        stand.show(watch, state)
    }

    pub(super) fn stand(&mut self) -> (Stand<'_>, Follower<'_>) {
        let Levels {
            options,
            start,
            tiling,
            members,
            in_view,
            links,
            direct,
            sent,
            rounds,
            products,
            light,
            watch,
            ..
        } = self;
        let stand = Stand {
            options,
            start: *start,
            tiling,
            members,
            in_view: in_view.as_deref(),
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
    pub(super) fn settle(&mut self, most: usize, is_last: bool) -> Vec<BandLight> {
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
            let (sent, strain) = (self.sent[band].clone(), self.strain.clone());
            let links = (&self.links.all[..], &self.links.clusters);
            BandLight::new(&self.tiling, links, sent, &received, band, flaws, strain)
        };
        lit.collect::<Vec<usize>>().into_par_iter().map(light).collect()
    }

    /// The halves of a tile, which send what it does; nothing where it is too small.
    pub(super) fn cut_tile(&mut self, tile: usize, axis: usize) -> Result<Option<[usize; 2]>, Error> {
        let before = self.tiling.tiles.len();
        let halves = self.tiling.halve(tile, axis)?;
        if let Some(halves) = halves.filter(|_| self.tiling.tiles.len() > before) {
            for sent in &mut self.sent {
                let whole = sent[tile];
                sent.extend(halves.map(|half| self.tiling.tiles[half].restrict(whole)));
            }
            self.direct.inherit(&self.tiling);
            self.strain.extend([self.strain[tile]; 2]);
        }
        Ok(halves)
    }
}
