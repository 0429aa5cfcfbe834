//! All links of a run, found by all threads.
use super::budget::BandLight;
use super::closed_rooms::ClosedRooms;
use super::cluster_links::{ClusterLink, ClusterLinks};
use super::clusters::Clusters;
use super::equilibrium::Equilibrium;
use super::link::{Candidate, Link, UNSEEN};
use super::measure::{between, faces, measure};
use super::tiling::Tiling;
use super::totals::{Totals, Wanted};
use crate::error::Error;
use crate::scene::Scene;
use crate::solve::{fingerprint, state::State, workers::attempt};
use rayon::prelude::*;
use std::sync::Arc;

/// With more whole tiles than this, those that are far from each other are linked in clusters.
const FEW: usize = 128;

/// The links of a run.
#[derive(Debug)]
pub(super) struct Links {
    pub(super) all: Vec<Link>,
    pub(super) clusters: ClusterLinks,
    /// How many pairs of whole tiles are linked by themselves.
    pairs: usize,
    /// The scene's shapes.
    shapes: u64,
    pub(super) closed: ClosedRooms,
    totals: Totals,
}

impl Links {
    /// No links.
    ///
    /// # Errors
    /// [`Error::Foreign`] for a state of other shapes.
    pub(super) fn new(tiling: &Tiling<'_>, given: &Scene, state: &State) -> Result<Links, Error> {
        let shapes = fingerprint::of_shapes(given);
        let foreign = !state.is_empty() && !state.knows_shapes(shapes);
        if foreign {
            Err(Error::Foreign)
        } else {
            let is_small = tiling.tiles.len() <= FEW;
            let clusters = if is_small { Clusters::default() } else { Clusters::of(tiling) };
            Ok(Links {
                all: Vec::new(),
                clusters: ClusterLinks { clusters, all: Vec::new() },
                pairs: 0,
                shapes,
                closed: ClosedRooms::default(),
                totals: Totals::default(),
            })
        }
    }

    pub(super) fn has_clusters(&self) -> bool {
        !self.clusters.clusters.all.is_empty()
    }

    /// Two whole tiles that are to be linked by themselves.
    pub(super) fn candidate(&mut self, tiling: &Tiling<'_>, ends: [usize; 2]) -> Candidate {
        self.pairs += 1;
        let among = tiling.surfaces_between(ends);
        Candidate { ends, among, unseen: UNSEEN, pair: self.pairs - 1, most: f64::INFINITY }
    }

    /// The links of some pairs of clusters, in their order.
    ///
    /// # Errors
    /// [`Error::Defect`] when a form factor fails.
    pub(super) fn of_clusters(
        &self,
        tiling: &Tiling<'_>,
        pairs: &[[usize; 2]],
    ) -> Result<Vec<ClusterLink>, Error> {
        let clusters = &self.clusters.clusters;
        let measure = |pair: &[usize; 2]| {
            let name = &tiling.scene.patches[tiling.tiles[clusters.tiles(pair[0])[0]].patch].name;
            attempt(name, || ClusterLink::measure(tiling, clusters, *pair))
        };
        let found: Result<Vec<Option<ClusterLink>>, Error> = pairs.par_iter().map(measure).collect();
        Ok(found?.into_iter().flatten().collect())
    }

    /// How many there are, of tiles and of clusters.
    pub(super) fn count(&self) -> usize {
        self.all.len() + self.clusters.all.len()
    }

    /// The tiles that are linked.
    pub(super) fn ends(&self) -> Vec<[usize; 2]> {
        self.all.iter().map(|link| link.ends).collect()
    }

    /// Takes the links of whole tiles, and finds which of these are in closed rooms.
    pub(super) fn open(&mut self, tiling: &Tiling<'_>, mut links: Vec<Link>) {
        links.iter_mut().enumerate().for_each(|(pair, link)| link.pair = pair);
        self.pairs = links.len();
        self.all = links;
        self.closed = if self.has_clusters() {
            ClosedRooms::by_rooms(tiling, &self.equilibrium(tiling, false))
        } else {
            ClosedRooms::by_points(&self.sums(tiling))
        };
    }

    /// ΣF of the points of all tiles, where all that see each other are linked by themselves.
    fn sums(&self, tiling: &Tiling<'_>) -> Vec<[f64; 5]> {
        let mut seen = vec![[0.0; 5]; tiling.tiles.len()];
        for (link, end) in self.all.iter().flat_map(|link| [(link, 0), (link, 1)]) {
            let sums = seen[link.ends[end]].iter_mut();
            sums.zip(link.transfer.seen[end]).for_each(|(sum, factor)| *sum += factor);
        }
        seen
    }

