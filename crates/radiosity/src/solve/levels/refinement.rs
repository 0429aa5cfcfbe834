//! Refining links whose errors exceed the budgets of their patches.
use super::budget::{BandLight, cut, is_beyond, limits, uneven};
use super::clusters::Pairs;
use super::link::{Candidate, Link};
use super::run::Levels;
use crate::error::Error;
use crate::solve::state::State;
use rayon::prelude::*;

impl Levels<'_> {
    /// Refines the links whose errors exceed the budgets; false when there is nothing to refine, nothing when the run is to end.
    ///
    /// What takes the place of a link is refined as well, in the light as it is now, as long as it is beyond what its patches allow.
    pub(super) fn refine(
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
}
