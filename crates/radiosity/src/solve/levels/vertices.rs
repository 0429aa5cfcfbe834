//! What points receive: from every linked tile as bright as it was found, exactly past what stands in between.
use super::flow::Linear;
use super::link::Link;
use super::measure::look;
use super::tiling::Tiling;
use crate::error::Error;
use crate::mesh::element::Mesh;
use crate::solve::receivers::receivers;
use crate::solve::workers::attempt;
use formfactor::DifferentialArea;
use rayon::prelude::*;
use std::ops::ControlFlow;

/// So many points are looked from before the caller is asked whether to go on.
const BATCH: usize = 512;

/// Asks whether to go on.
pub(super) type Ask<'a> = &'a mut dyn FnMut() -> ControlFlow<()>;

/// What each tile is linked to.
pub(super) struct Sights<'s> {
    pub(super) tiling: &'s Tiling<'s>,
    links: &'s [Link],
    /// For each tile its links, and which end of them it is.
    of_tile: Vec<Vec<(usize, usize)>>,
    /// What each tile sends, band by band.
    sent: &'s [Vec<Linear>],
}

impl<'s> Sights<'s> {
    pub(super) fn new(tiling: &'s Tiling<'s>, links: &'s [Link], sent: &'s [Vec<Linear>]) -> Sights<'s> {
        let mut of_tile = vec![Vec::new(); tiling.tiles.len()];
        for (index, link) in links.iter().enumerate() {
            [0, 1].into_iter().for_each(|end| of_tile[link.ends[end]].push((index, end)));
        }
        Sights { tiling, links, of_tile, sent }
    }

    /// The irradiance of the vertices of a mesh: vertices × bands; nothing when the caller wants to stop. `tile_of` is the tile of an element.
    ///
    /// # Errors
    /// [`Error::Defect`] when a form factor fails.
    pub(super) fn vertices(
        &self,
        mesh: &Mesh,
        tile_of: impl Fn(usize) -> usize,
        ask: Ask<'_>,
    ) -> Result<Option<Vec<f64>>, Error> {
        let on_tile = |(element, point): (usize, DifferentialArea)| {
            let tile = tile_of(element);
            (tile, point.owned_by(self.tiling.tiles[tile].surface))
        };
        let points: Vec<_> = receivers(self.tiling.scene, mesh)?.into_iter().map(on_tile).collect();
        self.irradiance(&points, ask)
    }

    /// The irradiance of points, each on a tile: points × bands; nothing when the caller wants to stop.
    ///
    /// # Errors
    /// [`Error::Defect`] when a form factor fails.
    pub(super) fn irradiance(
        &self,
        points: &[(usize, DifferentialArea)],
        ask: Ask<'_>,
    ) -> Result<Option<Vec<f64>>, Error> {
        let mut all = Vec::with_capacity(points.len() * self.sent.len());
        for points in points.chunks(BATCH) {
            if ask().is_break() {
                return Ok(None);
            }
            let found = || points.par_iter().flat_map_iter(|(tile, point)| self.at(*tile, point)).collect();
            let found: Vec<f64> = attempt("what is shown", found)?;
            all.extend(found);
        }
        Ok(Some(all))
    }

    fn at(&self, tile: usize, point: &DifferentialArea) -> Vec<f64> {
        let mut received = vec![0.0f64; self.sent.len()];
        let above = |tile: &usize| self.tiling.tiles[*tile].parent;
        for (index, end) in std::iter::successors(Some(tile), above).flat_map(|tile| &self.of_tile[tile]) {
            let link = &self.links[*index];
            let other = link.ends[1 - end];
            let among: Vec<usize> = link.among.iter().map(|id| *id as usize).collect();
            let seen = look(self.tiling, point, &self.tiling.tiles[other], &among);
            for (sum, sent) in received.iter_mut().zip(self.sent) {
                *sum += seen.iter().zip(sent[other]).map(|(seen, sent)| seen * sent).sum::<f64>();
            }
        }
        received.into_iter().map(|light| light.max(0.0)).collect()
    }
}
