//! What is inside of a convex solid: whether it may be one occluder, and which polygons look into it.
use super::{apart::are_apart, tree::Tree};
use crate::shapes::{extent::Extent, loops::leaf, polygon::PlanarPolygon};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// A convex solid: the polygons that are faces of it, and the faces that are not there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solid<'s> {
    pub(crate) faces: &'s [usize],
    pub(crate) lids: &'s [PlanarPolygon],
}

/// A polygon in the plane of a solid's side that looks into it, and the number of the side: first of the faces, then of the lids.
pub(crate) type Inward = (usize, usize);

impl<'s> Solid<'s> {
    /// All sides.
    pub(crate) fn sides(self, polygons: &'s [PlanarPolygon]) -> impl Iterator<Item = &'s PlanarPolygon> {
        self.faces.iter().map(|face| &polygons[*face]).chain(self.lids)
    }

    /// The polygons that look into it, if from outside it hides what it would if it were full: `None` where others may see
    /// each other through it, or may be inside.
    ///
    /// What crosses it without meeting a face passes two lids. One is not passed where all polygons are on one side of it or where
    /// others cover it: there a line ends, on what looks inward or else on a back. So one other lid does no harm,
    /// where what looks inward is in its plane.
    pub(crate) fn looked_into(self, polygons: &[PlanarPolygon], tree: &Tree) -> Option<Vec<Inward>> {
        let corners: Vec<DVec3> = self.sides(polygons).flat_map(PlanarPolygon::points).copied().collect();
        let around = Extent::around(&corners);
        let near =
            |id: &usize| !self.faces.contains(id) && !Extent::around(polygons[*id].points()).misses(&around);
        let others: Vec<usize> =
            tree.find(|extent| extent.misses(&around)).into_iter().filter(near).collect();
        let mut inward = Vec::new();
        for id in &others {
            let other = &polygons[*id];
            let stances = || self.sides(polygons).map(|side| stance(other, side));
            match stances().max() {
                Some(Stance::Outside) => (),
                Some(Stance::Inward) => {
                    let at = |(side, stance)| (stance == Stance::Inward).then_some(side);
                    let sides = stances().enumerate().filter_map(at);
                    let mut met =
                        sides.filter(|side| self.sides(polygons).nth(*side).is_some_and(|s| meet(other, s)));
                    inward.extend(met.next().map(|side| (*id, side)));
                }
                _ if is_beside(other, &corners) => (),
                _ => return None,
            }
        }
        let is_only = |lid: usize| inward.iter().all(|(_, side)| *side == self.faces.len() + lid);
        let is_closed = match self.lids {
            [] => true,
            [_] if is_only(0) => true,
            lids => {
                let is_open = |lid: &usize| !is_closed_off(&lids[*lid], polygons, &others);
                let mut open = (0..lids.len()).filter(is_open);
                open.next().is_none_or(|lid| is_only(lid) && open.next().is_none())
            }
        };
        is_closed.then_some(inward)
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

fn stance(other: &PlanarPolygon, side: &PlanarPolygon) -> Stance {
    let heights = other.points().iter().map(|p| side.plane().side_of(*p));
    match [heights.clone().min(), heights.max()] {
        [Some(Ordering::Less), _] => Stance::Behind,
        [_, Some(Ordering::Equal)] if other.normal().dot(side.normal()) < 0.0 => Stance::Inward,
        _ => Stance::Outside,
    }
}

/// Whether a polygon that lies in no side's plane is outside of a convex solid, as its own plane or some other one shows.
fn is_beside(polygon: &PlanarPolygon, corners: &[DVec3]) -> bool {
    let sides = || corners.iter().map(|p| polygon.plane().side_of(*p));
    let is_to_one_side = !sides().any(Ordering::is_gt) || !sides().any(Ordering::is_lt);
    is_to_one_side || are_apart(corners, polygon.points(), polygon.points()[0] - corners[0])
}

/// The loops of a polygon in the plane of another one.
fn flat(polygon: &PlanarPolygon, plane: &PlanarPolygon) -> Vec<Vec<DVec2>> {
    polygon.loops().map(|l| l.iter().map(|p| plane.flat(*p)).collect()).collect()
}

/// Whether two polygons of one plane have an area in common.
fn meet(one: &PlanarPolygon, other: &PlanarPolygon) -> bool {
    let [one, other] = [flat(one, other), flat(other, other)];
    !(leaf(&one) & leaf(&other)).evaluate().is_empty()
}

/// Whether no line that crosses a lid goes on: others in its plane cover it, or nothing is before it.
fn is_closed_off(lid: &PlanarPolygon, polygons: &[PlanarPolygon], others: &[usize]) -> bool {
    let coplanar = others.iter().map(|id| &polygons[*id]).filter(|other| other.lies_in_plane_of(lid));
    let covers: Vec<_> = coplanar.map(|cover| flat(cover, lid)).collect();
    let own = flat(lid, lid);
    let left = covers.iter().fold(leaf(&own), |left, cover| left - leaf(cover));
    let is_covered = || left.evaluate().is_empty();
    let is_last = || polygons.iter().flat_map(PlanarPolygon::points).all(|p| lid.plane().side_of(*p).is_le());
    (!covers.is_empty() && is_covered()) || is_last()
}
