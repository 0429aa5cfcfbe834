//! Convex polygons clipped to half-spaces and to cones.
//!
//! Clipping is continuous: a wrong sign near zero changes areas by roundings only.
use super::lambert::lambert;
use crate::scene::occluder::Face;
use glam::DVec3;

/// A half-space: normal . p + shift >= 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    normal: DVec3,
    shift: f64,
}

impl Bound {
    /// Nothing is inside.
    pub(super) const NOWHERE: Self = Self { normal: DVec3::ZERO, shift: -1.0 };

    /// The inner side of a silhouette's edge, relative to who sees it.
    pub(super) fn through([a, b]: [DVec3; 2], from: DVec3) -> Self {
        Self { normal: (b - a).cross(a - from), shift: 0.0 }
    }

    /// Moved by a way.
    pub(super) fn moved(self, way: DVec3) -> Self {
        Self { shift: self.shift - self.normal.dot(way), ..self }
    }

    pub(super) fn depth(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.shift
    }
}

/// Convex polygons, one after the other.
#[derive(Debug, Default)]
pub(super) struct Soup {
    points: Vec<DVec3>,
    ends: Vec<usize>,
}

impl Soup {
    pub(super) fn clear(&mut self) {
        self.points.clear();
        self.ends.clear();
    }

    pub(super) fn push(&mut self, polygon: &[DVec3]) {
        self.points.extend_from_slice(polygon);
        self.ends.push(self.points.len());
    }

    pub(super) fn polygons(&self) -> impl Iterator<Item = &[DVec3]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.points[start..*end])
    }

    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

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

/// What of a polygon is in a cone.
pub(super) enum Clipped {
    Nothing,
    Part,
    All,
}

/// What clipping needs, used again.
#[derive(Debug, Default)]
pub(super) struct Shears {
    left: Vec<DVec3>,
    spare: Vec<DVec3>,
    /// How deep each corner is in the half-space that clips.
    depths: Vec<f64>,
}

impl Shears {
    /// Clips a convex polygon to a cone.
    pub(super) fn inside(&mut self, polygon: &mut Vec<DVec3>, cone: &[Bound]) -> Clipped {
        let mut is_cut = false;
        for wall in cone {
            let [low, high] = self.measure(polygon, wall);
            if high <= 0.0 {
                return Clipped::Nothing;
            }
            if low < 0.0 {
                clip(polygon, &self.depths, 1.0, &mut self.spare);
                std::mem::swap(polygon, &mut self.spare);
                is_cut = true;
            }
        }
        if is_cut { Clipped::Part } else { Clipped::All }
    }

    /// Adds the parts of a convex polygon outside of a cone; whether any of it was inside.
    pub(super) fn subtract(&mut self, polygon: &[DVec3], cone: &[Bound], out: &mut Soup) -> bool {
        if cone.iter().any(|wall| polygon.iter().all(|p| wall.depth(*p) <= 0.0)) {
            out.push(polygon);
            return false;
        }
        let mut left = std::mem::take(&mut self.left);
        left.clear();
        left.extend_from_slice(polygon);
        let mut is_met = true;
        for wall in cone {
            let [low, high] = self.measure(&left, wall);
            if high <= 0.0 {
                out.push(&left);
                is_met = false;
                break;
            }
            if low < 0.0 {
                clip(&left, &self.depths, -1.0, &mut self.spare);
                out.push(&self.spare);
                clip(&left, &self.depths, 1.0, &mut self.spare);
                std::mem::swap(&mut left, &mut self.spare);
            }
        }
        self.left = left;
        is_met
    }

    /// The least and the greatest depth of a polygon's corners.
    fn measure(&mut self, polygon: &[DVec3], wall: &Bound) -> [f64; 2] {
        self.depths.resize(polygon.len(), 0.0);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (depth, point) in self.depths.iter_mut().zip(polygon) {
            let here = wall.depth(*point);
            *depth = here;
            low = if here < low { here } else { low };
            high = if here > high { here } else { high };
        }
        [low, high]
    }
}

/// The part of a convex polygon where its depths have a sign.
fn clip(polygon: &[DVec3], depths: &[f64], sign: f64, out: &mut Vec<DVec3>) {
    out.clear();
    let (Some(mut before), Some(mut there)) = (polygon.last(), depths.last()) else { return };
    for (point, here) in polygon.iter().zip(depths) {
        if (*there < 0.0 && *here > 0.0) || (*there > 0.0 && *here < 0.0) {
            out.push(*before + (*point - *before) * (there / (there - here)));
        }
        if sign * here >= 0.0 {
            out.push(*point);
        }
        (before, there) = (point, here);
    }
}

/// The parts of convex polygons before a plane.
pub(super) fn before(pieces: &[Vec<DVec3>], [on, normal]: Face) -> Vec<Vec<DVec3>> {
    let height = |p: &DVec3| normal.dot(*p - on);
    let part = |piece: &Vec<DVec3>| {
        let mut kept = Vec::with_capacity(piece.len() + 1);
        for (a, b) in piece.iter().zip(piece.iter().cycle().skip(1)) {
            let (here, there) = (height(a), height(b));
            if here >= 0.0 {
                kept.push(*a);
            }
            if (here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0) {
                kept.push(*a + (*b - *a) * (here / (here - there)));
            }
        }
        kept
    };
    pieces.iter().map(part).filter(|kept| kept.len() > 2).collect()
}
