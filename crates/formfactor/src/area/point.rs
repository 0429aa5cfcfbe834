//! Form factors from a point in plain doubles: the target's convex pieces less the shadows of convex occluders.
//!
//! From a point an occluder is a cone, the half-spaces inside its silhouette. A target's part in that cone is clipped out of it, and Lambert's sum
//! over it subtracted. Where shadows overlap, each counts less what is in the cones before it. Clipping is continuous: a wrong
//! sign near zero changes areas by roundings only.
use super::clip::{Bound, Clipped, Shears, Soup};
use super::lambert::lambert;
use crate::scene::occluder::{Occluder, Ridge, silhouette};
use glam::DVec3;
use std::{borrow::Cow, ops::Range};

/// An occluder, or a part of one.
pub(super) type Near<'e> = Cow<'e, Occluder>;

/// What is needed to look from points, used again.
#[derive(Debug, Default)]
pub(super) struct Eye {
    facing: Vec<bool>,
    /// The silhouettes of the occluders that hide something, and where those of each end.
    edges: Vec<[DVec3; 2]>,
    edge_ends: Vec<usize>,
    /// Those of which not all points of the cell see the same faces, the edges of which all see the same, and the ridges that are edges
    /// for some.
    turning: Vec<Turning>,
    fixed: Vec<[DVec3; 2]>,
    ridges: Vec<Ridge>,
    sides: Vec<[bool; 2]>,
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
}

