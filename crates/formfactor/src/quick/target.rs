//! A convex target as dA sees it, and the half-spaces in which something must be to hide any of it.
use super::clip::clip;
use super::cone::{
    Corner, CornerId, ERROR, Edge, Kind, OneCone, Spread, UNDERFLOW, faces, given_faces, rounding, size,
};
use super::corners::{copy, deviation_error};
use super::horizon::Band;
use super::interval::greater;
use crate::exact::deviation;
use crate::numeric::predicates::{over_horizon, place, turn};
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use glam::DVec3;
use std::cmp::Ordering;

/// A convex target, or a convex piece of one, as dA sees it, cut off at the horizon.
#[derive(Debug)]
pub(crate) struct Target<'a> {
    pub(super) from: &'a DifferentialArea,
    pub(super) to: &'a PlanarPolygon,
    /// Whether it is all of `to`.
    pub(super) is_whole: bool,
    pub(super) cone: OneCone<'a>,
    /// The half-spaces in which a part of an occluder must be to hide any of the target,
    sides: &'a [HalfSpace],
    /// and the box around it and dA. Where dA is hardly before the target's plane those half-spaces end almost at that plane: what stands across
    /// the plane beside the target is outside of none of them, however far it is.
    extent: Extent,
    /// A bound on the form factor of what its vertices' deviation leaves open.
    pub(super) error: f64,
}

/// A half-space around dA: normal . p + shift >= 0, known within `error` by the size of p, and `least`.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfSpace {
    normal: DVec3,
    shift: f64,
    error: f64,
    least: f64,
}

impl HalfSpace {
    /// The side of a target's plane that it faces.
    fn before(to: &PlanarPolygon, origin: DVec3) -> Self {
        let (normal, anchor) = (to.plane().rounded(), to.plane().corners[0] - origin);
        let error = ERROR * normal.abs().max_element();
        Self { normal, shift: -normal.dot(anchor), error, least: error * size(anchor) + UNDERFLOW }
    }

    fn above(from: &DifferentialArea) -> Self {
        let normal = from.given_normal();
        Self { normal, shift: 0.0, error: ERROR * normal.abs().max_element(), least: UNDERFLOW }
    }

    fn within(edge: &Edge) -> Self {
        Self { normal: edge.inward, shift: 0.0, error: edge.errors.max_element(), least: UNDERFLOW }
    }

    /// Whether a point is outside for certain, from the product with the normal and its size.
    fn is_out(&self, product: f64, size: f64) -> bool {
        product + self.shift < -self.margin(size)
    }

    /// How far inside a point is.
    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.shift
    }

    /// How far from the plane a point of some size at most must be for its side to be certain.
    fn margin(&self, size: f64) -> f64 {
        self.error * size + self.least
    }
}

/// Adds the edges of what is above the horizon of a piece of a polygon. Where any of its corners has a deviation they are in the first of the
/// buffers. Returns a bound on the form factor of what is left out.
fn add_faces(
    from: &DifferentialArea,
    (to, piece): (&PlanarPolygon, &[DVec3]),
    [corners, spare]: [&mut Vec<Corner>; 2],
    (edges, ids): (&mut Vec<Edge>, &mut Vec<CornerId>),
) -> f64 {
    let (mut is_cut, mut is_above) = (false, false);
    for side in piece.iter().map(|p| place(from.given_normal(), from.position(), *p)) {
        is_cut |= side == Ordering::Less;
        is_above |= side == Ordering::Greater;
    }
    corners.clear();
    if !is_above {
        return 0.0;
    }
    if !is_cut && to.deviation() == 0.0 {
        given_faces(piece.iter().copied(), from.position(), edges, ids);
        return 0.0;
    }
    copy(piece, to.deviation(), from.position(), false, corners);
    let left_out = if is_cut { cut_off(from, to, corners, spare) } else { 0.0 };
    faces(corners, false, edges, ids);
    left_out
}

/// Cuts off what is below the horizon, or hardly above it; returns a bound on the form factor of what is left out.
fn cut_off(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    corners: &mut Vec<Corner>,
    spare: &mut Vec<Corner>,
) -> f64 {
    let (origin, normal) = (from.position(), from.given_normal());
    match Band::above(from, to, corners) {
        Some(band) => {
            let height = |p: DVec3| normal.dot(p - origin) - band.height;
            clip(corners, spare, |p| height(p).total_cmp(&0.0), height);
            band.error
        }
        None => {
            let exact = |p: DVec3| over_horizon(normal, origin, p).value.round();
            clip(corners, spare, |p| place(normal, origin, p), exact);
            0.0
        }
    }
}

/// The sides that come before those of the edges: the target's plane and the horizon.
const BEFORE_EDGES: usize = 2;

/// What keeps a polygon from hiding anything of a target.
#[derive(Debug)]
pub(super) enum Apart<'t> {
    /// It lies outside of a side for certain.
    Outside,
    /// It touches the side of an edge from outside.
    Touching(&'t Edge),
}

