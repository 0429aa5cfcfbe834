//! All links of a run, found by all threads.
use super::budget::BandLight;
use super::cluster_links::{ClusterLink, ClusterLinks};
use super::clusters::Clusters;
use super::equilibrium::Equilibrium;
use super::link::{Candidate, Link, UNSEEN};
use super::look::rises;
use super::measure::{between, faces, measure};
use super::tiling::{Tile, Tiling};
use super::totals::{Totals, Wanted};
use crate::error::Error;
use crate::scene::Scene;
use crate::solve::{fingerprint, state::State, workers::attempt};
use formfactor::DifferentialArea;
use rayon::prelude::*;
use std::sync::Arc;

/// With more whole tiles than this, those that are far from each other are linked in clusters.
const FEW: usize = 128;
/// A point is in a closed room when ΣF is 1 within this, and covered when it is 0 within this.
const CLOSED: f64 = 1e-9;

/// Where clusters are linked, what covers a tile is known by ΣF alone, which is 1 elsewhere but for the errors of links.
const COVERED: f64 = 0.5;

/// Of many tiles so many tell whether all are in closed rooms.
const SAMPLES: usize = 64;

/// Whether a tile is in a closed room, by the points of it: all, some, or none. Those under what stands on it are not, which parts of a tile that
/// is crossed may be; of those some see nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Enclosed {
    Wholly,
    Partly,
    Covered,
    Nowhere,
}

impl Enclosed {
    fn by(sums: &[f64]) -> Enclosed {
        // Between the sides of what stands on a tile, rounding may leave a crack.
        let is_covered = sums.iter().all(|sum| *sum <= CLOSED);
        match sums.iter().filter(|sum| (**sum - 1.0).abs() <= CLOSED).count() {
            5 => Enclosed::Wholly,
            0 if is_covered => Enclosed::Covered,
            0 => Enclosed::Nowhere,
            _ => Enclosed::Partly,
        }
    }
}

/// The links of a run.
#[derive(Debug)]
pub(super) struct Links {
    pub(super) all: Vec<Link>,
    pub(super) clusters: ClusterLinks,
    /// How many pairs of whole tiles are linked by themselves.
    pairs: usize,
    /// The scene's shapes.
    shapes: u64,
    /// Which tiles are in closed rooms.
    enclosed: Vec<Enclosed>,
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
                enclosed: Vec::new(),
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
        if self.has_clusters() {
            self.enclosed = vec![Enclosed::Nowhere; tiling.tiles.len()];
            self.all = links;
            if samples_are_enclosed(tiling) {
                self.enclosed = self.uncovered(tiling);
            }
            return;
        }
        let mut seen = vec![[0.0; 5]; tiling.tiles.len()];
        for link in &links {
            for end in [0, 1] {
                let sums = seen[link.ends[end]].iter_mut();
                sums.zip(link.transfer.seen[end]).for_each(|(sum, factor)| *sum += factor);
            }
        }
        self.enclosed = seen.iter().map(|sums| Enclosed::by(sums)).collect();
        links.iter_mut().enumerate().for_each(|(pair, link)| link.pair = pair);
        self.pairs = links.len();
        self.all = links;
    }

    /// All tiles but those that see so little across their links that something covers them are in closed rooms.
    fn uncovered(&self, tiling: &Tiling<'_>) -> Vec<Enclosed> {
        let mut enclosed = vec![Enclosed::Wholly; tiling.tiles.len()];
        let equilibrium = self.equilibrium(tiling, false);
        let covered = (0..equilibrium.leaves().len()).filter(|leaf| equilibrium.sums(*leaf)[0] < COVERED);
        covered.for_each(|leaf| enclosed[equilibrium.leaves()[leaf]] = Enclosed::Nowhere);
        enclosed
    }

    /// How exact it is to be known what whole tiles exchange in all, in such light; nothing where they are too many.
    pub(super) fn wanted(&self, tiling: &Tiling<'_>, lights: &[BandLight], error: f64) -> Vec<Wanted> {
        if self.has_clusters() { Vec::new() } else { Totals::wanted(tiling, &self.all, lights, error) }
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

    /// ΣF of the tiles of which it is known: 1 in closed rooms, 0 under what stands on them.
    pub(super) fn known(&self, tiling: &Tiling<'_>) -> Vec<Option<f64>> {
        let of = |(tile, enclosed): (&Tile, &Enclosed)| match enclosed {
            Enclosed::Wholly if !tile.is_crossed => Some(1.0),
            Enclosed::Covered if !tile.is_crossed => Some(0.0),
            _ => None,
        };
        let known = tiling.tiles.iter().zip(&self.enclosed).map(of);
        known.chain(std::iter::repeat(None)).take(tiling.tiles.len()).collect()
    }

    /// Finds which of the tiles since the last time are in closed rooms: those of which a part is,
    /// or may be covered, are looked at again when they are cut.
    pub(super) fn enclose(&mut self, tiling: &Tiling<'_>) {
        for tile in &tiling.tiles[self.enclosed.len()..] {
            let parent = tile.parent.map(|parent| (self.enclosed[parent], tiling.tiles[parent].is_crossed));
            self.enclosed.push(match parent {
                None => Enclosed::Nowhere,
                Some((enclosed, false)) if enclosed != Enclosed::Partly => enclosed,
                // To look at everything from each costs too much where there are many tiles.
                Some(_) if !self.clusters.clusters.all.is_empty() => Enclosed::Nowhere,
                Some(_) => {
                    let sums: Vec<f64> = tile.points.par_iter().map(|point| sum(tiling, point)).collect();
                    Enclosed::by(&sums)
                }
            });
        }
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
        Equilibrium::new(tiling, &self.all, &self.clusters, &self.known(tiling), is_last)
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
            let is_closed = |tile: usize| {
                self.enclosed[tile] == Enclosed::Wholly || !room.contains(&tiling.tiles[tile].patch)
            };
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

/// Whether all of some tiles, taken at equal distances in the scene's order, see nothing but tiles; those of which the middle is covered do not
/// tell.
fn samples_are_enclosed(tiling: &Tiling<'_>) -> bool {
    let step = tiling.tiles.len().div_ceil(SAMPLES);
    let samples: Vec<&Tile> = tiling.tiles.iter().step_by(step).collect();
    // One that sees something else tells enough.
    let is_told = |tile: &&Tile| match sum(tiling, &tile.points[0]) {
        sum if (sum - 1.0).abs() <= CLOSED => Some(true),
        sum => (sum <= CLOSED).then_some(false),
    };
    samples.par_iter().map(is_told).try_reduce(|| false, |a, b| Some(a || b)) == Some(true)
}

/// ΣF of a point to all that rises above its plane: whether it sees what touches it face to face is up to rounding.
fn sum(tiling: &Tiling<'_>, point: &DifferentialArea) -> f64 {
    let polygons = tiling.enclosure.polygons();
    let is_before = |surface: &usize| polygons[*surface].loops().flatten().any(|place| rises(*place, point));
    let surfaces = (0..polygons.len()).filter(is_before);
    surfaces.map(|surface| tiling.enclosure.form_factor(point, surface).value).sum()
}
