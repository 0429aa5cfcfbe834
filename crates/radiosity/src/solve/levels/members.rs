//! The patches that plates are made of, on the tiles of these.
use super::plates::Plates;
use super::tile::{Outline, clipped};
use super::tiling::Tiling;
use crate::error::Error;
use crate::mesh::{
    convex::{PlacedCorner, convex_parts},
    frame::Frame,
};
use glam::DVec3;

/// Patches of less than this share of the area may be more wrong than others,
pub(super) const SMALL: f64 = 1e-4;
/// so many of them as are this share of it. No more is made of those that are this share of their plate.
pub(super) const FEW: f64 = 0.05;

/// Errors count so many times as much where they are too large, to be a little less than they may be; in one round no more than the next, and in
/// all no more than the last.
const LESS: f64 = 0.8;
const MORE: f64 = 2.0;
const MOST: f64 = 100.0;

/// The patches of a scene, each as a part of its plate.
#[derive(Debug)]
pub(super) struct PlateMembers<'p> {
    pub(super) plates: &'p Plates<'p>,
    /// The plate of each.
    pub(super) of_patches: Vec<usize>,
    /// The convex parts of each that is not a plate by itself, in the frame of its plate.
    pub(super) parts: Vec<Vec<Vec<PlacedCorner>>>,
}

/// The tiles that each patch is on, with the area there: whole ones, or leaves of a plate that several are parts of.
#[derive(Debug)]
pub(super) struct Spread<'m> {
    members: &'m PlateMembers<'m>,
    on: Vec<Vec<(usize, f64)>>,
}

impl<'p> PlateMembers<'p> {
    /// # Errors
    /// [`Error::Shape`] and its kin where a patch cannot be cut.
    pub(super) fn of(plates: &'p Plates<'p>) -> Result<PlateMembers<'p>, Error> {
        let of_patches = plates.of_patches();
        let parts = |(patch, &plate): (usize, &usize)| {
            if !plates.is_joined(plate) {
                return Ok(Vec::new());
            }
            let frame = Frame::new(&plates.scene.patches[plate].polygon);
            let source = &plates.given.patches[patch];
            convex_parts(&source.polygon, &frame).map_err(|refusal| refusal.of(&source.name))
        };
        let parts = of_patches.iter().enumerate().map(parts).collect::<Result<_, _>>()?;
        Ok(PlateMembers { plates, of_patches, parts })
    }

    /// The corners of those that are not a plate by themselves.
    pub(super) fn corners(&self) -> impl Iterator<Item = DVec3> {
        let patches = self.plates.given.patches.iter().zip(&self.of_patches);
        let parts = patches.filter(|(_, plate)| self.plates.is_joined(**plate));
        parts.flat_map(|(patch, _)| patch.polygon.loops().flatten().copied())
    }

    /// Takes O(n d) for n patches on tiles that are cut d times, beside as many plates as have holes.
    pub(super) fn spread<'m>(&'m self, tiling: &Tiling<'_>) -> Spread<'m> {
        let mut whole = vec![Vec::new(); self.plates.count()];
        for (index, tile) in tiling.tiles.iter().enumerate().filter(|(_, tile)| tile.parent.is_none()) {
            whole[tile.patch].push(index);
        }
        let on = |(&plate, parts): (&usize, &Vec<Vec<PlacedCorner>>)| {
            let of_whole = |tile: &usize| (*tile, tiling.tiles[*tile].area);
            if !self.plates.is_joined(plate) {
                return whole[plate].iter().map(of_whole).collect();
            }
            let mut found = Vec::new();
            for part in parts {
                whole[plate].iter().for_each(|tile| find(tiling, *tile, part.clone(), &mut found));
            }
            found
        };
        Spread { members: self, on: self.of_patches.iter().zip(&self.parts).map(on).collect() }
    }
}

/// Adds the leaves of a tile on which a convex part of its plate is, with the areas there.
fn find(tiling: &Tiling<'_>, tile: usize, part: Vec<PlacedCorner>, found: &mut Vec<(usize, f64)>) {
    let Some(inside) = Outline::new(clipped(part, &tiling.tiles[tile].outline.corners)) else { return };
    match tiling.tiles[tile].halves {
        Some(halves) => {
            halves.into_iter().for_each(|half| find(tiling, half, inside.corners.clone(), found));
        }
        None => found.push((tile, tiling.area(tiling.tiles[tile].patch, &inside))),
    }
}

impl Spread<'_> {
    /// The mean over each patch of what is known of the tiles that it is on: of each, and how much area the patch has there.
    pub(super) fn means(&self, of_tile: impl Fn(usize, f64) -> f64) -> Vec<f64> {
        let mean = |on: &Vec<(usize, f64)>| {
            let area: f64 = on.iter().map(|(_, area)| area).sum();
            let sum: f64 = on.iter().map(|&(tile, area)| area * of_tile(tile, area)).sum();
            if area > 0.0 { sum / area } else { 0.0 }
        };
        self.on.iter().map(mean).collect()
    }

    /// How many patches there are.
    pub(super) fn len(&self) -> usize {
        self.on.len()
    }

    /// The patches of plates whose values are beyond a limit, but for some that are small.
    pub(super) fn beyond(&self, values: &[f64], limit: f64) -> Vec<usize> {
        let plates = self.members.plates;
        let area = |patch: usize| plates.given.patches[patch].polygon.area();
        let all: f64 = (0..plates.given.patches.len()).map(area).sum();
        let of_plate = |members: &Vec<usize>| {
            let mut sorted: Vec<usize> =
                members.iter().copied().filter(|&patch| values[patch] > limit).collect();
            sorted.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
            let mut rest = FEW * members.iter().map(|&patch| area(patch)).sum::<f64>();
            sorted.retain(|&patch| {
                rest -= area(patch);
                rest < 0.0 || area(patch) > SMALL * all
            });
            sorted
        };
        plates.members.iter().filter(|members| members.len() > 1).flat_map(of_plate).collect()
    }

    /// Lets errors count more on the tiles of patches whose values are beyond a limit, by as much as these are; false where there are none.
    pub(super) fn strain(&self, tiling: &Tiling<'_>, values: &[f64], limit: f64, strain: &mut [f64]) -> bool {
        let beyond = self.beyond(values, limit);
        for &patch in &beyond {
            for &(leaf, _) in &self.on[patch] {
                let more = (values[patch] / (LESS * limit)).min(MORE) * strain[leaf];
                let above = |tile: &usize| tiling.tiles[*tile].parent;
                for tile in std::iter::successors(Some(leaf), above) {
                    strain[tile] = strain[tile].max(more.min(MOST));
                }
            }
        }
        !beyond.is_empty()
    }
}
