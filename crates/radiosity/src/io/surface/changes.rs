//! What became of a file's polygons when its scene was repaired.
use crate::scene::{Scene, patch::Origin, patch::Patch, texture::Texture};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// What takes the place of a polygon, or of a part of it.
#[derive(Debug)]
pub(crate) struct CutPiece<'s> {
    /// In the world, seen from the polygon's front.
    pub(crate) loops: Vec<Vec<DVec3>>,
    pub(crate) normal: DVec3,
    pub(crate) texture: Option<&'s Texture>,
}

/// What changed of a primitive.
#[derive(Debug, Default)]
pub(crate) struct Pieces<'s> {
    /// By the index of the (first) polygon that they are made of.
    pub(crate) of_polygon: BTreeMap<usize, Vec<CutPiece<'s>>>,
    /// Whether the primitive shows a picture.
    pub(crate) is_textured: bool,
}

impl<'s> Pieces<'s> {
    /// All pieces, in the order of their polygons.
    pub(crate) fn all(&self) -> impl Iterator<Item = &CutPiece<'s>> {
        self.of_polygon.values().flatten()
    }
}

/// By instance and by primitive.
pub(crate) type Changes<'s> = BTreeMap<usize, BTreeMap<usize, Pieces<'s>>>;

/// The patches of the two sides of a polygon.
type TwoSides<'s> = [Vec<&'s Patch>; 2];

/// The polygons that are not what they were, and the `flawed` ones, which were split or left out while they were read. What moved by
/// no more than rounding stays: the file's numbers may not hold its new place. Where the two sides of a double-sided polygon were cut in
/// different ways, the first counts: what was cut out of the second lies in its plane and hides it from both sides.
pub(crate) fn changes<'s>(before: &'s Scene, after: &'s Scene, flawed: &[Origin]) -> Changes<'s> {
    let (old, new) = (by_origin(before), by_origin(after));
    let mut changes = Changes::new();
    let flawed: BTreeSet<[usize; 3]> = flawed.iter().map(place).collect();
    for place in old.keys().chain(&flawed) {
        let [old, new] = [&old, &new].map(|sides| sides.get(place).cloned().unwrap_or_default());
        let is_flawed = |side: &usize| flawed.contains(place) && (*side == 1 || !new[0].is_empty());
        let changed = (0..2).find(|side| is_flawed(side) || !are_alike(&old[*side], &new[*side]));
        let (Some(side), &[instance, primitive, polygon]) = (changed, place) else { continue };
        let pieces = new[side].iter().map(|patch| piece(patch)).collect();
        let changed = changes.entry(instance).or_default().entry(primitive).or_default();
        changed.of_polygon.insert(polygon, pieces);
        changed.is_textured |= old[side].iter().any(|patch| patch.texture.is_some());
    }
    changes
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

/// The instance, the primitive and the polygon.
fn place(origin: &Origin) -> [usize; 3] {
    let Origin { instance, primitive, polygon } = *origin;
    [instance, primitive, polygon]
}

fn by_origin(scene: &Scene) -> BTreeMap<[usize; 3], TwoSides<'_>> {
    let mut sides: BTreeMap<[usize; 3], TwoSides<'_>> = BTreeMap::new();
    for patch in &scene.patches {
        sides.entry(place(&patch.origin)).or_default()[usize::from(patch.is_back)].push(patch);
    }
    sides
}

fn are_alike(old: &[&Patch], new: &[&Patch]) -> bool {
    old.len() == new.len() && old.iter().zip(new).all(|(old, new)| is_alike(old, new))
}

/// Whether a patch has the same vertices, but for rounding.
fn is_alike(old: &Patch, new: &Patch) -> bool {
    let [before, after] = [old, new].map(|patch| patch.polygon.loops().map(<[DVec3]>::len));
    let pairs = old.polygon.loops().flatten().zip(new.polygon.loops().flatten());
    before.eq(after)
        && pairs.into_iter().all(|(old_place, new_place)| old_place.distance(*new_place) <= old.rounding)
}

fn piece(patch: &Patch) -> CutPiece<'_> {
    let turn = |points: &[DVec3]| {
        let points = points.iter().copied();
        if patch.is_back { points.rev().collect() } else { points.collect() }
    };
    let normal = patch.polygon.normal();
    CutPiece {
        loops: patch.polygon.loops().map(turn).collect(),
        normal: if patch.is_back { -normal } else { normal },
        texture: patch.texture.as_ref(),
    }
}
