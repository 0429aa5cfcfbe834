//! Refining links whose errors exceed the budgets of their patches.
use super::budget::{BandLight, cut, limits, uneven};
use super::cluster::Cluster;
use super::cluster_budget::{ClusterLimits, cluster_errors};
use super::cluster_links::ClusterLink;
use super::clusters::{Clusters, Cut, Pairs};
use super::link::{Candidate, Link};
use super::run::Levels;
use crate::error::Error;
use crate::solve::state::State;
use rayon::prelude::*;

/// Links of clusters that may stay, pairs of tiles that are to be linked by themselves, and how many links they take the place of.
struct ClusterParts {
    links: Vec<ClusterLink>,
    near: Vec<Candidate>,
    parted: usize,
}

impl Levels<'_> {
    /// The pairs to begin with: all, or all that may see each other as clusters.
    pub(super) fn first_pairs(&mut self) -> Result<Pairs, Error> {
        if self.links.has_clusters() {
            return self.with_clusters(|clusters, cut| clusters.pairs(cut));
        }
        let near = (0..self.tiling.tiles.len()).flat_map(|one| (0..one).map(move |other| [other, one]));
        Ok(Pairs { far: Vec::new(), near: near.collect() })
    }

    /// Does something with the clusters that may cut tiles.
    fn with_clusters<T>(
        &mut self,
        f: impl FnOnce(&mut Clusters, Cut<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let mut clusters = std::mem::take(&mut self.links.clusters.clusters);
        let found = f(&mut clusters, &mut |tile| {
            let halves = self.cut_tile(tile, 0)?;
            Ok(halves.map(|halves| halves.map(|half| (half, Cluster::of_tile(&self.tiling, half)))))
        });
        self.links.clusters.clusters = clusters;
        found
    }

    /// Refines the links whose errors exceed the budgets; gives how many links and tiles there were to refine, nothing when the run is to end.
    ///
    /// What takes the place of a link is refined as well, in the light as it is now, as long as it is beyond what its patches allow.
    pub(super) fn refine(
        &mut self,
        lights: &mut [BandLight],
        shares: &[f64],
        state: &mut State,
    ) -> Result<Option<usize>, Error> {
        let far = cluster_errors(&self.tiling, &self.links.clusters, lights);
        let limits = limits(&self.tiling, &self.links.all, far, lights, shares);
        let mut refined = 0;
        for leaf in uneven(&self.tiling, lights, &limits) {
            refined += usize::from(self.cut_tile(leaf, self.direct.axis(leaf))?.is_some());
        }
        lights.iter_mut().for_each(|light| light.grow(&self.tiling));
        let kept = self.links.all.clone();
        let (mut kept, mut candidates) = self.part(kept, lights, &limits)?;
        let clusters = self.links.clusters.all.clone();
        let Some(ClusterParts { links: clusters, near, parted }) =
            self.part_clusters(clusters, lights, &limits, state)?
        else {
            return Ok(None);
        };
        refined += candidates.len() + parted;
        candidates.extend(near);
        while !candidates.is_empty() {
            let Some(links) = self.measure(&candidates, state)? else { return Ok(None) };
            let (fine, coarse) = self.part(links, lights, &limits)?;
            kept.extend(fine);
            candidates = coarse;
        }
        self.links.replace(kept);
        self.links.clusters.all = clusters;
        Ok(Some(refined))
    }

    /// Keeps the links of clusters that are within the limits of their patches, and takes links of parts of theirs in place of the others; nothing when
    /// the run is to end.
    fn part_clusters(
        &mut self,
        mut open: Vec<ClusterLink>,
        lights: &mut [BandLight],
        limits: &[f64],
        state: &State,
    ) -> Result<Option<ClusterParts>, Error> {
        let (mut kept, mut near, mut parted) = (Vec::with_capacity(open.len()), Vec::new(), 0);
        while !open.is_empty() {
            lights.iter_mut().for_each(|light| light.grow(&self.tiling));
            let allowed = ClusterLimits::new(&self.tiling, &self.links.clusters.clusters, lights, limits);
            let beyond: Vec<bool> = open.par_iter().map(|link| allowed.is_beyond(link)).collect();
            let mut pairs = self.with_clusters(|clusters, cut| {
                let mut pairs = Pairs::default();
                for (link, is_beyond) in open.into_iter().zip(beyond) {
                    if is_beyond {
                        parted += 1;
                        clusters.replace(link.ends, &mut pairs, cut)?;
                    } else {
                        kept.push(link);
                    }
                }
                Ok(pairs)
            })?;
            near.append(&mut pairs.near);
            let Some(links) = self.measure_clusters(&pairs.far, state)? else { return Ok(None) };
            open = links;
        }
        let near = near.into_iter().map(|ends| self.links.candidate(&self.tiling, ends)).collect();
        Ok(Some(ClusterParts { links: kept, near, parted }))
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
