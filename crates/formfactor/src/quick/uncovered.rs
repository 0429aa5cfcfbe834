//! What convex occluders leave of a convex target, piece by piece, where an error is allowed that is larger than those of roundings.
//!
//! ```text
//!     ______________        An occluder's cone is cut out of each piece, plane by plane: what is outside of a plane stays,
//!    |    |    |    |       what is inside of all is hidden. Nothing is decided: a plane that errs by an angle misplaces no
//!    |    |____|    |       more than what is within that angle of it, and a corner that is rounded turns two edges. So
//!    |____|    |____|       edges that run along each other but for roundings are no question here. Large occluders that
//!    |____|____|____|       hide all of the target do so after few cuts, and nothing else is looked at then.
//! ```
use super::cone::{Edge, OneCone, UNDERFLOW};
use super::contour::Sum;
use super::target::Target;
use crate::form_factor::FormFactor;
use crate::numeric::rounding::ROUNDING;
use glam::DVec3;
use std::ops::Range;

/// In more pieces it pays no longer.
const MOST: usize = 4096;
/// Within an angle of a great circle lies no more form factor than this times the angle.
const BAND: f64 = 4.0;
/// More than roundings change in a cosine of the sum of two angles.
const CLEAR: f64 = 1e-14;

/// A cone around all of a convex polygon.
#[derive(Debug)]
struct SphericalCap {
    middle: DVec3,
    /// Of the largest angle from the middle to a corner,
    cosine: f64,
    /// and no less than its sine: the largest distance.
    sine: f64,
}

impl SphericalCap {
    /// Around unit vectors.
    fn around(corners: impl Iterator<Item = DVec3> + Clone) -> Self {
        let (middle, length) = corners.clone().sum::<DVec3>().normalize_and_length();
        let farthest = corners.map(|p| p.distance(middle)).fold(0.0, f64::max);
        // What has no middle goes all around.
        let sine = if length > 0.0 { farthest } else { 2.0 };
        Self { middle, cosine: 1.0 - sine * sine / 2.0, sine }
    }

    /// Whether two are clear of each other: the angle between the middles is larger than the sum of both, which are less than a right angle.
    #[inline]
    fn misses(&self, other: &Self) -> bool {
        let least = self.cosine * other.cosine - self.sine * other.sine;
        self.cosine > 0.0 && other.cosine > 0.0 && self.middle.dot(other.middle) < least - CLEAR
    }
}

/// A convex polygon of unit vectors, counter-clockwise seen from dA.
#[derive(Debug)]
struct UncoveredPiece {
    /// Which of all corners are its own.
    corners: Range<usize>,
    cap: SphericalCap,
}

/// The pieces that are left of a target.
#[derive(Debug, Default)]
pub(super) struct Uncovered {
    pieces: Vec<UncoveredPiece>,
    corners: Vec<DVec3>,
    /// Pieces that the last cone has cut.
    gone: Vec<usize>,
    /// What is inside of the planes so far, of one piece.
    inside: [Vec<DVec3>; 2],
    /// A bound on the form factor of what is misplaced.
    error: f64,
}

impl Uncovered {
    /// All of a target.
    pub(super) fn begin(&mut self, target: OneCone) {
        let Self { pieces, corners, error, .. } = self;
        corners.clear();
        corners.extend(target.edges.iter().map(|edge| edge.start.normalize()));
        *error = BAND * 4.0 * ROUNDING * corners.len() as f64;
        pieces.clear();
        pieces.push(UncoveredPiece {
            corners: 0..corners.len(),
            cap: SphericalCap::around(corners.iter().copied()),
        });
    }

    /// A bound on the form factor of what is misplaced so far: infinite where that is not known.
    pub(super) fn error(&self) -> f64 {
        self.error
    }

