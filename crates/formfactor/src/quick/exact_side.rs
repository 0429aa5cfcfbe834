//! On which side of the plane of an edge a corner of another cone is, exactly.
//!
//! ```text
//!        dA
//!         .             Where an occluder passes through the target's plane, it is cut there: its corners are places of edges, and the edge
//!       . |  / A        between two of them lies where the two planes meet. A place p of the target's plane is inside the plane of dA
//!     .   | /           and that edge where the occluder A is between the two: on the other side of A than dA.
//!   ------|/-----p---
//!         cut
//! ```
use super::cone::{CornerId, Kind, OneCone};
use crate::numeric::predicates::{Plane, side_of_crossing, turn};
use glam::DVec3;
use std::cmp::Ordering;

/// From dA to the target's plane, at which occluders are cut.
#[derive(Debug)]
pub(super) struct Span<'t> {
    pub(super) origin: DVec3,
    pub(super) plane: &'t Plane,
}

/// On which side of the plane of an edge a corner of another cone is, as far as vertices as given decide it.
#[cold]
pub(super) fn exact_side(
    span: &Span,
    (cone, corner): (&OneCone, CornerId),
    (other, edge): (&OneCone, usize),
) -> Option<Ordering> {
    let ends = other.ends(edge);
    let are_known = corner.is_known() && ends.iter().all(|end| end.is_known());
    if !are_known {
        return None;
    }
    if ends.contains(&corner) {
        return Some(Ordering::Equal);
    }
    match other.line(edge) {
        Some([a, b]) => side_of([span.origin, b, a], span, (cone, corner)),
        None if other.spread.kind == Kind::Flat => behind(span, (cone, corner), ends),
        None => None,
    }
}

/// On which side of the plane through three points a corner is: a vertex as given, or where the target's plane cuts an edge.
fn side_of([a, b, c]: [DVec3; 3], span: &Span, (cone, corner): (&OneCone, CornerId)) -> Option<Ordering> {
    match corner.between().map(|p| turn(a, b, c, p)) {
        [one, other] if one == other || other.is_eq() => Some(one),
        [Ordering::Equal, other] => Some(other),
        _ if cone.spread.kind != Kind::Target => {
            Some(side_of_crossing(&[a, b, c], corner.between(), span.plane))
        }
        _ => None,
    }
}

/// Whether a corner in the target's plane is behind the occluder that this plane cut between two ends; `None` of other corners.
fn behind(span: &Span, (cone, corner): (&OneCone, CornerId), ends: [CornerId; 2]) -> Option<Ordering> {
    let is_in_plane = match corner.given() {
        Some(given) => span.plane.side_of(given).is_eq(),
        None => cone.spread.kind != Kind::Target,
    };
    let [[a, b], [c, d]] = ends.map(CornerId::between);
    let occluder = Plane::through([a, b, c]).or_else(|| Plane::through([a, b, d])).filter(|_| is_in_plane)?;
    let side = side_of(occluder.corners, span, (cone, corner))?;
    match occluder.side_of(span.origin) {
        Ordering::Greater => Some(side.reverse()),
        Ordering::Less => Some(side),
        Ordering::Equal => None,
    }
}
