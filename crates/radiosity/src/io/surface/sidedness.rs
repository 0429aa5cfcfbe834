//! Which polygons of a repaired file keep two sides, and which are written with one.
//!
//! Reading leaves out the inner sides of closed bodies whose surfaces are double-sided. A body that was cut is closed no longer: read
//! again, its inner sides would come back. So its polygons are written with the one side that was seen.
use super::place::turned;
use crate::coplanar::{SINGLE, perimeter};
use crate::extent::Extent;
use crate::plane::Plane;
use crate::scene::{Scene, patch::Origin, patch::Patch};
use crate::sides::{closed_bodies, needed_sides};
use formfactor::PlanarPolygon;
use glam::DVec3;
use polycsg::{Csg, Region};
use std::collections::{BTreeMap, BTreeSet};

/// A polygon of the file: its instance, its primitive, and itself.
pub(super) type PolygonPlace = [usize; 3];

/// The patches of the two sides of a polygon.
pub(super) type TwoSides<'s> = [Vec<&'s Patch>; 2];

/// A polygon of the file, before the repair and after it.
#[derive(Debug)]
pub(super) struct RepairedPolygon<'s> {
    pub(super) old: TwoSides<'s>,
    pub(super) new: TwoSides<'s>,
    /// Of each side, whether it is no longer what the file holds.
    pub(super) is_changed: [bool; 2],
}

pub(super) fn place(origin: &Origin) -> PolygonPlace {
    let Origin { instance, primitive, polygon } = *origin;
    [instance, primitive, polygon]
}

pub(super) fn by_polygon(scene: &Scene) -> BTreeMap<PolygonPlace, TwoSides<'_>> {
    let mut sides: BTreeMap<PolygonPlace, TwoSides<'_>> = BTreeMap::new();
    for patch in &scene.patches {
        sides.entry(place(&patch.origin)).or_default()[usize::from(patch.is_back)].push(patch);
    }
    sides
}

impl<'s> RepairedPolygon<'s> {
    /// What moved by no more than rounding stays: the file's numbers may not hold its new place. What is `flawed` was split or left out
    /// while it was read.
    pub(super) fn new(old: TwoSides<'s>, new: TwoSides<'s>, is_flawed: bool) -> RepairedPolygon<'s> {
        let is_changed = [0, 1].map(|side| is_flawed || !are_alike(&old[side], &new[side]));
        RepairedPolygon { old, new, is_changed }
    }

    /// The sides that were seen before the repair.
    pub(super) fn seen(&self) -> impl Iterator<Item = usize> {
        (0..2).filter(|side| !self.old[*side].is_empty())
    }

    /// Whether it was cut: an edge of it may be gone, and new ones are there.
    fn is_cut(&self) -> bool {
        (0..2).any(|side| !are_alike(&self.old[side], &self.new[side]))
    }

    /// The side whose outline both sides get: that of which less is left, so that no overlap stays.
    pub(super) fn outline(&self) -> usize {
        let left = |side: usize| self.new[side].iter().map(|patch| patch.polygon.area()).sum::<f64>();
        self.seen().min_by(|a, b| left(*a).total_cmp(&left(*b))).unwrap_or(0)
    }

    /// Whether its sides were cut in different ways, so that each is to be written by itself. The sides of a lamp that shines to one
    /// of them stay together: apart, both would shine.
    pub(super) fn is_apart(&self) -> bool {
        let [Some(front), Some(back)] = [0, 1].map(|side| self.old[side].first()) else { return false };
        self.is_cut() && front.emission == back.emission && !is_one_outline(&self.new)
    }
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

/// Whether two sides cover each other, but for strips that are thinner than rounding.
fn is_one_outline(sides: &TwoSides<'_>) -> bool {
    let Some(first) = sides.iter().flatten().next() else { return true };
    let plane = Plane::of(&first.polygon);
    let region = |patches: &Vec<&Patch>| {
        let regions: Vec<Region> = patches.iter().map(|patch| plane.region(&patch.polygon)).collect();
        Csg::union(&regions).evaluate()
    };
    let polygons = || sides.iter().flatten().map(|patch| &patch.polygon);
    let extent = Extent::holding(polygons().flat_map(PlanarPolygon::loops).flatten());
    let width = first.rounding + SINGLE * extent.diagonal();
    let apart = region(&sides[0]).symmetric_difference(&region(&sides[1]));
    apart.area() <= width * polygons().map(perimeter).sum::<f64>()
}

