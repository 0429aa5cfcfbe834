//! Form factors from a point in plain doubles: the target's convex pieces less the shadows of convex occluders.
//!
//! From a point an occluder is a cone, the half-spaces inside its silhouette. A target's part in that cone is clipped out of it, and Lambert's sum
//! over it subtracted. Where shadows overlap, each counts less what is in the cones before it. Clipping is continuous: a wrong
//! sign near zero changes areas by roundings only.
use super::clip::{Bound, Clipped, Shears, Soup};
use super::lambert::lambert;
use super::silhouettes::Silhouettes;
use crate::scene::occluder::{Occluder, silhouette};
use glam::DVec3;
use std::{borrow::Cow, ops::Range};

/// An occluder, or a part of one.
pub(super) type Near<'e> = Cow<'e, Occluder>;

/// What is needed to look from points, used again.
#[derive(Debug, Default)]
pub(super) struct Eye {
    facing: Vec<bool>,
    sides: Vec<[bool; 2]>,
    /// Of the occluders that hide something from a cell.
    silhouettes: Silhouettes,
    /// The half-spaces of all cones, and where those of each end.
    walls: Vec<Bound>,
    ends: Vec<usize>,
    target: Vec<DVec3>,
    shadow: Vec<DVec3>,
    spare: Vec<DVec3>,
    /// The half-spaces of cones whose shadows are not empty.
    casting: Vec<Range<usize>>,
    parts: Soup,
    next: Soup,
    shears: Shears,
    /// The number of the occluder that hid all of a target last.
    pub(super) cover: usize,
}

/// What a point sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Focus {
    Nothing,
    Part,
    All,
}

/// What a point sees: the form factor of the target with nothing in between, and of what is hidden of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Seen {
    /// More than that where it was not asked for.
    pub(super) whole: f64,
    pub(super) hidden: f64,
    /// Whether shadows overlap.
    pub(super) is_joint: bool,
}

impl Eye {
    /// What a point with a normal sees of convex pieces past occluders. All of it must be before the point's horizon and the
    /// target's plane.
    pub(super) fn look(
        &mut self,
        from: DVec3,
        normal: DVec3,
        pieces: &[Vec<DVec3>],
        occluders: &[Near],
    ) -> Seen {
        self.cones(&[from], occluders);
        self.sum(from, normal, pieces, true)
    }

    /// Finds which of the occluders the middle of a cell sees before the pieces, and their silhouettes; whether one hides all.
    pub(super) fn focus(&mut self, cell: &[DVec3], pieces: &[Vec<DVec3>], occluders: &[Near]) -> Focus {
        let from = cell.iter().sum::<DVec3>() / cell.len() as f64;
        self.silhouettes.clear();
        for (index, occluder) in occluders.iter().enumerate() {
            let edges = self.silhouettes.try_from(from, occluder);
            if edges.is_empty() && occluder.is_plate {
                continue;
            }
            self.walls.clear();
            self.walls.extend(edges.iter().map(|edge| Bound::through(*edge, from)));
            match self.met(from, pieces) {
                Clipped::All => {
                    self.silhouettes.clear();
                    return Focus::Nothing;
                }
                Clipped::Part if occluder.turns_alike(cell) => self.silhouettes.keep(),
                Clipped::Part => self.silhouettes.turn(index, occluder, cell, pieces),
                Clipped::Nothing => (),
            }
        }
        self.silhouettes.forget();
        if self.silhouettes.is_empty() { Focus::All } else { Focus::Part }
    }

    /// Finds the silhouettes of all occluders as the points of a cell see them before the pieces.
    pub(super) fn face(&mut self, cell: &[DVec3], pieces: &[Vec<DVec3>], occluders: &[Near]) {
        self.silhouettes.clear();
        for (index, occluder) in occluders.iter().enumerate() {
            self.silhouettes.turn(index, occluder, cell, pieces);
        }
    }

    /// What of all pieces is in the cone of the walls.
    fn met(&mut self, from: DVec3, pieces: &[Vec<DVec3>]) -> Clipped {
        let (mut is_covered, mut is_met) = (true, false);
        for piece in pieces {
            self.target.clear();
            self.target.extend(piece.iter().map(|p| *p - from));
            let clipped = self.shears.inside(&mut self.target, &self.walls);
            is_covered &= matches!(clipped, Clipped::All);
            is_met |= !matches!(clipped, Clipped::Nothing);
        }
        match (is_covered, is_met) {
            (true, _) => Clipped::All,
            (false, true) => Clipped::Part,
            (false, false) => Clipped::Nothing,
        }
    }

    /// Whether two of the shadows in focus meet anywhere.
    pub(super) fn shadows_cross(&self, cell: &[DVec3]) -> bool {
        self.silhouettes.cross(cell)
    }

    /// [`Self::look`] past the silhouettes in focus; the whole only if asked for or if it is hidden.
    pub(super) fn look_past(
        &mut self,
        from: DVec3,
        normal: DVec3,
        pieces: &[Vec<DVec3>],
        occluders: &[Near],
        is_whole_asked: bool,
    ) -> Seen {
        self.silhouettes.cones(from, occluders, &mut self.walls, &mut self.ends);
        self.sum(from, normal, pieces, is_whole_asked)
    }

