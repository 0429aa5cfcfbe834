//! Bodies: polygons that are connected by edges, closed by lids where they are open. Of such a body the far side hides nothing that its
//! near side does not, and of a convex target's own body nothing hides.
//!
//! ```text
//! components  polygons that are connected, and their open edges
//! lids        polygons that close these
//! winding     how often a closed body winds around a point
//! clearance   whether something touches the front of a face
//! ```
//!
//! A line that runs from dA to a point just before a face meets the body's fronts more often than its backs by as much as the body winds
//! more often around that point than around dA. So where that is no less often, a line that leaves the body through the face has met a
//! front before: that hides all that the face could hide. Lids hide nothing, so that none may be met by its front on the way to the face:
//! dA must be behind a lid, or the face before it.
//!
//! ```text
//!         ______
//!   dA   /      \        The line comes in through a front and goes out through a back.
//!   ·---/--------\---
//!       |        |       Where the lid faces dA, it may come in through the lid.
//!       |...lid..|
//! ```
mod clearance;
mod components;
mod lids;
mod winding;

use super::line::LineOfSight;
use super::shell::{Adjacency, shells};
use crate::numeric::rounding::rounding_of;
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use clearance::is_clear;
use components::{Component, components};
use glam::DVec3;
use lids::lids;
use std::cmp::Ordering;
use winding::{Body, Owner};

/// The bodies among polygons.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bodies {
    bodies: Vec<Body>,
    /// What is known of each polygon that is a face of one.
    faces: Vec<Option<BodyFace>>,
    /// The closed convex body that each polygon belongs to.
    convex: Vec<Option<usize>>,
}

/// A face of a body that hides nothing from where its back is seen and the body winds around no more often than before the face.
#[derive(Clone, Debug)]
struct BodyFace {
    body: usize,
    /// How often the body winds around points just before the face.
    turns: i32,
    /// The lids that the face is not before, a bit for each.
    lids: u64,
}

/// What was found of bodies for one differential area and one target, each once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Around(Vec<BodyView>);

/// A body as a differential area sees it.
#[derive(Clone, Copy, Debug)]
struct BodyView {
    body: usize,
    /// The lids that face the area and may stand before the target.
    lids: u64,
    /// How often the body winds around the area, if that is known, and whether it was looked for.
    turns: Option<Option<i32>>,
}

impl Bodies {
    /// Takes O(n log n) for n edges where few faces are near each other, and the square of the faces of each convex body.
    pub(crate) fn among(polygons: &[PlanarPolygon], adjacency: &Adjacency) -> Self {
        let mut found = Self {
            bodies: Vec::new(),
            faces: vec![None; polygons.len()],
            convex: convex(polygons, adjacency),
        };
        for Component { faces, open } in components(polygons) {
            let Some(lids) = lids(&open) else { continue };
            let body = Body::new(polygons, faces, lids);
            for id in body.faces() {
                found.faces[*id] = face(polygons, &body, *id, found.bodies.len());
            }
            found.bodies.push(body);
        }
        found
    }

    /// Whether two polygons belong to one closed convex body. Then neither hides any of the other's front: the body lies behind it.
    pub(crate) fn is_one(&self, id: usize, other: usize) -> bool {
        self.convex[id].is_some() && self.convex[id] == self.convex[other]
    }

    /// Whether polygon `id` turns its back to dA, and what it could hide of a target its body hides anyway. Lids in boxes that are `outside` do
    /// not stand before the target. Decided exactly; where dA may touch its body, the answer is no.
    pub(crate) fn is_far_side(
        &self,
        polygons: &[PlanarPolygon],
        from: &DifferentialArea,
        id: usize,
        outside: impl Fn(&Extent) -> bool,
        around: &mut Around,
    ) -> bool {
        let Some(face) = &self.faces[id] else { return false };
        if polygons[id].plane().side_of(from.position()) != Ordering::Less {
            return false;
        }
        let body = &self.bodies[face.body];
        let seen = around.of(face.body, || body.facing_lids(from.position(), outside));
        if seen.lids & face.lids != 0 {
            return false;
        }
        let owner = from.owner().map(|owner| Owner::of(from, &polygons[owner]));
        let turns = seen.turns.get_or_insert_with(|| body.turns_around(polygons, from.position(), owner));
        turns.is_some_and(|turns| turns <= face.turns)
    }
}

impl Around {
    /// A body as it is seen; `lids` finds those that face dA.
    fn of(&mut self, body: usize, lids: impl FnOnce() -> u64) -> &mut BodyView {
        let known = self.0.iter().position(|seen| seen.body == body);
        let at = known.unwrap_or_else(|| {
            self.0.push(BodyView { body, lids: lids(), turns: None });
            self.0.len() - 1
        });
        &mut self.0[at]
    }
}

/// The closed convex body of each polygon.
fn convex(polygons: &[PlanarPolygon], adjacency: &Adjacency) -> Vec<Option<usize>> {
    let mut of = vec![None; polygons.len()];
    let is_exact = |id: &usize| polygons[*id].is_convex() && polygons[*id].deviation() == 0.0;
    let shells = shells(polygons, adjacency, |id, point| polygons[id].plane().side_of(point)).into_iter();
    let closed = shells.filter(|faces| faces.iter().all(is_exact) && adjacency.are_closed(faces));
    closed.enumerate().for_each(|(number, faces)| faces.iter().for_each(|id| of[*id] = Some(number)));
    of
}

/// What is known of a face, if the body winds as often around all points just before it.
fn face(polygons: &[PlanarPolygon], body: &Body, id: usize, number: usize) -> Option<BodyFace> {
    let polygon = &polygons[id];
    let extent = Extent::around(polygon.points());
    let mut near = body.near(polygons, |other| other.misses(&extent));
    if !near.all(|other| std::ptr::eq(other, polygon) || is_clear(polygon, other)) {
        return None;
    }
    let is_before = |lid: &PlanarPolygon| {
        let sides = || polygon.points().iter().map(|p| lid.plane().side_of(*p));
        // A line reaches a lid in the face's plane where it reaches the face.
        sides().all(Ordering::is_ge) && !sides().all(Ordering::is_eq)
    };
    let lids = body.lids_that(|lid| !is_before(lid));
    Some(BodyFace { body: number, turns: turns_before(polygons, body, polygon)?, lids })
}

/// How often the body winds around a point just before the middle of a face; nothing where some other of its faces is between the two.
fn turns_before(polygons: &[PlanarPolygon], body: &Body, face: &PlanarPolygon) -> Option<i32> {
    let piece = face.convex_pieces().next()?;
    let middle = piece.iter().fold(DVec3::ZERO, |sum, p| sum + *p / piece.len() as f64);
    let size = piece.iter().map(|p| p.distance(middle)).fold(0.0, f64::max);
    let step = face.normal() * (STEP * size + 8.0 * rounding_of([middle]));
    let line = LineOfSight::between(middle + step, middle - step);
    let mut met = body.near(polygons, |extent| line.misses_box(extent));
    let is_level =
        |other: &PlanarPolygon| other.plane().corners.iter().all(|p| face.plane().side_of(*p).is_eq());
    let is_free = met.all(|other| is_level(other) || !line.is_blocked_by(other));
    let turns = || body.turns_around(polygons, middle + step, None);
    (is_free && line.is_blocked_by(face)).then(turns).flatten()
}

/// How far before a face the point is from which the body is looked at, in shares of the face's size.
const STEP: f64 = 1e-6;
