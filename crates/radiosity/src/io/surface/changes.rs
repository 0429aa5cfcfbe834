//! What became of a file's polygons when its scene was repaired.
use super::sidedness::{RepairedPolygon, by_polygon, one_sided, place};
use crate::scene::{Scene, patch::Origin, patch::Patch, texture::Texture};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// The sides of a polygon that are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// Those that its material has.
    OfMaterial,
    /// The front alone.
    Front,
    /// The back alone: it is to become a front.
    Back,
}

/// What takes the place of a polygon, or of a part of it.
#[derive(Debug)]
pub(crate) struct CutPiece<'s> {
    /// In the world, seen from the side that becomes its front.
    pub(crate) loops: Vec<Vec<DVec3>>,
    pub(crate) normal: DVec3,
    pub(crate) texture: Option<&'s Texture>,
    pub(crate) side: Side,
}

/// What is written in place of a polygon.
#[derive(Debug, Default)]
pub(crate) struct Replacement<'s> {
    /// The polygon as it is, but for its other side.
    pub(crate) whole: Option<Side>,
    pub(crate) pieces: Vec<CutPiece<'s>>,
}

/// What changed of a primitive.
#[derive(Debug, Default)]
pub(crate) struct Pieces<'s> {
    /// By the index of the (first) polygon that they are made of.
    pub(crate) of_polygon: BTreeMap<usize, Replacement<'s>>,
    /// Whether the primitive shows a picture.
    pub(crate) is_textured: bool,
}

impl<'s> Pieces<'s> {
    /// The pieces with these sides, in the order of their polygons.
    pub(crate) fn of_side(&self, side: Side) -> impl Iterator<Item = &CutPiece<'s>> {
        self.of_polygon.values().flat_map(|new| &new.pieces).filter(move |piece| piece.side == side)
    }

    /// The polygons of which that side stays as it is.
    pub(crate) fn whole(&self, side: Side) -> impl Iterator<Item = usize> {
        self.of_polygon.iter().filter(move |(_, new)| new.whole == Some(side)).map(|(polygon, _)| *polygon)
    }
}

/// By instance and by primitive.
pub(crate) type Changes<'s> = BTreeMap<usize, BTreeMap<usize, Pieces<'s>>>;

/// The polygons of a file that are not what they were when it is repaired, and the `flawed` ones, which were split or left out while they
/// were read. Polygons with two sides have one outline, unless these were cut in different ways: then each is a polygon of one side. So are
/// those whose other side would be seen again otherwise: the inner one of a body that is closed no longer.
pub(crate) fn changes<'s>([file, before, after]: [&'s Scene; 3], flawed: &[Origin]) -> Changes<'s> {
    let flawed: BTreeSet<[usize; 3]> = flawed.iter().map(place).collect();
    let ([mut old, mut new], mut polygons) = ([before, after].map(by_polygon), BTreeMap::new());
    let places: BTreeSet<[usize; 3]> = old.keys().chain(&flawed).copied().collect();
    for place in places {
        let [old, new] = [&mut old, &mut new].map(|sides| sides.remove(&place).unwrap_or_default());
        polygons.insert(place, RepairedPolygon::new(old, new, flawed.contains(&place)));
    }
    let one_sided = one_sided(file, &polygons);
    let mut changes = Changes::new();
    for (place, polygon) in &polygons {
        let Some(new) = replacement(polygon, one_sided.contains(place)) else { continue };
        let &[instance, primitive, index] = place;
        let changed = changes.entry(instance).or_default().entry(primitive).or_default();
        changed.of_polygon.insert(index, new);
        changed.is_textured |= polygon.old.iter().flatten().any(|patch| patch.texture.is_some());
    }
    changes
}

/// What is written in place of a polygon; `None` where it stays.
fn replacement<'s>(polygon: &RepairedPolygon<'s>, is_one_sided: bool) -> Option<Replacement<'s>> {
    let mut new = Replacement::default();
    if !(is_one_sided || polygon.is_apart()) {
        let pieces = &polygon.new[polygon.outline()];
        new.pieces.extend(pieces.iter().map(|patch| piece(patch, Side::OfMaterial)));
        return polygon.is_changed.contains(&true).then_some(new);
    }
    for side in polygon.seen() {
        let own = if side == 0 { Side::Front } else { Side::Back };
        if polygon.is_changed[side] {
            new.pieces.extend(polygon.new[side].iter().map(|patch| piece(patch, own)));
        } else {
            new.whole = Some(own);
        }
    }
    Some(new)
}

/// The primitives, by instance and their own index, whose reflectance was limited.
pub(crate) fn dimmed(before: &Scene, after: &Scene) -> BTreeSet<[usize; 2]> {
    let old: BTreeMap<[usize; 3], &Patch> =
        before.patches.iter().map(|patch| (place(&patch.origin), patch)).collect();
    let is_dimmed = |patch: &&Patch| {
        old.get(&place(&patch.origin)).is_some_and(|old| old.reflectance != patch.reflectance)
    };
    let dimmed = after.patches.iter().filter(is_dimmed);
    dimmed.map(|patch| [patch.origin.instance, patch.origin.primitive]).collect()
}

/// A piece as it is written: a back that is written with its front is seen from there.
fn piece(patch: &Patch, side: Side) -> CutPiece<'_> {
    let is_turned = patch.is_back && side == Side::OfMaterial;
    let turn = |points: &[DVec3]| {
        let points = points.iter().copied();
        if is_turned { points.rev().collect() } else { points.collect() }
    };
    let normal = patch.polygon.normal();
    CutPiece {
        loops: patch.polygon.loops().map(turn).collect(),
        normal: if is_turned { -normal } else { normal },
        texture: patch.texture.as_ref(),
        side,
    }
}