    fn sum(&mut self, from: DVec3, normal: DVec3, pieces: &[Vec<DVec3>], is_whole_asked: bool) -> Seen {
        let mut seen = Seen::default();
        for piece in pieces {
            self.target.clear();
            self.target.extend(piece.iter().map(|p| *p - from));
            let found = self.hidden(normal);
            let whole = if is_whole_asked || found.is_none() { lambert(normal, &self.target) } else { 1.0 };
            let (hidden, is_joint) = found.unwrap_or((whole, false));
            seen.whole += whole;
            seen.hidden += hidden.min(whole);
            seen.is_joint |= is_joint;
        }
        seen
    }

    /// The half-spaces of the parts of the cones that all points of a cell share, from its corners and relative to the first.
    fn cones(&mut self, corners: &[DVec3], occluders: &[Near]) {
        self.walls.clear();
        self.ends.clear();
        occluders.iter().for_each(|occluder| self.cone(corners, occluder));
    }

    /// The half-spaces of one cone more.
    fn cone(&mut self, points: &[DVec3], occluder: &Near) {
        occluder.sides(points, &mut self.sides);
        for from in points {
            occluder.facing(*from, &mut self.facing);
            let sides = self.facing.iter_mut().zip(&self.sides);
            // What all others see or do not see, one that is on the plane does not see otherwise.
            sides.for_each(|(is_seen, [some, others])| *is_seen = *some && (!others || *is_seen));
            let before = self.walls.len();
            let shift = *from - points[0];
            let Self { walls, facing, .. } = &mut *self;
            silhouette(&occluder.ridges, facing, |edge| walls.push(Bound::through(edge, *from).moved(shift)));
            if self.walls.len() == before && occluder.is_plate {
                // Seen edge-on: its cone is empty.
                self.walls.push(Bound::NOWHERE);
            }
        }
        self.ends.push(self.walls.len());
    }

    /// The form factor of what the cones hide of the target, and whether shadows overlap; `None` where one hides all of it.
    fn hidden(&mut self, normal: DVec3) -> Option<(f64, bool)> {
        let Self { walls, ends, target, shadow, casting, parts, next, shears, .. } = self;
        casting.clear();
        let (mut hidden, mut is_joint) = (0.0, false);
        let mut start = 0;
        for end in &*ends {
            let cone = start..*end;
            start = *end;
            shadow.clear();
            shadow.extend_from_slice(target);
            match shears.inside(shadow, &walls[cone.clone()]) {
                Clipped::Nothing => continue,
                Clipped::All => return None,
                Clipped::Part => (),
            }
            if casting.is_empty() {
                hidden += lambert(normal, shadow);
            } else {
                parts.clear();
                parts.push(shadow);
                for earlier in &*casting {
                    next.clear();
                    for part in parts.polygons() {
                        is_joint |= shears.subtract(part, &walls[earlier.clone()], next);
                    }
                    std::mem::swap(parts, next);
                }
                hidden += parts.polygons().map(|part| lambert(normal, part)).sum::<f64>();
            }
            casting.push(cone);
        }
        Some((hidden, is_joint))
    }

    /// What of the pieces is not hidden from all corners of a cell by one of the occluders each: what some point of the
    /// cell may see. Relative to the first corner.
    pub(super) fn not_in_umbrae(&mut self, corners: &[DVec3], pieces: &[Vec<DVec3>], occluders: &[Near]) {
        self.cones(corners, occluders);
        let Self { walls, ends, target, parts, next, shears, .. } = self;
        parts.clear();
        for piece in pieces {
            target.clear();
            target.extend(piece.iter().map(|p| *p - corners[0]));
            parts.push(target);
        }
        let mut start = 0;
        for end in &*ends {
            next.clear();
            for part in parts.polygons() {
                shears.subtract(part, &walls[start..*end], next);
            }
            std::mem::swap(parts, next);
            start = *end;
        }
    }
}

impl Eye {
    /// Whether an occluder hides all of the target's pieces from all of the source's.
    pub(super) fn is_covered(
        &mut self,
        source: &[Vec<DVec3>],
        target: &[Vec<DVec3>],
        occluder: &Near,
    ) -> bool {
        source.iter().flatten().all(|from| {
            self.cones(&[*from], std::slice::from_ref(occluder));
            target.iter().flatten().all(|p| self.walls.iter().all(|wall| wall.depth(*p - *from) >= 0.0))
        })
    }

    /// The largest form factor, from nodes of a cell, of what some of it may see as far as its umbrae say.
    pub(super) fn left_open(
        &mut self,
        corners: &[DVec3],
        normal: DVec3,
        target: &[Vec<DVec3>],
        occluders: &[Near],
    ) -> f64 {
        self.not_in_umbrae(corners, target, occluders);
        let Self { parts, spare, .. } = self;
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64 - corners[0];
        let near = corners.iter().map(|corner| (*corner - corners[0]).lerp(middle, 0.25));
        near.map(|point| parts.seen_from(point, normal, spare)).fold(0.0, f64::max)
    }
}
