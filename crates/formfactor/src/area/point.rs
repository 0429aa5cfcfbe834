//! Form factors from a point in plain doubles: the target's convex pieces less the shadows of convex occluders.
//!
//! From a point an occluder is a cone, the half-spaces inside its silhouette. A target's part in that cone is clipped out of it, and Lambert's sum
//! over it subtracted. Where shadows overlap, each counts less what is in the cones before it. Clipping is continuous: a wrong
//! sign near zero changes areas by roundings only.
use crate::scene::occluder::Occluder;
use glam::DVec3;
use std::{borrow::Cow, f64::consts::TAU};

/// An occluder, or a part of one.
pub(super) type Near<'e> = Cow<'e, Occluder>;

/// A half-space: normal . p + shift >= 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    normal: DVec3,
    shift: f64,
}

impl Bound {
    /// The inner side of a silhouette's edge, relative to who sees it.
    fn through([a, b]: [DVec3; 2], from: DVec3) -> Self {
        Self { normal: (b - a).cross(a - from), shift: 0.0 }
    }

    fn depth(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.shift
    }

    fn turned(self) -> Self {
        Self { normal: -self.normal, shift: -self.shift }
    }
}

/// Convex polygons, one after the other.
#[derive(Debug, Default)]
pub(super) struct Soup {
    points: Vec<DVec3>,
    ends: Vec<usize>,
}

impl Soup {
    fn clear(&mut self) {
        self.points.clear();
        self.ends.clear();
    }

    fn push(&mut self, polygon: &[DVec3]) {
        self.points.extend_from_slice(polygon);
        self.ends.push(self.points.len());
    }

    pub(super) fn polygons(&self) -> impl Iterator<Item = &[DVec3]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.points[start..*end])
    }

    fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }
}