/// An occluder of which not all points of a cell see the same faces.
#[derive(Debug)]
struct Turning {
    occluder: usize,
    edges: Range<usize>,
    ridges: Range<usize>,
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
        self.unfocus();
        for (index, occluder) in occluders.iter().enumerate() {
            occluder.facing(from, &mut self.facing);
            let start = self.edges.len();
            silhouette(&occluder.ridges, &self.facing, |edge| self.edges.push(edge));
            if self.edges.len() == start && occluder.is_plate {
                continue;
            }
            match self.met(start, from, pieces) {
                Clipped::All => {
                    self.unfocus();
                    return Focus::Nothing;
                }
                Clipped::Part if occluder.turns_alike(cell) => self.edge_ends.push(self.edges.len()),
                Clipped::Part => {
                    self.edges.truncate(start);
                    self.turn(index, occluder, cell, pieces);
                }
                Clipped::Nothing => self.edges.truncate(start),
            }
        }
        if self.edges.is_empty() && self.turning.is_empty() { Focus::All } else { Focus::Part }
    }

    /// Finds the silhouettes of all occluders as all points of a cell see them, where they see the same: those edges that are seen before
    /// the target from some point.
    pub(super) fn face(&mut self, cell: &[DVec3], pieces: &[Vec<DVec3>], occluders: &[Near]) {
        self.unfocus();
        let from = cell.iter().sum::<DVec3>() / cell.len() as f64;
        for (index, occluder) in occluders.iter().enumerate() {
            if !occluder.turns_alike(cell) {
                self.turn(index, occluder, cell, pieces);
                continue;
            }
            occluder.facing(from, &mut self.facing);
            let (start, mut hides) = (self.edges.len(), false);
            let mut is_beside = false;
            silhouette(&occluder.ridges, &self.facing, |edge| {
                let side = side_of_all(edge, cell, pieces);
                hides = true;
                is_beside |= side == Some(false);
                if side.is_none() {
                    self.edges.push(edge);
                }
            });
            if is_beside || (occluder.is_plate && !hides) {
                self.edges.truncate(start);
            } else {
                self.edge_ends.push(self.edges.len());
            }
        }
    }

    /// Finds the edges of a silhouette that some points of a cell see otherwise than others.
    fn turn(&mut self, index: usize, occluder: &Occluder, cell: &[DVec3], pieces: &[Vec<DVec3>]) {
        let Self { turning, fixed, ridges, sides, .. } = self;
        occluder.sides(cell, sides);
        let of = |side: usize| sides.get(side).copied().unwrap_or([false, true]);
        let (first_edge, first_ridge) = (fixed.len(), ridges.len());
        for ridge in &occluder.ridges {
            let [[left, not_left], [right, not_right]] = ridge.sides.map(of);
            let (ahead, back) = (left && not_right, right && not_left);
            let is_inside = |inner: bool| if inner { !back } else { !ahead };
            if !(ahead || back) || side_of_all(ridge.ends, cell, pieces).is_some_and(is_inside) {
                continue;
            }
            if left != not_left && right != not_right {
                let [a, b] = ridge.ends;
                fixed.push(if ahead { [a, b] } else { [b, a] });
            } else {
                ridges.push(*ridge);
            }
        }
        let (edges, ridges) = (first_edge..fixed.len(), first_ridge..ridges.len());
        turning.push(Turning { occluder: index, edges, ridges });
    }

    /// The half-spaces of the cone of an occluder of which not all points of the cell see the same faces.
    fn turned(&mut self, from: DVec3, at: usize, occluders: &[Near]) {
        let Self { turning, fixed, ridges, facing, walls, ends, .. } = self;
        let Turning { occluder, edges, ridges: some } = &turning[at];
        let occluder = &occluders[*occluder];
        let before = walls.len();
        walls.extend(fixed[edges.clone()].iter().map(|edge| Bound::through(*edge, from)));
        if !some.is_empty() {
            occluder.facing(from, facing);
            silhouette(&ridges[some.clone()], facing, |edge| walls.push(Bound::through(edge, from)));
        }
        if walls.len() == before && occluder.is_plate {
            walls.push(Bound::NOWHERE);
        }
        ends.push(walls.len());
    }

    fn unfocus(&mut self) {
        self.turning.clear();
        self.fixed.clear();
        self.ridges.clear();
        self.edges.clear();
        self.edge_ends.clear();
    }

    /// What of all pieces is in the cone of the silhouette that begins at an edge.
    fn met(&mut self, start: usize, from: DVec3, pieces: &[Vec<DVec3>]) -> Clipped {
        self.walls.clear();
        self.walls.extend(self.edges[start..].iter().map(|edge| Bound::through(*edge, from)));
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

    /// Whether two of the shadows in focus meet anywhere, on the target or beside it, as the middle of a cell sees them.
    ///
    /// Events cut cells where two begin to meet, so that what holds for the middle holds for all.
    pub(super) fn shadows_cross(&self, cell: &[DVec3]) -> bool {
        let from = cell.iter().sum::<DVec3>() / cell.len() as f64;
        let shadow = |i: usize| {
            let start = if i == 0 { 0 } else { self.edge_ends[i - 1] };
            &self.edges[start..self.edge_ends[i]]
        };
        let count = self.edge_ends.len();
        let mut pairs = (0..count).flat_map(|i| (0..i).map(move |j| [shadow(i), shadow(j)]));
        (count + self.turning.len() > 1 && !self.turning.is_empty())
            || pairs.any(|[one, other]| !is_beside(one, other, from) && !is_beside(other, one, from))
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
        self.walls.clear();
        self.walls.extend(self.edges.iter().map(|edge| Bound::through(*edge, from)));
        self.ends.clone_from(&self.edge_ends);
        for at in 0..self.turning.len() {
            self.turned(from, at, occluders);
        }
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

    /// The half-spaces of the parts of the cones that all of some points share, relative to the first.
    fn cones(&mut self, points: &[DVec3], occluders: &[Near]) {
        self.walls.clear();
        self.ends.clear();
        occluders.iter().for_each(|occluder| self.cone(points, occluder));
    }

    /// The half-spaces of one cone more.
    fn cone(&mut self, points: &[DVec3], occluder: &Near) {
        for from in points {
            occluder.facing(*from, &mut self.facing);
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

/// Whether all points of a cell see all of the pieces on one side of an edge, and whether that is the inner one.
///
/// The volume of the tetrahedron of the edge, a point and a corner is linear in both: the cell's corners tell.
fn side_of_all([a, b]: [DVec3; 2], cell: &[DVec3], pieces: &[Vec<DVec3>]) -> Option<bool> {
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    for from in cell {
        let wall = Bound::through([a, b], *from);
        for corner in pieces.iter().flatten() {
            let depth = wall.depth(*corner - *from);
            low = if depth < low { depth } else { low };
            high = if depth > high { depth } else { high };
        }
        if low < 0.0 && high > 0.0 {
            return None;
        }
    }
    Some(low >= 0.0)
}

/// Whether all of a silhouette is seen outside of one edge of another one.
fn is_beside(one: &[[DVec3; 2]], other: &[[DVec3; 2]], from: DVec3) -> bool {
    let leaves_out = |wall: Bound| other.iter().all(|[a, _]| wall.depth(*a - from) <= 0.0);
    one.iter().any(|edge| leaves_out(Bound::through(*edge, from)))
}
