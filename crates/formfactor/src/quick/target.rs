//! A convex target as dA sees it, and the half-spaces in which something must be to hide any of it.
use super::clip::clip;
use super::cone::{Corner, CornerId, ERROR, Edge, OneCone, Spread, UNDERFLOW, faces, rounding, size};
use super::corners::{copy, deviation_error};
use super::interval::greater;
use crate::exact::deviation;
use crate::numeric::predicates::{over_horizon, place, turn};
use crate::numeric::rounding::ROUNDING;
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
    /// The half-spaces in which a part of an occluder must be to hide any of the target.
    sides: &'a [HalfSpace],
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

/// How far above the horizon a target is cut off, as a share of its distance: far more than roundings.
const LIFT: f64 = 9.094_947_017_729_282e-13;
/// What is left out is far less than what roundings leave open.
const LEFT_OUT: f64 = 1e-18;

/// How high a target that passes the horizon is cut off, along the given normal, and a bound on the form factor of what is left out. None where
/// that would be too much.
///
/// Edges that lie in the horizon, as those of neighbours in a wall do, are clear of the cut then. What rises above the horizon by a sine of s at
/// most has a form factor of at most s^2.
fn band_above(from: &DifferentialArea, to: &PlanarPolygon, corners: &[Corner]) -> Option<(f64, f64)> {
    let reach = corners.iter().fold(0.0, |reach, corner| greater(reach, size(corner.at)));
    let nearest = to.normal().dot(corners[0].at).abs() - 16.0 * ROUNDING * reach - to.deviation();
    let sine = 2.0 * LIFT * reach / nearest;
    let error = sine * sine;
    (nearest > 0.0 && error <= LEFT_OUT).then_some((LIFT * reach * from.given_normal().length(), error))
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
        let (origin, normal) = (from.position(), from.given_normal());
        if to.plane().quick_side(origin) != Some(Ordering::Greater) {
            return None;
        }
        copy(piece, to.deviation(), origin, false, corners);
        let mut band = None;
        let height = |c: &Corner| c.id.given().map_or(Ordering::Equal, |p| place(normal, origin, p));
        if corners.iter().any(|c| height(c) == Ordering::Less) {
            band = band_above(from, to, corners);
            match band {
                Some((height, _)) => {
                    let height = |p: DVec3| normal.dot(p - origin) - height;
                    clip(corners, spare, |p| height(p).total_cmp(&0.0), height);
                }
                None => {
                    let exact = |p: DVec3| over_horizon(normal, origin, p).value.round();
                    clip(corners, spare, |p| place(normal, origin, p), exact);
                }
            }
        }
        if corners.iter().all(|c| height(c) != Ordering::Greater) {
            return None;
        }
        edges.clear();
        ids.clear();
        faces(corners, edges, ids);
        if edges.len() < 3 {
            // So little is above the horizon that its corners coincide: anything would seem to cover it.
            return None;
        }
        let left_out = band.map_or(0.0, |(_, error)| error);
        let error = deviation_error(corners, edges)? + deviation::of_facing(origin, to) + left_out;
        *spread = Spread::of(edges, 0, rounding(corners));
        sides.clear();
        sides.extend([HalfSpace::before(to, origin), HalfSpace::above(from)]);
        sides.extend(edges.iter().map(HalfSpace::within));
        let is_whole = to.is_convex() && to.convex_pieces().nth(1).is_none();
        Some(Self { from, to, is_whole, cone: OneCone::new(edges, ids, spread), sides, error })
    }

    /// Whether everything in a box is outside of a side, below the horizon or behind the target, for certain. Polygons
    /// in it may lie off their vertices by `deviation`.
    pub(crate) fn misses_box(&self, extent: &Extent, deviation: f64) -> bool {
        let origin = self.from.position();
        let (low, high) = (extent.low - origin, extent.high - origin);
        let size = size(low.abs().max(high.abs())) + deviation * INVERSE;
        self.sides.iter().any(|side| {
            let innermost = (side.normal * low).max(side.normal * high).element_sum();
            side.is_out(innermost, size)
        })
    }

    /// What keeps a polygon from hiding anything: a side that it is outside of, or an edge that it touches from outside.
    ///
    /// Neighbours of a target in a mesh touch its sides; exact turns decide that they hide nothing.
    pub(super) fn apart(&self, occluder: &PlanarPolygon) -> Option<Apart<'_>> {
        let (origin, points) = (self.from.position(), occluder.points());
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