/// Turns a distance into an addition to a vector's size that allows for as large an error; the factor 3 is for the sum of three
/// components.
const INVERSE: f64 = 3.0 / ERROR;

impl<'a> Target<'a> {
    /// A convex piece of `to`; `None` where doubles leave open whether it is seen.
    pub(super) fn new(
        from: &'a DifferentialArea,
        (to, piece): (&'a PlanarPolygon, &[DVec3]),
        [corners, spare]: &mut [Vec<Corner>; 2],
        (edges, ids): (&'a mut Vec<Edge>, &'a mut Vec<CornerId>),
        sides: &'a mut Vec<HalfSpace>,
        spread: &'a mut Spread,
    ) -> Option<Self> {
        let origin = from.position();
        if to.plane().quick_side(origin) != Some(Ordering::Greater) {
            return None;
        }
        edges.clear();
        ids.clear();
        let left_out = add_faces(from, (to, piece), [corners, spare], (edges, ids));
        if edges.len() < 3 {
            // Nothing is above the horizon, or so little that its corners coincide: anything would seem to cover it.
            return None;
        }
        let error = deviation_error(corners, edges)? + deviation::of_facing(origin, to) + left_out;
        *spread = Spread::of(edges, 0, rounding(corners), Kind::Target);
        sides.clear();
        sides.extend([HalfSpace::before(to, origin), HalfSpace::above(from)]);
        sides.extend(edges.iter().map(HalfSpace::within));
        let is_whole = to.is_convex() && to.convex_pieces().nth(1).is_none();
        let extent = Extent::around(piece).with(Extent::around(&[origin]));
        Some(Self { from, to, is_whole, cone: OneCone::new(edges, ids, spread), sides, extent, error })
    }

    /// Whether everything in a box is outside of a side, below the horizon, behind the target or beside both, for certain. Polygons
    /// in it may lie off their vertices by `deviation`.
    pub(crate) fn misses_box(&self, extent: &Extent, deviation: f64) -> bool {
        if self.extent.is_beside(extent, deviation + self.to.deviation()) {
            return true;
        }
        let origin = self.from.position();
        let (low, high) = (extent.low - origin, extent.high - origin);
        let size = size(low.abs().max(high.abs())) + deviation * INVERSE;
        self.sides.iter().any(|side| {
            let innermost = (side.normal * low).max(side.normal * high).element_sum();
            side.is_out(innermost, size)
        })
    }

    /// Whether a polygon is outside of a side for certain.
    pub(crate) fn misses(&self, occluder: &PlanarPolygon) -> bool {
        matches!(self.apart(occluder), Some(Apart::Outside))
    }

    /// What keeps a polygon from hiding anything: a side that it is outside of, or an edge that it touches from outside.
    ///
    /// Neighbours of a target in a mesh touch its sides; exact turns decide that they hide nothing.
    pub(super) fn apart(&self, occluder: &PlanarPolygon) -> Option<Apart<'_>> {
        let (origin, points) = (self.from.position(), occluder.points());
        if self.extent.is_beside(&Extent::around(points), occluder.deviation() + self.to.deviation()) {
            return Some(Apart::Outside);
        }
        let reach = points.iter().fold(0.0, |reach, p| greater(reach, size(*p - origin)));
        let reach = reach + occluder.deviation() * INVERSE;
        let mut touched = None;
        for (index, side) in self.sides.iter().enumerate() {
            let (margin, mut highest) = (side.margin(reach), f64::NEG_INFINITY);
            // Stops at the first vertex inside, as this side separates nothing then.
            for point in points {
                highest = greater(highest, side.height(*point - origin));
                if highest > margin {
                    break;
                }
            }
            if highest < -margin {
                return Some(Apart::Outside);
            }
            if highest <= margin {
                let edge = index.checked_sub(BEFORE_EDGES).filter(|index| self.is_touched(*index, occluder));
                touched = touched.or(edge.map(|index| &self.cone.edges[index]));
            }
        }
        touched.map(Apart::Touching)
    }

    /// Whether a polygon is outside of the side through an edge, touching allowed: exactly, where it is near.
    fn is_touched(&self, index: usize, occluder: &PlanarPolygon) -> bool {
        let (edge, line) = (&self.cone.edges[index], self.cone.line(index));
        let (origin, more) = (self.from.position(), occluder.deviation() * INVERSE);
        let is_outside = |point: DVec3| match line {
            Some([a, b]) if more == 0.0 => turn(origin, a, b, point) != Ordering::Less,
            Some(ends) => ends.contains(&point),
            None => false,
        };
        occluder.points().iter().all(|point| {
            let (depth, error) = edge.depth(*point - origin);
            depth < -error - edge.error * more || (depth <= error && is_outside(*point))
        })
    }
}
