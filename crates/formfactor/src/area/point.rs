//! Form factors from a point in plain doubles: the target's convex pieces less the shadows of convex occluders.
//!
//! From a point an occluder is a cone, the half-spaces inside its silhouette. A target's part in that cone is clipped out of it, and Lambert's sum
//! over it subtracted. Where shadows overlap, each counts less what is in the cones before it. Clipping is continuous: a wrong
//! sign near zero changes areas by roundings only.
use crate::scene::occluder::Occluder;
use glam::DVec3;
use std::f64::consts::TAU;

/// A half-space: normal . p + shift >= 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wall {
    normal: DVec3,
    shift: f64,
}

impl Wall {
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
    /// The half-spaces of all cones, and where those of each end.
    walls: Vec<Wall>,
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
    pub(super) fn look(&mut self, from: DVec3, normal: DVec3, pieces: &[Vec<DVec3>], occluders: &[Occluder]) -> Seen {
        self.cones(&[from], occluders);
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
    fn cones(&mut self, points: &[DVec3], occluders: &[Occluder]) {
        self.walls.clear();
        self.ends.clear();
        for occluder in occluders {
            for from in points {
                occluder.facing(*from, &mut self.facing);
                let before = self.walls.len();
                let shift = *from - points[0];
                self.walls.extend(occluder.silhouette(&self.facing).map(|[a, b]| {
                    let normal = (b - a).cross(a - *from);
                    Wall { normal, shift: -normal.dot(shift) }
                }));
                if self.walls.len() == before && occluder.is_plate {
                    // Seen edge-on: its cone is empty.
                    self.walls.push(Wall { normal: DVec3::ZERO, shift: -1.0 });
                }
            }
            self.ends.push(self.walls.len());
        }
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
                Inside::Nothing => continue,
                Inside::All => return None,
                Inside::Part => (),
            }
            parts.clear();
            parts.push(shadow);
            for earlier in &*casting {
                let from = if *earlier == 0 { 0 } else { ends[*earlier - 1] };
                next.clear();
                let mut met = false;
                parts.polygons().for_each(|part| met |= subtract(part, &walls[from..ends[*earlier]], next, rest));
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
    pub(super) fn not_in_umbrae(&mut self, corners: &[DVec3], pieces: &[Vec<DVec3>], occluders: &[Occluder]) {
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
    pub(super) fn is_covered(&mut self, source: &[Vec<DVec3>], target: &[Vec<DVec3>], occluder: &Occluder) -> bool {
        source.iter().flatten().all(|from| {
            self.cones(&[*from], std::slice::from_ref(occluder));
            target.iter().flatten().all(|p| self.walls.iter().all(|wall| wall.depth(*p - *from) >= 0.0))
        })
    }

    /// The largest form factor, from nodes of a cell, of what some of it may see as far as its umbrae say.
    pub(super) fn left_open(&mut self, corners: &[DVec3], normal: DVec3, target: &[Vec<DVec3>], occluders: &[Occluder]) -> f64 {
        self.not_in_umbrae(corners, target, occluders);
        let Self { parts, spare, .. } = self;
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64 - corners[0];
        let near = corners.iter().map(|corner| (*corner - corners[0]).lerp(middle, 0.25));
        near.map(|point| parts.seen_from(point, normal, spare)).fold(0.0, f64::max)
    }
}

/// What of a polygon is in a cone.
enum Inside {
    Nothing,
    Part,
    All,
}

/// Clips a convex polygon to a cone.
fn inside(polygon: &mut Vec<DVec3>, cone: &[Wall], spare: &mut Vec<DVec3>) -> Inside {
    let mut is_cut = false;
    for wall in cone {
        let (low, high) = reach(polygon, wall);
        if high <= 0.0 {
            return Inside::Nothing;
        }
        if low < 0.0 {
            clip(polygon, wall, spare);
            std::mem::swap(polygon, spare);
            is_cut = true;
        }
    }
    if is_cut { Inside::Part } else { Inside::All }
}

/// The least and the greatest depth of a polygon's corners.
fn reach(polygon: &[DVec3], wall: &Wall) -> (f64, f64) {
    polygon.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
        let depth = wall.depth(*p);
        (low.min(depth), high.max(depth))
    })
}

/// The part of a convex polygon in a half-space.
fn clip(polygon: &[DVec3], wall: &Wall, out: &mut Vec<DVec3>) {
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
fn subtract(polygon: &[DVec3], cone: &[Wall], out: &mut Soup, Rest { left, spare }: &mut Rest) -> bool {
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
    const TERMS: [f64; 11] = [
        1.0,
        -1.0 / 3.0,
        1.0 / 5.0,
        -1.0 / 7.0,
        1.0 / 9.0,
        -1.0 / 11.0,
        1.0 / 13.0,
        -1.0 / 15.0,
        1.0 / 17.0,
        -1.0 / 19.0,
        1.0 / 21.0,
    ];
    TERMS.iter().rev().fold(0.0, |sum, term| sum * square + term)
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
