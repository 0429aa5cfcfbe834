//! What points receive: from every linked tile as bright as it was found, and from lights, exactly past what stands in between.
use super::cluster_links;
use super::corners::CornerLight;
use super::direct::Direct;
use super::flow::{Linear, value};
use super::link::Link;
use super::links::Links;
use super::look::look;
use super::tile::SQUARE;
use super::tiling::{Tile, Tiling};
use crate::error::Error;
use crate::extent::Extent;
use crate::mesh::element::Mesh;
use crate::solve::pace::Pace;
use crate::solve::receivers::{AT_RIM, Receiver, receivers};
use crate::solve::workers::attempt;
use formfactor::DifferentialArea;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// Asks whether to go on.
pub(super) type Ask<'a> = &'a mut dyn FnMut() -> ControlFlow<()>;

/// How much of what points of a tile receive may be other than it is shown, by links of which points look at nothing: a share of what may be.
const SMOOTH: f64 = 0.2;

/// Points look at tiles that see so much of theirs: those are near, and what they bring is least linear at the rim.
const NEAR: f64 = 0.05;

/// And at tiles that are nearer than this share of their size: little of all that a tile receives, and half of what a point at its rim sees.
const BESIDE: f64 = 0.1;

/// What points of each tile see.
pub(super) struct Sights<'s> {
    pub(super) tiling: &'s Tiling<'s>,
    /// The patches of which points look at what is near: the others' receive what their tiles do.
    pub(super) in_view: Vec<bool>,
    links: &'s [Link],
    pub(super) direct: &'s Direct<'s>,
    of_tile: Vec<Sight>,
    /// What each tile sends, band by band, and 1 of each: what comes of that is ΣF.
    sent: Vec<Vec<Linear>>,
    /// ΣF of the tiles of which it is known.
    known: Vec<Option<f64>>,
}

/// What points of a tile see across the tile's links.
#[derive(Default)]
struct Sight {
    /// What each point looks at by itself: links, and which end of them the tile is.
    looks: Vec<(usize, usize)>,
    /// What the other links bring, which is linear enough, band by band.
    rest: Vec<Linear>,
}