    /// How exact it is to be known what whole tiles exchange in all, in such light: where they are many, only of those that matter.
    pub(super) fn wanted(
        &self,
        tiling: &Tiling<'_>,
        lights: &[BandLight],
        error: f64,
    ) -> Vec<Option<Wanted>> {
        Totals::wanted(tiling, &self.all, lights, error, self.has_clusters())
    }

    /// Takes what whole tiles exchange in all.
    pub(super) fn total(&mut self, totals: Totals) {
        self.totals = totals;
        self.all.retain(|link| !self.totals.is_hidden(link.pair));
        self.totals.share(&mut self.all);
    }

    /// Takes other links in place of these.
    pub(super) fn replace(&mut self, by: Vec<Link>) {
        self.all = by;
        self.totals.share(&mut self.all);
    }

    /// Makes what passes between whole tiles right again after rooms were made to close.
    pub(super) fn restore(&mut self, tiling: &Tiling<'_>) {
        let scales = self.equilibrium(tiling, false).scales();
        self.totals.restore(&mut self.all, &scales);
    }

    /// The links of some candidates, in their order; what was measured is kept in the state.
    pub(super) fn of(
        &self,
        tiling: &Tiling<'_>,
        candidates: &[Candidate],
        state: &mut State,
    ) -> Result<Vec<Link>, Error> {
        let known: &State = state;
        let found: Vec<Result<Option<Link>, Error>> =
            candidates.par_iter().map(|candidate| self.link(tiling, candidate, known)).collect();
        let mut links = Vec::new();
        let mut fault = None;
        for result in found {
            match result {
                Ok(link) => links.extend(link),
                Err(error) => fault = fault.or(Some(error)),
            }
        }
        for link in &links {
            state.keep_transfer(self.shapes, tiling.names(link.ends), &link.transfer);
        }
        fault.map_or(Ok(links), Err)
    }

    /// The link of a candidate; nothing where no light can pass.
    fn link(&self, tiling: &Tiling<'_>, candidate: &Candidate, known: &State) -> Result<Option<Link>, Error> {
        let tiles = candidate.ends.map(|end| &tiling.tiles[end]);
        if !faces(tiles) {
            return Ok(None);
        }
        let among: Arc<[u32]> = between(tiling, tiles, &candidate.among).into();
        let transfer = match known.transfer(self.shapes, tiling.names(candidate.ends)) {
            Some(transfer) => transfer,
            None => Arc::new(attempt(&tiling.scene.patches[tiles[0].patch].name, || {
                #[cfg(test)]
                assert_ne!(known.trap, Some(tiles[0].patch), "injected");
                measure(tiling, tiles, &among)
            })?),
        };
        Ok(Link::new(candidate, among, transfer))
    }

    /// The light of all leaves at once; rooms are made to close better at last.
    pub(super) fn equilibrium<'e>(&'e self, tiling: &'e Tiling<'_>, is_last: bool) -> Equilibrium<'e> {
        Equilibrium::new(tiling, &self.all, &self.clusters, &self.closed.known(tiling), is_last)
    }

    /// Refuses a closed room with a patch that reflects all light: what it emits, or what `direct` light falls on its tiles, could never leave.
    pub(super) fn refuse_endless(
        &self,
        tiling: &Tiling<'_>,
        direct: impl Fn(usize, usize) -> f64,
    ) -> Result<(), Error> {
        let equilibrium = self.equilibrium(tiling, false);
        let patches = &tiling.scene.patches;
        let rooms = equilibrium.patches_of_rooms();
        for room in rooms {
            let is_closed =
                |tile: usize| self.closed.encloses(tile) || !room.contains(&tiling.tiles[tile].patch);
            let closed = (0..tiling.tiles.len()).all(is_closed);
            let is_lit = |tile: usize, band: usize| {
                room.contains(&tiling.tiles[tile].patch) && direct(tile, band) > 0.0
            };
            let live = |band: usize| {
                room.iter().any(|&patch| patches[patch].emission[band] > 0.0)
                    || (0..tiling.tiles.len()).any(|tile| is_lit(tile, band))
            };
            let endless = |patch: &usize| {
                (0..tiling.scene.bands).any(|band| live(band) && patches[*patch].reflectance[band] >= 1.0)
            };
            if let Some(&patch) = room.iter().find(|patch| endless(patch)).filter(|_| closed) {
                return Err(Error::Endless {
                    room: patches[room[0]].name.clone(),
                    patches: room.len(),
                    patch: patches[patch].name.clone(),
                });
            }
        }
        Ok(())
    }
}
