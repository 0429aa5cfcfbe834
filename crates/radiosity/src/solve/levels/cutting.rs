//! Whether the light of parts of leaves is linear enough, as looks say, and their halves where it is not.
use super::borders::Borders;
use super::corners::{CornerKey, CornerLight};
use super::direct::Direct;
use super::evenness::Evenness;
use super::flow::Linear;
use super::tile::Outline;
use super::tiling::Tiling;
use super::vertices::{Ask, Sights};
use crate::error::Error;
use formfactor::DifferentialArea;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Pieces of less than this share of the scene's area are seen less: by the share of their size.
const SMALL: f64 = 1e-4;
/// Pieces of less than this share are not cut.
const LEAST: f64 = 1e-6;
/// Pieces become fans around their middles, where nothing is missing: they may bend by so many times what is allowed.
const BENT: f64 = 1.5;
/// Leaves are small enough, and are looked at from their corners alone, where neither the estimate of how far light is off linear nor what corners
/// differ by is more than so many times what it may be: of 12 532 such leaves of the rooms of `tests`, some with such borders as below, 136 bend more
/// than they may, none by 2.4 times that. Where the border of a shadow passes it may not be more at all: light bends there, out of sight of corners.
const FLAT: f64 = 2.0;
/// Others of which that estimate says so, and that no such border passes, are small enough, and are looked at from their middles as well, where those
/// receive what corners do in the mean along both diagonals, but for so many times what light may be off: of 2126 of which that was said, 19 bend more
/// than they may, none by 2.2 times that. Where the estimate is more, light may rise between a corner and the middle, out of sight of both.
const DIAGONAL: f64 = 1.5;
/// Corners at a rim are looked from a little inside of the leaf: by this share of the way to its middle.
const INWARD: f64 = 1e-4;

/// A part of a leaf.
#[derive(Clone, Debug)]
pub(super) struct LeafPart {
    /// Which of the leaves.
    pub(super) leaf: usize,
    pub(super) outline: Outline,
}

/// Parts whose light is linear enough, and the others.
pub(super) type EvenAndOpen = (Vec<LeafPart>, Vec<OpenPart>);

/// A part that is not known to be small enough, and the borders of shadows that pass through it, or through what it is a part of.
pub(super) struct OpenPart {
    pub(super) part: LeafPart,
    borders: Vec<usize>,
}

/// The light of the leaves as it was found, band by band.
pub(super) struct FoundLight<'f> {
    pub(super) received: &'f [Vec<Linear>],
    /// How far from linear it may be, as irradiance.
    pub(super) bend: Vec<Vec<f64>>,
}

impl FoundLight<'_> {
    fn of(&self, leaf: usize) -> Vec<Linear> {
        self.received.iter().map(|received| received[leaf]).collect()
    }
}

/// Leaves on their way to pieces.
pub(super) struct Cutting<'c, 's> {
    tiling: &'s Tiling<'s>,
    direct: &'s Direct<'s>,
    leaves: &'c [usize],
    evenness: Evenness<'c>,
    area: f64,
    borders: Borders<'s>,
    pub(super) corners: CornerLight<'s>,
}

impl<'c, 's> Cutting<'c, 's> {
    pub(super) fn new(
        sights: &Sights<'s>,
        corners: CornerLight<'s>,
        leaves: &'c [usize],
        evenness: Evenness<'c>,
    ) -> Cutting<'c, 's> {
        let (tiling, direct) = (sights.tiling, sights.direct);
        let area = leaves.iter().map(|&leaf| tiling.tiles[leaf].area).sum();
        Cutting { tiling, direct, leaves, evenness, area, borders: Borders::new(tiling), corners }
    }

    /// A whole leaf, and the borders of shadows on it.
    pub(super) fn open(&mut self, part: LeafPart) -> OpenPart {
        let borders = self.borders.of(self.tiling.tiles[self.leaves[part.leaf]].patch, &part.outline);
        OpenPart { part, borders }
    }

    /// The light of the five points of every part; corners that were not looked from yet are.
    pub(super) fn look(
        &mut self,
        sights: &Sights<'_>,
        parts: &[OpenPart],
        ask: Ask<'_>,
    ) -> Result<Option<Vec<f64>>, Error> {
        if !self.look_from_corners(sights, parts, &mut *ask)? {
            return Ok(None);
        }
        let mut points: Vec<(usize, DifferentialArea)> = Vec::with_capacity(5 * parts.len());
        for OpenPart { part, .. } in parts {
            let tile = self.leaves[part.leaf];
            let on = self.tiling.points(self.tiling.tiles[tile].patch, &part.outline)?;
            points.extend(on.map(|point| (tile, point)));
        }
        let Some(light) = sights.irradiance(&points, ask)? else { return Ok(None) };
        let bands = self.evenness.dim.len();
        self.add_middles(parts, light.chunks(5 * bands).map(|light| &light[..bands]));
        Ok(Some(light))
    }

