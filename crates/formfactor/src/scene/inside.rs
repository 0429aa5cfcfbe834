//! What is inside of a convex solid: whether it may be one occluder, and for whom it is not.
use super::{apart::are_apart, slab::Slab, tree::Tree};
use crate::shapes::{extent::Extent, loops::leaf, polygon::PlanarPolygon};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// A convex solid: the polygons that are faces of it, and the faces that are not there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solid<'s> {
    pub(crate) faces: &'s [usize],
    pub(crate) lids: &'s [PlanarPolygon],
    /// Holes in the faces: lids as well.
    pub(crate) holes: &'s [PlanarPolygon],
}

/// What has to do with the inside of a solid.
#[derive(Clone, Debug, Default)]
pub(crate) struct Within {
    /// Polygons that may see through the solid, as they are in it or look into it: its faces count for them one by one.
    pub(crate) insiders: Vec<usize>,
    /// Polygons in the planes of sides that look into it where nothing else is, and the numbers of the sides: first of the faces, then of the
    /// lids.
    pub(crate) inward: Vec<(usize, usize)>,
}

impl<'s> Solid<'s> {
    /// All sides: the faces, the lids, then the holes.
    pub(crate) fn sides(self, polygons: &'s [PlanarPolygon]) -> impl Iterator<Item = &'s PlanarPolygon> {
        self.faces.iter().map(|face| &polygons[*face]).chain(self.lids).chain(self.holes)
    }

    /// What is in it or looks into it, if others see of each other what they would if it were full.
    ///
    /// What crosses it without meeting a face passes two lids. One is not passed where all polygons are on one side of it or where
    /// others cover it: there a line ends, on what looks inward or else on a back. So other lids in one plane do no harm: no line passes
    /// two of them.
    pub(crate) fn inside(self, polygons: &[PlanarPolygon], tree: &Tree) -> Option<Within> {
        let (others, mut insiders, inward) = self.near(polygons, tree);
        let sides: Vec<&PlanarPolygon> = self.sides(polygons).collect();
        let lids = &sides[self.faces.len()..];
        let is_only = |lids: &[&PlanarPolygon]| {
            let looked_into = inward.iter().map(|(_, side)| sides[*side]);
            lids.is_empty() || are_level(lids.iter().copied().chain(looked_into))
        };
        if insiders.is_empty() && is_only(lids) {
            return Some(Within { insiders, inward });
        }
        let is_open = |lid: &&PlanarPolygon| !is_closed_off(lid, polygons, &others);
        let open: Vec<&PlanarPolygon> = lids.iter().copied().filter(is_open).collect();
        if !are_level(open.iter().copied()) {
            return None;
        }
        if insiders.is_empty() && is_only(&open) {
            return Some(Within { insiders, inward });
        }
        insiders.extend(inward.iter().map(|(id, _)| *id));
        Some(Within { insiders, inward: Vec::new() })
    }

    /// The polygons near it, those of them that no plane shows to be outside, and those that look into it from a side's plane.
    fn near(self, polygons: &[PlanarPolygon], tree: &Tree) -> (Vec<usize>, Vec<usize>, Vec<(usize, usize)>) {
        let corners: Vec<DVec3> = self.sides(polygons).flat_map(PlanarPolygon::points).copied().collect();
        let sides: Vec<(&PlanarPolygon, Slab)> =
            self.sides(polygons).map(|side| (side, Slab::of(side))).collect();
        let around = Extent::around(&corners);
        let is_near =
            |id: &usize| !self.faces.contains(id) && !Extent::around(polygons[*id].points()).misses(&around);
        let mut others = tree.find(|extent| extent.misses(&around));
        others.retain(is_near);
        let (mut insiders, mut inward) = (Vec::new(), Vec::new());
        for id in &others {
            let other = &polygons[*id];
            match sides.iter().map(|side| stance(other, side)).max() {
                Some(Stance::Outside) => (),
                Some(Stance::Inward) => {
                    let is_met = |side: &&(&PlanarPolygon, Slab)| {
                        stance(other, side) == Stance::Inward && meet(other, side)
                    };
                    match sides.iter().position(|side| is_met(&side)) {
                        Some(side) if sides[side].0.is_convex() => inward.push((*id, side)),
                        Some(_) => insiders.push(*id),
                        None => (),
                    }
                }
                _ if is_beside(other, &corners) => (),
                _ => insiders.push(*id),
            }
        }
        (others, insiders, inward)
    }
}

/// Where a polygon is as far as one side of a convex solid says, from the worst on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Stance {
    /// Some of it is behind the side.
    Behind,
    /// In the side's plane, and looks into the solid.
    Inward,
    /// Before the side, or in its plane and looks away.
    Outside,
}

