//! Where a run stands, and how its light is shown.
use super::budget::{BandLight, with_larger};
use super::cutting::FoundLight;
use super::direct::Direct;
use super::equilibrium::Equilibrium;
use super::flow::Linear;
use super::links::Links;
use super::members::PlateMembers;
use super::output::{LeafLight, cover, lines, solution, with_vertices};
use super::parting::part;
use super::pieces::{pieces, whole};
use super::tiling::Tiling;
use super::vertices::Sights;
use crate::error::Error;
use crate::solve::progress::{LinkedTiles, Moment, Progress};
use crate::solve::{options::Options, solution::Solution, state::State};
use std::{ops::ControlFlow, time::Instant};

/// Whoever follows a run.
pub(crate) type Follower<'w> = &'w mut dyn FnMut(&Progress<'_>) -> ControlFlow<()>;

/// Where a run stands.
pub(super) struct Stand<'s> {
    pub(super) options: &'s Options,
    pub(super) start: Instant,
    pub(super) tiling: &'s Tiling<'s>,
    pub(super) members: &'s PlateMembers<'s>,
    pub(super) in_view: Option<&'s [bool]>,
    pub(super) links: &'s Links,
    pub(super) direct: &'s Direct<'s>,
    pub(super) sent: &'s [Vec<Linear>],
    pub(super) rounds: usize,
    pub(super) products: usize,
    pub(super) light: &'s LeafLight,
}

impl Stand<'_> {
    /// Shows it to the watcher; a break when that, or the time, says to stop.
    pub(super) fn show(&self, watch: Follower<'_>, state: &State) -> ControlFlow<()> {
        let seconds = self.start.elapsed().as_secs_f64();
        let so_far = || {
            let equilibrium = self.links.equilibrium(self.tiling, true);
            let light = LeafLight::of(self.tiling, &equilibrium, self.sent, self.direct);
            Solution { seconds, ..self.solution(&equilibrium, &light) }
        };
        watch(&Progress {
            moment: Moment::Round(self.rounds),
            open: &Vec::new,
            tiles: &|| LinkedTiles { tiles: self.tiling.outlines(), links: self.links.ends() },
            shots: 0,
            products: self.products,
            unshot: self.light.unshot(),
            bound: &self.light.bound,
            ledger: &self.light.ledger,
            seconds,
            light: &so_far,
            state,
        })?;
        let late = self.options.max_seconds.is_some_and(|limit| seconds > limit);
        if late { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// The light on the leaves.
    pub(super) fn solution(&self, equilibrium: &Equilibrium<'_>, light: &LeafLight) -> Solution {
        let Stand { tiling, members, .. } = self;
        let lines = lines(tiling, self.direct);
        let cover = cover(tiling, members, equilibrium, &lines, &whole(tiling, equilibrium));
        let cover = part(tiling, members, &lines, &cover).cover;
        let solution = solution(members.plates.given, tiling, equilibrium, light, cover);
        Solution { products: self.products, ..solution }
    }

    /// The light on a mesh that shows it, gathered at every vertex; nothing when the watcher, or the time, says to stop.
    ///
    /// # Errors
    /// Those of form factors.
    pub(super) fn shown(
        &self,
        equilibrium: &Equilibrium<'_>,
        bands: &[BandLight],
        watch: Follower<'_>,
        state: &State,
    ) -> Result<Option<Solution>, Error> {
        let Stand { tiling, members, in_view, links, direct, sent, light, .. } = self;
        let means = light.means(equilibrium);
        let fine: Vec<f64> = means.iter().chain([&1.0]).map(|mean| self.options.error * mean).collect();
        let in_view = in_view.map_or_else(|| vec![true; tiling.scene.patches.len()], <[bool]>::to_vec);
        let sights = Sights::new(tiling, in_view, links, direct, sent, &fine);
        let mut ask = || self.show(watch, state);
        let lines = lines(tiling, direct);
        let mut bend = vec![vec![0.0; tiling.tiles.len()]; sent.len()];
        bands.iter().for_each(|light| bend[light.band] = with_larger(tiling, &light.bend));
        let found = FoundLight { received: &light.received, bend };
        let pieces = pieces(&sights, equilibrium, &found, &lines, (&means, self.options.error), &mut ask)?;
        let Some((pieces, corners)) = pieces else { return Ok(None) };
        let cover = cover(tiling, members, equilibrium, &lines, &pieces);
        let tile_of = |element: usize| equilibrium.leaves()[cover.owners[element]];
        let Some(vertices) = sights.vertices(&cover.mesh, &corners, tile_of, &mut ask)? else {
            return Ok(None);
        };
        let parted = part(tiling, members, &lines, &cover);
        let vertices = parted.vertices(&cover.mesh, &vertices, sent.len());
        let scene = members.plates.given;
        let solution = solution(scene, tiling, equilibrium, light, parted.cover);
        Ok(Some(Solution { products: self.products, ..with_vertices(scene, tiling, solution, vertices) }))
    }
}