    /// Keeps what the middles of parts receive.
    fn add_middles<'l>(&mut self, parts: &[OpenPart], light: impl Iterator<Item = &'l [f64]>) {
        let key = |OpenPart { part, .. }: &OpenPart| {
            self.corners.key(self.leaves[part.leaf], part.outline.points()[0])
        };
        let keys: Vec<CornerKey> = parts.iter().map(key).collect();
        self.corners.add(keys.into_iter().zip(light.map(<[f64]>::to_vec)));
    }

    /// Looks from the corners that were not looked from yet; false when the caller wants to stop.
    pub(super) fn look_from_corners(
        &mut self,
        sights: &Sights<'_>,
        parts: &[OpenPart],
        ask: Ask<'_>,
    ) -> Result<bool, Error> {
        let (tiling, new) = (self.tiling, self.new_corners(parts));
        let mut points = Vec::with_capacity(new.len());
        for (key, &(tile, corner)) in &new {
            let inward = if self.corners.is_at_rim(key, corner) { INWARD } else { 0.0 };
            let inside = corner.lerp(tiling.tiles[tile].outline.centroid, inward);
            points.push((tile, tiling.point(tiling.tiles[tile].patch, inside)?));
        }
        let Some(light) = sights.irradiance(&points, ask)? else { return Ok(false) };
        let each = light.chunks(self.evenness.dim.len()).map(<[f64]>::to_vec);
        self.corners.add(new.into_keys().zip(each));
        Ok(true)
    }

    /// The corners that were not looked from yet. Where something stands on a leaf, or a shadow has an edge on it, it is not known on which
    /// side of that a corner is: those are left out.
    fn new_corners(&self, parts: &[OpenPart]) -> BTreeMap<CornerKey, (usize, DVec2)> {
        let of_part = |OpenPart { part, .. }: &OpenPart| {
            let tile = self.leaves[part.leaf];
            let is_plain = self.is_plain(tile);
            let corners = part.outline.corners.iter().filter(move |_| is_plain);
            corners
                .map(move |corner| (self.corners.key(tile, corner.0), (tile, corner.0)))
                .collect::<Vec<_>>()
        };
        let all = parts.iter().flat_map(of_part);
        all.filter(|(key, _)| !self.corners.is_known(key)).collect()
    }

    /// Whether nothing stands on a leaf, and no shadow has an edge on it.
    fn is_plain(&self, tile: usize) -> bool {
        !self.tiling.tiles[tile].is_crossed && !self.direct.has_edges(tile)
    }

    /// Whether a whole leaf is said to bend little, which corners can agree with: nothing stands on it that parts its light.
    fn is_said_to_be_flat(&self, piece: &OpenPart, found: &FoundLight<'_>) -> bool {
        let leaf = piece.part.leaf;
        let tile = self.leaves[leaf];
        let bends =
            found.bend.iter().zip(found.received).map(|(bend, received)| [bend[tile], received[leaf][0]]);
        self.is_plain(tile) && self.evenness.worst(bends) <= self.most_of_leaf(piece)
    }

    /// How far from linear the light of a whole leaf may be said to be.
    fn most_of_leaf(&self, OpenPart { part, borders }: &OpenPart) -> f64 {
        let times = if borders.is_empty() { FLAT } else { 1.0 };
        times * self.most(self.tiling.tiles[self.leaves[part.leaf]].patch, &part.outline)
    }

    /// Whether the light of a whole leaf is known to be linear enough: its corners, all looked from, receive about what they were found to, and it
    /// bends little.
    pub(super) fn is_flat(&self, piece: &OpenPart, found: &FoundLight<'_>) -> bool {
        let LeafPart { leaf, outline } = &piece.part;
        let is_within = |corner: &(DVec2, DVec3)| {
            let key = self.corners.key(self.leaves[*leaf], corner.0);
            let Some(light) = self.corners.of(&key) else { return false };
            self.evenness.off(&found.of(*leaf), outline.linear(corner.0), light) <= self.most_of_leaf(piece)
        };
        self.is_said_to_be_flat(piece, found) && outline.corners.iter().all(is_within)
    }

    /// Looks from the middles of whole leaves: those whose light is linear enough as these and their corners say, and the others; nothing when the caller
    /// wants to stop.
    pub(super) fn look_from_middles(
        &mut self,
        sights: &Sights<'_>,
        parts: Vec<OpenPart>,
        found: &FoundLight<'_>,
        ask: Ask<'_>,
    ) -> Result<Option<EvenAndOpen>, Error> {
        let may_be_even = |piece: &OpenPart| {
            piece.borders.is_empty()
                && self.is_said_to_be_flat(piece, found)
                && self.quad(&piece.part).is_some()
        };
        let (quads, mut others): (Vec<_>, Vec<_>) = parts.into_iter().partition(may_be_even);
        let middle = |OpenPart { part, .. }: &OpenPart| {
            let tile = self.leaves[part.leaf];
            Ok((tile, self.tiling.point(self.tiling.tiles[tile].patch, part.outline.points()[0])?))
        };
        let points = quads.iter().map(middle).collect::<Result<Vec<_>, Error>>()?;
        let Some(light) = sights.irradiance(&points, ask)? else { return Ok(None) };
        self.add_middles(&quads, light.chunks(self.evenness.dim.len()));
        let mut even = Vec::with_capacity(quads.len());
        for (piece, middle) in quads.into_iter().zip(light.chunks(self.evenness.dim.len())) {
            if self.is_even(&piece.part, middle) {
                even.push(piece.part);
            } else {
                others.push(piece);
            }
        }
        Ok(Some((even, others)))
    }

    /// What the corners of a leaf with four of them receive, if all were looked from.
    fn quad(&self, LeafPart { leaf, outline }: &LeafPart) -> Option<[&[f64]; 4]> {
        let tile = self.leaves[*leaf];
        let corners: &[_; 4] = outline.corners.as_slice().try_into().ok()?;
        let [a, b, c, d] = corners.map(|corner| self.corners.of(&self.corners.key(tile, corner.0)));
        Some([a?, b?, c?, d?])
    }

    /// Whether the light of a leaf with four corners is linear enough along its diagonals.
    fn is_even(&self, part: &LeafPart, middle: &[f64]) -> bool {
        let most = self.most(self.tiling.tiles[self.leaves[part.leaf]].patch, &part.outline);
        let is_straight = |one: &[f64], other: &[f64]| {
            let mean = one.iter().zip(other).map(|(one, other)| f64::midpoint(*one, *other));
            let off = mean.zip(middle).map(|(mean, middle)| [mean - middle, middle.max(mean)]);
            self.evenness.worst(off) <= DIAGONAL * most
        };
        self.quad(part).is_some_and(|[a, b, c, d]| is_straight(a, c) && is_straight(b, d))
    }

    /// How far from linear the light of a part may be, as a share.
    fn most(&self, patch: usize, outline: &Outline) -> f64 {
        let area = self.tiling.area(patch, outline) / self.area;
        (SMALL / area).sqrt().max(1.0) * BENT * self.evenness.share
    }

    /// The halves of a part whose light is not linear enough, or on which something stands: cut along the border of a shadow where one passes
    /// through.
    pub(super) fn halves(&self, piece: &OpenPart, light: &[f64]) -> Option<[OpenPart; 2]> {
        let OpenPart { part: LeafPart { leaf, outline }, borders } = piece;
        let tile = self.leaves[*leaf];
        let patch = self.tiling.tiles[tile].patch;
        let area = self.tiling.area(patch, outline) / self.area;
        let corners = outline.corners.iter().filter_map(|corner| {
            Some((outline.linear(corner.0), self.corners.of(&self.corners.key(tile, corner.0))?))
        });
        let uneven = self.evenness.uneven(light, corners, self.most(patch, outline)).filter(|_| area > LEAST);
        // What stands on a leaf parts what it covers from what is lit.
        let is_crossed = self.tiling.is_crossed(patch, outline);
        let axis = uneven.or(is_crossed.then_some(0))?;
        let inside = self.borders.within(patch, outline, borders);
        let edge = self.direct.edge_in(tile, outline);
        let is_parted = is_crossed || edge.is_some();
        let along = if is_parted { None } else { self.borders.cut(patch, outline, &inside) };
        let halves = along.or_else(|| self.tiling.cut_along(patch, outline, edge, axis))?;
        let borders: Vec<usize> = inside.into_iter().map(|(_, border)| border).collect();
        let open = |outline| OpenPart { part: LeafPart { leaf: *leaf, outline }, borders: borders.clone() };
        Some(halves.map(open))
    }
}
