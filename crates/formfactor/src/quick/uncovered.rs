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

/// In more pieces it pays no longer.
const MOST: usize = 512;
/// Within an angle of a great circle lies no more form factor than this times the angle.
const BAND: f64 = 4.0;

/// Convex polygons of unit vectors, counter-clockwise seen from dA.
#[derive(Debug, Default)]
struct Polygons {
    corners: Vec<DVec3>,
    /// Where each ends among the corners.
    ends: Vec<usize>,
}

/// The pieces that are left of a target.
#[derive(Debug, Default)]
pub(super) struct Uncovered {
    pieces: Polygons,
    next: Polygons,
    /// What is inside of the planes so far, of one piece.
    inside: [Vec<DVec3>; 2],
    /// A bound on the form factor of what is misplaced.
    error: f64,
}

impl Polygons {
    fn clear(&mut self) {
        self.corners.clear();
        self.ends.clear();
    }

    fn push(&mut self, corners: &[DVec3]) {
        self.corners.extend_from_slice(corners);
        self.ends.push(self.corners.len());
    }

    fn iter(&self) -> impl Iterator<Item = &[DVec3]> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(start, end)| &self.corners[*start..*end])
    }
}

impl Uncovered {
    /// All of a target.
    pub(super) fn begin(&mut self, target: OneCone) {
        let Self { pieces, inside: [corners, _], error, .. } = self;
        corners.clear();
        corners.extend(target.edges.iter().map(|edge| edge.start.normalize()));
        *error = BAND * 4.0 * ROUNDING * corners.len() as f64;
        pieces.clear();
        pieces.push(corners);
    }

    /// A bound on the form factor of what is misplaced so far: infinite where that is not known.
    pub(super) fn error(&self) -> f64 {
        self.error
    }

    /// Whether nothing is left.
    pub(super) fn is_empty(&self) -> bool {
        self.pieces.ends.is_empty()
    }

    /// Cuts a cone out.
    pub(super) fn subtract(&mut self, cone: OneCone) {
        let Self { pieces, next, inside, error } = self;
        if pieces.ends.len() > MOST || cone.edges.len() > u64::BITS as usize {
            *error = f64::INFINITY;
        }
        if !error.is_finite() {
            return;
        }
        next.clear();
        let mut touched = 0_u64;
        for piece in pieces.iter() {
            match cone
                .edges
                .iter()
                .position(|plane| piece.iter().all(|p| plane.inward.dot(*p) <= plane.error))
            {
                Some(plane) => {
                    touched |= 1 << plane;
                    next.push(piece);
                }
                None => *error += cut(piece, cone.edges, inside, next, &mut touched),
            }
        }
        let angle = |plane: &Edge| (plane.error + UNDERFLOW) / plane.inward.length();
        let planes = cone.edges.iter().enumerate().filter(|(index, _)| touched >> index & 1 == 1);
        *error += BAND * planes.map(|(_, plane)| angle(plane)).sum::<f64>();
        std::mem::swap(pieces, next);
    }

    /// The form factor of what is left, with an error of at most `open` from elsewhere; `None` where too much is misplaced.
    pub(super) fn form_factor(&self, target: &Target, open: f64) -> Option<FormFactor> {
        let mut sum = Sum::new(target.from.normal());
        for piece in self.pieces.iter() {
            for (&start, &end) in
                piece.iter().zip(piece.iter().cycle().skip(1)).filter(|(start, end)| start != end)
            {
                let edge = Edge::new(start, end, end - start);
                let line = sum.line(edge.inward, edge.error);
                sum.add_whole(&edge, &line);
            }
        }
        sum.form_factor(target.error + open + self.error)
    }
}

/// Adds what is outside of any plane of a piece, and notes the planes; returns a bound on the form factor that the rounding of corners
/// misplaces.
fn cut(
    piece: &[DVec3],
    planes: &[Edge],
    inside: &mut [Vec<DVec3>; 2],
    outside: &mut Polygons,
    touched: &mut u64,
) -> f64 {
    let [rest, within] = inside;
    rest.clear();
    rest.extend_from_slice(piece);
    let mut error = 0.0;
    for (index, plane) in planes.iter().enumerate() {
        let place = |p: &DVec3| plane.inward.dot(*p);
        *touched |= u64::from(rest.iter().any(|p| place(p) <= plane.error)) << index;
        if rest.iter().all(|p| place(p) >= -plane.error) {
            continue;
        }
        within.clear();
        error += split(rest, plane, within, &mut outside.corners);
        outside.ends.push(outside.corners.len());
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