    /// Whether nothing is left.
    pub(super) fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// Cuts a cone out.
    pub(super) fn subtract(&mut self, cone: OneCone) {
        let Self { pieces, corners, gone, inside, error } = self;
        if pieces.len() > MOST || cone.edges.len() > u64::BITS as usize {
            *error = f64::INFINITY;
        }
        if !error.is_finite() {
            return;
        }
        let cap = SphericalCap::around(cone.edges.iter().map(|edge| edge.start.normalize()));
        let mut touched = 0_u64;
        gone.clear();
        for index in 0..pieces.len() {
            let piece = &pieces[index];
            if piece.cap.misses(&cap) {
                continue;
            }
            let own = &corners[piece.corners.clone()];
            let is_beside = |plane: &Edge| own.iter().all(|p| plane.inward.dot(*p) <= plane.error);
            if let Some(plane) = cone.edges.iter().position(is_beside) {
                touched |= 1 << plane;
                continue;
            }
            let [rest, _] = &mut *inside;
            rest.clear();
            rest.extend_from_slice(own);
            *error += cut(cone.edges, inside, (pieces, corners), &mut touched);
            gone.push(index);
        }
        gone.iter().rev().for_each(|index| {
            pieces.swap_remove(*index);
        });
        let angle = |plane: &Edge| (plane.error + UNDERFLOW) / plane.inward.length();
        let planes = cone.edges.iter().enumerate().filter(|(index, _)| touched >> index & 1 == 1);
        *error += BAND * planes.map(|(_, plane)| angle(plane)).sum::<f64>();
    }

    /// The edges of all pieces that are left: unit vectors.
    pub(super) fn edges(&self) -> impl Iterator<Item = [DVec3; 2]> {
        let edges = self.pieces.iter().flat_map(|piece| {
            let corners = &self.corners[piece.corners.clone()];
            corners.iter().zip(corners.iter().cycle().skip(1)).map(|(start, end)| [*start, *end])
        });
        edges.filter(|[start, end]| start != end)
    }

    /// The form factor of what is left, with an error of at most `open` from elsewhere; `None` where too much is misplaced.
    pub(super) fn form_factor(&self, target: &Target, open: f64) -> Option<FormFactor> {
        let mut sum = Sum::new(target.from.normal());
        for [start, end] in self.edges() {
            let edge = Edge::new(start, end, end - start);
            let line = sum.line(edge.inward, edge.error);
            sum.add_whole(&edge, &line);
        }
        sum.form_factor(target.error + open + self.error)
    }
}

/// Adds what is outside of any plane of the piece that is inside of none yet, and notes the planes; returns a bound on the form factor that the
/// rounding of corners misplaces.
fn cut(
    planes: &[Edge],
    inside: &mut [Vec<DVec3>; 2],
    (pieces, corners): (&mut Vec<UncoveredPiece>, &mut Vec<DVec3>),
    touched: &mut u64,
) -> f64 {
    let [rest, within] = inside;
    let mut error = 0.0;
    for (index, plane) in planes.iter().enumerate() {
        let place = |p: &DVec3| plane.inward.dot(*p);
        *touched |= u64::from(rest.iter().any(|p| place(p) <= plane.error)) << index;
        if rest.iter().all(|p| place(p) >= -plane.error) {
            continue;
        }
        within.clear();
        let first = corners.len();
        error += split(rest, plane, within, corners);
        pieces.push(UncoveredPiece {
            corners: first..corners.len(),
            cap: SphericalCap::around(corners[first..].iter().copied()),
        });
        std::mem::swap(rest, within);
        if rest.len() < 3 {
            break;
        }
    }
    error
}

/// Adds the corners on either side of a plane, those in it to both; returns a bound on the form factor that the rounding of new ones misplaces.
fn split(polygon: &[DVec3], plane: &Edge, inside: &mut Vec<DVec3>, outside: &mut Vec<DVec3>) -> f64 {
    let mut error = 0.0;
    for (&start, &end) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let [from, to] = [start, end].map(|p| plane.inward.dot(p));
        if from >= -plane.error {
            inside.push(start);
        }
        if from <= plane.error {
            outside.push(start);
        }
        if from.abs().min(to.abs()) > plane.error && (from > 0.0) != (to > 0.0) {
            let crossing = start + (end - start) * (from / (from - to));
            let length = crossing.length();
            error += BAND * 8.0 * ROUNDING / length;
            inside.push(crossing / length);
            outside.push(crossing / length);
        }
    }
    error
}