fn stance(other: &PlanarPolygon, (side, slab): &(&PlanarPolygon, Slab)) -> Stance {
    let is_level = slab.has(other) || Slab::of(other).has(side);
    if is_level && other.normal().dot(side.normal()) < 0.0 {
        Stance::Inward
    } else if is_level || other.points().iter().all(|p| slab.side_of(*p).is_ge()) {
        Stance::Outside
    } else {
        Stance::Behind
    }
}

/// Whether a polygon that lies in no side's plane is outside of a convex solid, as its own plane or some other one shows.
fn is_beside(polygon: &PlanarPolygon, corners: &[DVec3]) -> bool {
    let slab = Slab::of(polygon);
    let sides = || corners.iter().map(|p| slab.side_of(*p));
    let is_to_one_side = !sides().any(Ordering::is_gt) || !sides().any(Ordering::is_lt);
    is_to_one_side || are_apart(corners, polygon.points(), polygon.points()[0] - corners[0])
}

/// The loops of a polygon in the plane of another one.
fn flat(polygon: &PlanarPolygon, plane: &PlanarPolygon) -> Vec<Vec<DVec2>> {
    polygon.loops().map(|l| l.iter().map(|p| plane.flat(*p)).collect()).collect()
}

/// Whether a polygon has an area in common with a side in whose plane it is.
fn meet(other: &PlanarPolygon, (side, slab): &(&PlanarPolygon, Slab)) -> bool {
    let [one, other] = [flat(other, side), flat(side, side)];
    (leaf(&one) & leaf(&other)).evaluate().area() > strip(side, slab)
}

/// The area within roundings of a side's edges, in its kept coordinates at most.
fn strip(side: &PlanarPolygon, slab: &Slab) -> f64 {
    4.0 * slab.thickness * side.edges().map(|(a, b)| a.distance(b)).sum::<f64>()
}

/// Whether polygons are in one plane.
fn are_level<'p>(mut polygons: impl Iterator<Item = &'p PlanarPolygon>) -> bool {
    let Some(first) = polygons.next() else { return true };
    let slab = Slab::of(first);
    polygons.all(|other| slab.has(other) || Slab::of(other).has(first))
}

/// Whether no line that crosses a lid goes on: others in its plane cover it, or nothing is before it.
fn is_closed_off(lid: &PlanarPolygon, polygons: &[PlanarPolygon], others: &[usize]) -> bool {
    let slab = Slab::of(lid);
    let is_level = |other: &&PlanarPolygon| slab.has(other) || Slab::of(other).has(lid);
    let coplanar: Vec<&PlanarPolygon> = others.iter().map(|id| &polygons[*id]).filter(is_level).collect();
    let own = flat(lid, lid);
    let covers: Vec<_> = coplanar.iter().map(|cover| flat(cover, lid)).collect();
    let left = covers.iter().fold(leaf(&own), |left, cover| left - leaf(cover));
    let is_covered = || left.evaluate().area() <= strip(lid, &slab);
    // The largest knows the plane best.
    let by_area = |a: &&&PlanarPolygon, b: &&&PlanarPolygon| a.area().total_cmp(&b.area());
    let level = coplanar.iter().max_by(by_area).map_or(lid, |largest| largest);
    (!covers.is_empty() && is_covered()) || is_last(lid, level, polygons)
}

/// Whether no polygon is before a lid, by one in its plane.
fn is_last(lid: &PlanarPolygon, level: &PlanarPolygon, polygons: &[PlanarPolygon]) -> bool {
    let slab = Slab::of(level);
    let is_behind =
        |side: Ordering| if level.normal().dot(lid.normal()) > 0.0 { side.is_le() } else { side.is_ge() };
    polygons.iter().flat_map(PlanarPolygon::points).all(|p| is_behind(slab.side_of(*p)))
}