/// The polygons of which one side is to be written, as it alone was seen: those of closed bodies that were cut, and those whose other side
/// would be seen again as another body was cut.
pub(super) fn one_sided(
    file: &Scene,
    polygons: &BTreeMap<PolygonPlace, RepairedPolygon<'_>>,
) -> BTreeSet<PolygonPlace> {
    let hidden = hidden_sides(file, polygons);
    let cut: BTreeSet<usize> = hidden
        .iter()
        .filter(|(place, _)| polygons.get(*place).is_some_and(RepairedPolygon::is_cut))
        .map(|(_, body)| *body)
        .collect();
    let of_cut = hidden.iter().filter(|(_, body)| cut.contains(body));
    let mut one_sided: BTreeSet<PolygonPlace> = of_cut.map(|(place, _)| *place).collect();
    while one_sided.len() < hidden.len() {
        let known = one_sided.len();
        let scene = read_again(file, polygons, &one_sided);
        let needed = needed_sides(&scene);
        let came_back = |patch: &&Patch| {
            let place = place(&patch.origin);
            hidden.contains_key(&place) && polygons[&place].old[usize::from(patch.is_back)].is_empty()
        };
        // A polygon that is one-sided already has its only side as a front, whichever it was.
        let back = needed.patches.iter().filter(came_back).map(|patch| place(&patch.origin));
        one_sided.extend(back);
        if one_sided.len() == known {
            break;
        }
    }
    one_sided
}

/// The polygons of closed bodies that have two sides in the file, one of which was left out when it was read, with their bodies.
fn hidden_sides(
    file: &Scene,
    polygons: &BTreeMap<PolygonPlace, RepairedPolygon<'_>>,
) -> BTreeMap<PolygonPlace, usize> {
    if polygons.values().all(|polygon| polygon.is_changed == [false; 2]) {
        return BTreeMap::new();
    }
    let patches = file.patches.iter().zip(closed_bodies(file)).filter(|(patch, _)| patch.is_back);
    let of_bodies = patches.filter_map(|(patch, body)| Some((place(&patch.origin), body?)));
    of_bodies.filter(|(place, _)| polygons.get(place).is_some_and(|one| one.seen().count() == 1)).collect()
}

/// The scene of the written file.
fn read_again(
    file: &Scene,
    polygons: &BTreeMap<PolygonPlace, RepairedPolygon<'_>>,
    one_sided: &BTreeSet<PolygonPlace>,
) -> Scene {
    let two_sided: BTreeMap<PolygonPlace, &Patch> = file
        .patches
        .iter()
        .filter(|patch| patch.is_back)
        .map(|patch| (place(&patch.origin), patch))
        .collect();
    let mut patches = Vec::new();
    for (place, polygon) in polygons {
        let sides = || polygon.new.iter().flatten().map(|patch| Patch { is_back: false, ..(*patch).clone() });
        match two_sided.get(place) {
            Some(written) if !one_sided.contains(place) && !polygon.is_apart() => {
                let pieces = &polygon.new[polygon.outline()];
                patches.extend(pieces.iter().flat_map(|piece| both_sides(piece, written)));
            }
            _ => patches.extend(sides()),
        }
    }
    Scene { patches, ..file.clone() }
}

/// A piece and its other side, which emit what the file says.
fn both_sides(piece: &Patch, written: &Patch) -> Vec<Patch> {
    let emission = &written.emission;
    let side = |polygon, is_back| Patch { polygon, is_back, emission: emission.clone(), ..piece.clone() };
    let Some(other) = turned(&piece.polygon) else { return vec![piece.clone()] };
    let [front, back] = if piece.is_back { [&other, &piece.polygon] } else { [&piece.polygon, &other] };
    vec![side(front.clone(), false), side(back.clone(), true)]
}
