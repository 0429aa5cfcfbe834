//! Which occluders can matter, as far as doubles decide it.
use super::clip::clip;
use super::cone::{Cones, Corner, ERROR, Edge, Place, UNDERFLOW, faces, size};
use crate::lambert::{Sight, swept};
use crate::polygon::ROUNDING;
use crate::predicates::{over_horizon, place, turn};
use crate::tree::Extent as Box3;
use crate::{DifferentialArea, PlanarPolygon, doubt};
use glam::DVec3;
use std::cmp::Ordering;

/// A convex target as dA sees it, cut off at the horizon.
#[derive(Debug)]
pub(crate) struct Target<'a> {
    pub(super) from: &'a DifferentialArea,
    pub(super) to: &'a PlanarPolygon,
    pub(super) edges: &'a [Edge],
    /// The half-spaces in which what hides must be.
    sides: &'a [Side],
    /// What its vertices' roundings leave open.
    pub(super) error: f64,
}

/// A half-space around dA: normal . p + shift >= 0, known within `doubt` by the size of p, and `least`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    normal: DVec3,
    shift: f64,
    doubt: f64,
    least: f64,
}

impl Side {
    /// The side of a target's plane that it faces.
    fn before(to: &PlanarPolygon, origin: DVec3) -> Self {
        let (normal, anchor) = (to.plane().rounded(), to.plane().corners[0] - origin);
        let doubt = ERROR * normal.abs().max_element();
        Self { normal, shift: -normal.dot(anchor), doubt, least: doubt * size(anchor) + UNDERFLOW }
    }

    fn above(from: &DifferentialArea) -> Self {
        let normal = from.given_normal();
        Self { normal, shift: 0.0, doubt: ERROR * normal.abs().max_element(), least: UNDERFLOW }
    }

    fn within(edge: &Edge) -> Self {
        Self { normal: edge.inward, shift: 0.0, doubt: edge.doubt.max_element(), least: UNDERFLOW }
    }

    /// Whether a point is outside for certain, from the product with the normal and its size.
    fn is_out(&self, product: f64, size: f64) -> bool {
        product + self.shift < -self.doubt * size - self.least
    }

    /// Where a point lies that may be off by a distance whose vector's error is that of a vector `slack` longer.
    fn place(&self, point: DVec3, slack: f64) -> Place {
        let (product, size) = (self.normal.dot(point), size(point) + slack);
        let (height, margin) = (product + self.shift, self.doubt * size + self.least);
        if height > margin {
            Place::Inside
        } else if height < -margin {
            Place::Outside
        } else {
            Place::Open
        }
    }
}

/// The sides that come before those of the edges: the target's plane and the horizon.
const BEFORE_EDGES: usize = 2;

/// What keeps a polygon from hiding anything of a target.
#[derive(Debug)]
enum Apart<'t> {
    /// It lies outside of a side for certain.
    Outside,
    /// It touches the side of an edge from outside.
    Touching(&'t Edge),
}

/// What an occluder is found to be.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sieved {
    /// It hides nothing; rounding leaves at most this form factor open.
    Misses(f64),
    /// Its cone is the last; rounding of its vertices leaves this form factor open.
    Blocks { doubt: f64, is_clipped: bool },
    /// It hides all of the target.
    Covers,
}

impl<'a> Target<'a> {
    /// `None` when it is not convex, or where doubles leave open whether it is seen.
    pub(super) fn new(
        from: &'a DifferentialArea,
        to: &'a PlanarPolygon,
        [corners, spare]: &mut [Vec<Corner>; 2],
        edges: &'a mut Vec<Edge>,
        sides: &'a mut Vec<Side>,
    ) -> Option<Self> {
        let (origin, normal) = (from.position(), from.given_normal());
        if !to.is_convex() || to.plane().quick_side(origin) != Some(Ordering::Greater) {
            return None;
        }
        copy(to, false, corners);
        let height = |c: &Corner| place(normal, origin, c.at);
        if corners.iter().any(|c| height(c) == Ordering::Less) {
            let exact = |p: DVec3| over_horizon(normal, origin, p).value.round();
            clip(corners, spare, |p| place(normal, origin, p), exact);
        }
        if corners.iter().all(|c| height(c) != Ordering::Greater) {
            return None;
        }
        edges.clear();
        faces(origin, corners, edges);
        if edges.len() < 3 {
            // So little is above the horizon that its corners fall together: anything would seem to cover it.
            return None;
        }
        let error = blurred(origin, corners, edges)? + doubt::of_facing(origin, to);
        sides.clear();
        sides.extend([Side::before(to, origin), Side::above(from)]);
        sides.extend(edges.iter().map(Side::within));
        Some(Self { from, to, edges, sides, error })
    }

    /// Whether everything in a box is outside of a side, below the horizon or behind the target, for certain. Polygons
    /// in it may lie off their vertices by `slack`.
    pub(crate) fn misses_box(&self, extent: &Box3, slack: f64) -> bool {
        let origin = self.from.position();
        let (low, high) = (extent.low - origin, extent.high - origin);
        let size = size(low.abs().max(high.abs())) + slack * INVERSE;
        self.sides.iter().any(|side| {
            let innermost = (side.normal * low).max(side.normal * high).element_sum();
            side.is_out(innermost, size)
        })
    }