impl<'s> Sights<'s> {
    /// `fine` is how wrong the light of points may be in each band, and their ΣF.
    pub(super) fn new(
        tiling: &'s Tiling<'s>,
        in_view: Vec<bool>,
        links: &'s Links,
        direct: &'s Direct<'s>,
        sent: &[Vec<Linear>],
        fine: &[f64],
    ) -> Sights<'s> {
        let (known, clusters, links) = (links.closed.known(tiling), &links.clusters, &links.all[..]);
        let even = vec![[1.0, 0.0, 0.0]; tiling.tiles.len()];
        let lit =
            |sent: &Vec<Linear>| tiling.tiles.iter().zip(sent).map(|(tile, sent)| lit(tile, *sent)).collect();
        let sent: Vec<Vec<Linear>> = sent.iter().map(lit).chain([even]).collect();
        let mut of_tile = vec![Vec::new(); tiling.tiles.len()];
        for (index, link) in links.iter().enumerate() {
            [0, 1].into_iter().for_each(|end| of_tile[link.ends[end]].push((index, end)));
        }
        let extents: Vec<Extent> =
            tiling.tiles.iter().map(|tile| Extent::of_points(tile.outline.places())).collect();
        let sight = |(tile, of_tile): (usize, Vec<(usize, usize)>)| {
            let (area, is_crossed) = (tiling.tiles[tile].area, tiling.tiles[tile].is_crossed);
            let flaw = |&(index, end): &(usize, usize)| {
                let link = &links[index];
                let smaller =
                    link.ends.map(|end| tiling.tiles[end].area).into_iter().fold(f64::MAX, f64::min);
                let other = &extents[link.ends[1 - end]];
                let is_beside = extents[tile].is_near(other, BESIDE * other.diagonal());
                if is_beside || link.exchange[0] > NEAR * smaller {
                    return f64::INFINITY;
                }
                // Under what stands on a tile nothing is received: all may be elsewhere, of ΣF as well.
                let wrong = if is_crossed { link.exchange[0] } else { link.curvature(end) + link.error() };
                let bands = sent.len() - usize::from(!is_crossed);
                let light = sent[..bands].iter().map(|sent| sent[link.ends[1 - end]][0].abs());
                let share = |(light, fine): (f64, &f64)| {
                    if light > 0.0 { wrong * light / (area * fine) } else { 0.0 }
                };
                light.zip(fine).map(share).fold(0.0, f64::max)
            };
            let mut flaws: Vec<(f64, (usize, usize))> = of_tile.iter().map(|at| (flaw(at), *at)).collect();
            flaws.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut sum = 0.0;
            let count = flaws.iter().take_while(|(flaw, _)| {
                sum += flaw;
                sum <= SMOOTH
            });
            let count = if in_view[tiling.tiles[tile].patch] { count.count() } else { flaws.len() };
            let rest = sent.iter().map(|sent| received(tiling, links, &flaws[..count], sent)).collect();
            Sight { looks: flaws[count..].iter().map(|(_, at)| *at).collect(), rest }
        };
        let mut of_tile: Vec<Sight> = of_tile.into_iter().enumerate().map(sight).collect();
        for (band, sent) in sent.iter().enumerate() {
            let mut far = vec![[0.0; 3]; sent.len()];
            cluster_links::gather(tiling, clusters.all.iter(), sent, &mut far);
            of_tile.iter_mut().zip(far).for_each(|(sight, light)| sight.rest[band][0] += light[0]);
        }
        Sights { tiling, in_view, links, direct, of_tile, sent, known }
    }

    /// The irradiance of the vertices of a mesh, of which some corners' is known: vertices × bands; nothing when the caller wants to stop. `tile_of`
    /// is the tile of an element.
    ///
    /// # Errors
    /// [`Error::Defect`] when a form factor fails.
    pub(super) fn vertices(
        &self,
        mesh: &Mesh,
        corners: &CornerLight<'_>,
        tile_of: impl Fn(usize) -> usize,
        ask: Ask<'_>,
    ) -> Result<Option<Vec<f64>>, Error> {
        let on_tile = |receiver: &Receiver<'_>| {
            let tile = tile_of(receiver.element);
            Ok((tile, receiver.inside_element(AT_RIM)?.owned_by(self.tiling.tiles[tile].surface)))
        };
        let known = |(receiver, place): (&Receiver<'_>, &DVec3)| {
            let tile = tile_of(receiver.element);
            corners.at(tile, self.tiling.flatten(self.tiling.tiles[tile].patch, *place))
        };
        let receivers = receivers(self.tiling.scene, mesh);
        let known: Vec<Option<&[f64]>> = receivers.iter().zip(&mesh.vertices).map(known).collect();
        let unknown = receivers.iter().zip(&known).filter(|(_, known)| known.is_none());
        let points = unknown.map(|(receiver, _)| on_tile(receiver)).collect::<Result<Vec<_>, Error>>()?;
        let Some(found) = self.irradiance(&points, ask)? else { return Ok(None) };
        let mut found = found.chunks(self.sent.len() - 1);
        let of = |known: Option<&[f64]>| known.or_else(|| found.next()).unwrap_or_default().to_vec();
        Ok(Some(known.into_iter().flat_map(of).collect()))
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
        let mut all = Vec::with_capacity(points.len() * (self.sent.len() - 1));
        let (mut done, mut pace) = (0, Pace::new());
        while done < points.len() {
            if ask().is_break() {
                return Ok(None);
            }
            let batch = pace.batch(done, points.len());
            done = batch.end;
            let found =
                || points[batch].par_iter().flat_map_iter(|(tile, point)| self.at(*tile, point)).collect();
            let found: Vec<f64> = attempt("what is shown", found)?;
            all.extend(found);
        }
        Ok(Some(all))
    }

    /// What a point of a tile receives: from tiles, and straight from lights.
    fn at(&self, tile: usize, point: &DifferentialArea) -> Vec<f64> {
        let straight = self.direct.at(self.tiling, point);
        self.of_tiles(tile, point)
            .into_iter()
            .zip(straight)
            .map(|(light, straight)| light + straight)
            .collect()
    }

    /// What a point of a tile receives from tiles: of even light 1 where ΣF is 1, nothing where something stands on the tile.
    fn of_tiles(&self, tile: usize, point: &DifferentialArea) -> Vec<f64> {
        let mut light = vec![0.0f64; self.sent.len()];
        if self.known[tile] == Some(0.0) {
            light.pop();
            return light;
        }
        let (leaf, above) = (tile, |tile: &usize| self.tiling.tiles[*tile].parent);
        for tile in std::iter::successors(Some(leaf), above) {
            let (Sight { looks, rest }, tile) = (&self.of_tile[tile], &self.tiling.tiles[tile]);
            let linear = tile.outline.linear(self.tiling.flatten(tile.patch, point.position()));
            light.iter_mut().zip(rest).for_each(|(sum, rest)| *sum += value(*rest, linear));
            for (index, end) in looks {
                let link = &self.links[*index];
                let other = link.ends[1 - end];
                let among: Vec<usize> = link.among.iter().map(|id| *id as usize).collect();
                let seen = look(self.tiling, point, &self.tiling.tiles[other], &among);
                for (sum, sent) in light.iter_mut().zip(&self.sent) {
                    *sum += seen.iter().zip(sent[other]).map(|(seen, sent)| seen * sent).sum::<f64>();
                }
            }
        }
        let sum = light.pop().filter(|sum| *sum > 0.0 && self.known[leaf] == Some(1.0)).unwrap_or(1.0);
        light.into_iter().map(|light| (light / sum).max(0.0)).collect()
    }
}

/// The same mean, with so little slope that no corner of the tile sends less than nothing.
fn lit(tile: &Tile, [mean, first, second]: Linear) -> Linear {
    let slope = |(at, _): &(DVec2, DVec3)| {
        let [a, b] = tile.outline.linear(*at);
        a * first + b * second
    };
    let lowest = tile.outline.corners.iter().map(slope).fold(0.0, f64::min);
    let share = if mean + lowest < 0.0 { -mean.max(0.0) / lowest } else { 1.0 };
    [mean, share * first, share * second]
}

/// What a tile receives across some links.
fn received(tiling: &Tiling<'_>, links: &[Link], some: &[(f64, (usize, usize))], sent: &[Linear]) -> Linear {
    let mut light = [0.0; 3];
    for (_, (index, end)) in some {
        let (link, end) = (&links[*index], *end);
        let (from, area) = (sent[link.ends[1 - end]], tiling.tiles[link.ends[end]].area);
        for (k, light) in light.iter_mut().enumerate() {
            let row = |j: usize| link.exchange[if end == 0 { 3 * k + j } else { 3 * j + k }];
            let power = row(0) * from[0] + row(1) * from[1] + row(2) * from[2];
            *light += power / area / if k == 0 { 1.0 } else { SQUARE };
        }
    }
    light
}