/// What is needed to look from points, used again.
#[derive(Debug, Default)]
pub(super) struct Eye {
    facing: Vec<bool>,
    /// The silhouettes of the occluders that hide something, and where those of each end.
    edges: Vec<[DVec3; 2]>,
    edge_ends: Vec<usize>,
    /// Those of which not all points of the cell see the same faces.
    turning: Vec<usize>,
    /// The half-spaces of all cones, and where those of each end.
    walls: Vec<Bound>,
    ends: Vec<usize>,
    target: Vec<DVec3>,
    shadow: Vec<DVec3>,
    spare: Vec<DVec3>,
    /// Shadows that are not empty.
    casting: Vec<usize>,
    parts: Soup,
    next: Soup,
    rest: Rest,
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
        self.sum(from, normal, pieces)
    }

    /// Finds which of the occluders the middle of a cell sees before the pieces, and their silhouettes; whether one hides all.
    pub(super) fn focus(&mut self, cell: &[DVec3], pieces: &[Vec<DVec3>], occluders: &[Near]) -> Focus {
        let from = cell.iter().sum::<DVec3>() / cell.len() as f64;
        self.turning.clear();
        self.edges.clear();
        self.edge_ends.clear();
        for (index, occluder) in occluders.iter().enumerate() {
            occluder.facing(from, &mut self.facing);
            let start = self.edges.len();
            self.edges.extend(occluder.silhouette(&self.facing));
            if self.edges.len() == start && occluder.is_plate {
                continue;
            }
            self.walls.clear();
            self.walls.extend(self.edges[start..].iter().map(|edge| Bound::through(*edge, from)));
            let (mut is_covered, mut is_met) = (true, false);
            for piece in pieces {
                self.target.clear();
                self.target.extend(piece.iter().map(|p| *p - from));
                match inside(&mut self.target, &self.walls, &mut self.spare) {
                    Clipped::Nothing => is_covered = false,
                    Clipped::Part => (is_covered, is_met) = (false, true),
                    Clipped::All => is_met = true,
                }
            }
            if is_covered {
                self.edges.clear();
                self.edge_ends.clear();
                self.turning.clear();
                return Focus::Nothing;
            }
            if is_met && occluder.turns_alike(cell) {
                self.edge_ends.push(self.edges.len());
            } else {
                self.edges.truncate(start);
            }
            if is_met && self.edges.len() == start {
                self.turning.push(index);
            }
        }
        if self.edges.is_empty() && self.turning.is_empty() { Focus::All } else { Focus::Part }
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

    /// [`Self::look`] past the silhouettes in focus.
    pub(super) fn look_past(
        &mut self,
        from: DVec3,
        normal: DVec3,
        pieces: &[Vec<DVec3>],
        occluders: &[Near],
    ) -> Seen {
        self.walls.clear();
        self.walls.extend(self.edges.iter().map(|edge| Bound::through(*edge, from)));
        self.ends.clone_from(&self.edge_ends);
        for index in 0..self.turning.len() {
            self.cone(&[from], &occluders[self.turning[index]]);
        }
        self.sum(from, normal, pieces)
    }

    fn sum(&mut self, from: DVec3, normal: DVec3, pieces: &[Vec<DVec3>]) -> Seen {
        let mut seen = Seen::default();
        for piece in pieces {
            self.target.clear();
            self.target.extend(piece.iter().map(|p| *p - from));
            let whole = lambert(normal, &self.target);
            seen.whole += whole;
            match self.hidden(normal) {
                Some((hidden, is_joint)) => {
                    seen.hidden += hidden.min(whole);
                    seen.is_joint |= is_joint;
                }
                None => seen.hidden += whole,
            }
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
            self.walls.extend(occluder.silhouette(&self.facing).map(|edge| {
                let wall = Bound::through(edge, *from);
                Bound { shift: -wall.normal.dot(shift), ..wall }
            }));
            if self.walls.len() == before && occluder.is_plate {
                // Seen edge-on: its cone is empty.
                self.walls.push(Bound { normal: DVec3::ZERO, shift: -1.0 });
            }
        }
        self.ends.push(self.walls.len());
    }

    /// The form factor of what the cones hide of the target, and whether shadows overlap; `None` where one hides all of it.
    fn hidden(&mut self, normal: DVec3) -> Option<(f64, bool)> {
        let Self { walls, ends, target, shadow, spare, casting, parts, next, rest, .. } = self;
        casting.clear();
        let (mut hidden, mut is_joint) = (0.0, false);
        let mut start = 0;
        for end in &*ends {
            let cone = &walls[start..*end];
            start = *end;
            shadow.clone_from(target);
            match inside(shadow, cone, spare) {
                Clipped::Nothing => continue,
                Clipped::All => return None,
                Clipped::Part => (),
            }
            parts.clear();
            parts.push(shadow);
            for earlier in &*casting {
                let from = if *earlier == 0 { 0 } else { ends[*earlier - 1] };
                next.clear();
                let mut met = false;
                parts
                    .polygons()
                    .for_each(|part| met |= subtract(part, &walls[from..ends[*earlier]], next, rest));
                is_joint |= met;
                std::mem::swap(parts, next);
            }
            hidden += parts.polygons().map(|part| lambert(normal, part)).sum::<f64>();
            casting.push(ends.iter().position(|e| e == end).unwrap_or(0));
        }
        Some((hidden, is_joint))
    }

    /// What of the pieces is not hidden from all corners of a cell by one of the occluders each: what some point of the
    /// cell may see. Relative to the first corner.
    pub(super) fn not_in_umbrae(&mut self, corners: &[DVec3], pieces: &[Vec<DVec3>], occluders: &[Near]) {
        self.cones(corners, occluders);
        let Self { walls, ends, target, parts, next, rest, .. } = self;
        parts.clear();
        for piece in pieces {
            target.clear();
            target.extend(piece.iter().map(|p| *p - corners[0]));
            parts.push(target);
        }
        let mut start = 0;
        for end in &*ends {
            next.clear();
            parts.polygons().for_each(|part| {
                subtract(part, &walls[start..*end], next, rest);
            });
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

/// Whether all of a silhouette is seen outside of one edge of another one.
fn is_beside(one: &[[DVec3; 2]], other: &[[DVec3; 2]], from: DVec3) -> bool {
    let leaves_out = |wall: Bound| other.iter().all(|[a, _]| wall.depth(*a - from) <= 0.0);
    one.iter().any(|edge| leaves_out(Bound::through(*edge, from)))
}

/// What of a polygon is in a cone.
enum Clipped {
    Nothing,
    Part,
    All,
}

/// Clips a convex polygon to a cone.
fn inside(polygon: &mut Vec<DVec3>, cone: &[Bound], spare: &mut Vec<DVec3>) -> Clipped {
    let mut is_cut = false;
    for wall in cone {
        let (low, high) = reach(polygon, wall);
        if high <= 0.0 {
            return Clipped::Nothing;
        }
        if low < 0.0 {
            clip(polygon, wall, spare);
            std::mem::swap(polygon, spare);
            is_cut = true;
        }
    }
    if is_cut { Clipped::Part } else { Clipped::All }
}

/// The least and the greatest depth of a polygon's corners.
fn reach(polygon: &[DVec3], wall: &Bound) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for point in polygon {
        let depth = wall.depth(*point);
        low = if depth < low { depth } else { low };
        high = if depth > high { depth } else { high };
    }
    (low, high)
}

/// The part of a convex polygon in a half-space.
fn clip(polygon: &[DVec3], wall: &Bound, out: &mut Vec<DVec3>) {
    out.clear();
    let Some(mut before) = polygon.last().copied() else { return };
    let mut there = wall.depth(before);
    for &point in polygon {
        let here = wall.depth(point);
        if (there < 0.0 && here > 0.0) || (there > 0.0 && here < 0.0) {
            out.push(before + (point - before) * (there / (there - here)));
        }
        if here >= 0.0 {
            out.push(point);
        }
        (before, there) = (point, here);
    }
}

/// What is left of a polygon while cones are cut out of it.
#[derive(Debug, Default)]
struct Rest {
    left: Vec<DVec3>,
    spare: Vec<DVec3>,
}

/// Adds the parts of a convex polygon outside of a cone; whether any of it was inside.
fn subtract(polygon: &[DVec3], cone: &[Bound], out: &mut Soup, Rest { left, spare }: &mut Rest) -> bool {
    if cone.iter().any(|wall| reach(polygon, wall).1 <= 0.0) {
        out.push(polygon);
        return false;
    }
    left.clear();
    left.extend_from_slice(polygon);
    for wall in cone {
        let (low, high) = reach(left, wall);
        if high <= 0.0 {
            out.push(left);
            return false;
        }
        if low < 0.0 {
            clip(left, &wall.turned(), spare);
            out.push(spare);
            clip(left, wall, spare);
            std::mem::swap(left, spare);
        }
    }
    true
}

/// Below this squared tangent of an angle its series converges: see [`arc`].
const SMALL: f64 = 1.0 / 16.0;

/// atan(t) / t by its Taylor series in t^2 <= 1/16: eleven terms leave less than 16^-11 / 23 < 3e-15.
fn arc(square: f64) -> f64 {
    // Written out: loops over the terms took three times as long.
    let (s, q) = (square, square * square);
    let low = (1.0 - s * (1.0 / 3.0)) + q * (1.0 / 5.0 - s * (1.0 / 7.0));
    let middle = (1.0 / 9.0 - s * (1.0 / 11.0)) + q * (1.0 / 13.0 - s * (1.0 / 15.0));
    let high = (1.0 / 17.0 - s * (1.0 / 19.0)) + q * (1.0 / 21.0);
    let quartic = q * q;
    low + quartic * (middle + quartic * high)
}

/// Lambert's sum over a convex polygon given relative to the point, counter-clockwise as the point sees it.
pub(super) fn lambert(normal: DVec3, corners: &[DVec3]) -> f64 {
    let Some(mut a) = corners.last().copied() else { return 0.0 };
    let mut sum = 0.0;
    for &b in corners {
        let (cross, cosine) = (b.cross(a), a.dot(b));
        let square = cross.length_squared();
        let rise = normal.dot(cross);
        if cosine > 0.0 && square < SMALL * cosine * cosine {
            sum += rise * arc(square / (cosine * cosine)) / cosine;
        } else if square > 0.0 {
            let sine = square.sqrt();
            sum += rise * sine.atan2(cosine) / sine;
        }
        a = b;
    }
    (sum / TAU).max(0.0)
}

impl Soup {
    /// The form factor of all polygons from a point given relative to what they are relative to.
    pub(super) fn seen_from(&self, point: DVec3, normal: DVec3, spare: &mut Vec<DVec3>) -> f64 {
        let each = self.polygons().map(|polygon| {
            spare.clear();
            spare.extend(polygon.iter().map(|p| *p - point));
            lambert(normal, spare)
        });
        if self.is_empty() { 0.0 } else { each.sum() }
    }
}