    /// What keeps a polygon from hiding anything.
    fn apart(&self, occluder: &PlanarPolygon) -> Option<Apart<'_>> {
        let (origin, slack) = (self.from.position(), occluder.deviation() * INVERSE);
        let mut touched = None;
        for (index, side) in self.sides.iter().enumerate() {
            let mut is_outside = true;
            let is_inside = occluder.points().iter().any(|p| {
                let place = side.place(*p - origin, slack);
                is_outside &= place == Place::Outside;
                place == Place::Inside
            });
            if is_inside {
                continue;
            }
            if is_outside {
                return Some(Apart::Outside);
            }
            let edge = index.checked_sub(BEFORE_EDGES).map(|index| &self.edges[index]);
            touched = touched.or(edge.filter(|edge| self.is_touched(edge, occluder)));
        }
        touched.map(Apart::Touching)
    }

    /// Whether a polygon touches the side through an edge from outside, at most.
    fn is_touched(&self, edge: &Edge, occluder: &PlanarPolygon) -> bool {
        let (origin, slack) = (self.from.position(), occluder.deviation() * INVERSE);
        occluder.points().iter().all(|point| {
            let p = *point - origin;
            let (depth, doubt) = edge.depth(p);
            depth < -doubt - edge.doubt.element_sum() * slack
                || p == edge.start
                || p == edge.end
                || (depth <= doubt && slack == 0.0 && self.is_outside(edge, *point))
        })
    }

    /// Whether a point is outside of the side through an edge between two given vertices, or on it: exactly.
    fn is_outside(&self, edge: &Edge, point: DVec3) -> bool {
        let given = |p: DVec3| self.to.points().iter().find(|q| **q - self.from.position() == p);
        match (given(edge.start), given(edge.end)) {
            (Some(a), Some(b)) => turn(self.from.position(), *a, *b, point) != Ordering::Less,
            _ => false,
        }
    }
}

/// What turns a distance to the size of a vector that errs as much, and more than the sum of a vector's components is
/// longer than their largest.
const INVERSE: f64 = 3.0 / ERROR;

/// Sorts out an occluder; `None` where doubles leave open what it is.
pub(super) fn sieve(
    target: &Target,
    occluder: &PlanarPolygon,
    [corners, spare]: &mut [Vec<Corner>; 2],
    cones: &mut Cones,
) -> Option<Sieved> {
    let slack = occluder.deviation() + target.to.deviation();
    match target.apart(occluder) {
        Some(Apart::Outside) => return Some(Sieved::Misses(0.0)),
        Some(Apart::Touching(edge)) => return Some(Sieved::Misses(of_touch(edge, target, occluder, slack))),
        None => (),
    }
    if !occluder.is_convex() {
        return None;
    }
    let (origin, plane) = (target.from.position(), target.to.plane());
    let facing = occluder.plane().side_of(origin);
    let sides = || occluder.points().iter().map(|p| plane.side_of(*p));
    let is_clipped = sides().any(|side| side == Ordering::Less);
    if slack > 0.0 {
        let is_clear = |p: &DVec3| {
            plane.quick_side(*p) == Some(Ordering::Greater)
                && plane.rounded().dot(*p - plane.corners[0]) > 4.0 * slack * size(plane.rounded())
        };
        if doubt::of_facing(origin, occluder) > 0.0 || !occluder.points().iter().all(is_clear) {
            return None;
        }
    }
    if facing == Ordering::Equal || !sides().any(|side| side == Ordering::Greater) {
        return Some(Sieved::Misses(0.0));
    }
    copy(occluder, facing == Ordering::Less, corners);
    if is_clipped {
        clip(corners, spare, |p| plane.side_of(p), |p| plane.side(p).value.round());
    }
    let edges = cones.push(origin, corners);
    if edges.len() < 3 {
        // So little is before the target that its corners fall together.
        return None;
    }
    let doubt = blurred(origin, corners, edges)?;
    if doubt == 0.0
        && edges.iter().all(|edge| target.edges.iter().all(|t| edge.place(t.start) == Place::Inside))
    {
        return Some(Sieved::Covers);
    }
    Some(Sieved::Blocks { doubt, is_clipped })
}

/// The vertices of a convex polygon, in reverse when it turns its back.
fn copy(polygon: &PlanarPolygon, is_reversed: bool, corners: &mut Vec<Corner>) {
    let corner = |at: &DVec3| Corner { at: *at, slack: polygon.deviation() };
    corners.clear();
    if is_reversed {
        corners.extend(polygon.points().iter().rev().map(corner));
    } else {
        corners.extend(polygon.points().iter().map(corner));
    }
}

/// What the slack of the corners leaves open; `None` when the polygon as it stands may not be convex.
fn blurred(origin: DVec3, corners: &[Corner], edges: &[Edge]) -> Option<f64> {
    if corners.iter().all(|corner| corner.slack == 0.0) {
        return Some(0.0);
    }
    let is_apart = |edge: &Edge, p: DVec3| p == edge.start || p == edge.end || edge.place(p) == Place::Inside;
    if !edges.iter().all(|edge| corners.iter().all(|c| is_apart(edge, c.at - origin))) {
        return None;
    }
    let sight = |c: &Corner| {
        let toward = c.at - origin;
        Sight { toward, blur: c.slack / toward.length() * (1.0 + 16.0 * ROUNDING) }
    };
    let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
    Some(pairs.map(|(a, b)| swept(sight(a), sight(b))).sum())
}

/// What a polygon may hide that touches a side of the target from outside: a band along the side.
fn of_touch(edge: &Edge, target: &Target, occluder: &PlanarPolygon, slack: f64) -> f64 {
    if slack == 0.0 {
        return 0.0;
    }
    let origin = target.from.position();
    let reached = occluder.points().iter().map(|p| p.distance(origin));
    let nearest = reached.fold(edge.start.length().min(edge.end.length()), f64::min);
    let sight = |toward: DVec3| Sight { toward, blur: 2.0 * slack / nearest };
    swept(sight(edge.start), sight(edge.end))
}
