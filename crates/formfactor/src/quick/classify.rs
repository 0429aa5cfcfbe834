//! Classifies occluders, as far as doubles decide it: one misses the target, covers it, or may block a part of it.
//!
//! The steps come in the order of what they cost. An occluder misses the target if it is outside of one of the target's
//! half-spaces, coplanar with dA, or behind the target's plane. Otherwise what is behind that plane is cut off each of its convex
//! pieces, and the cones of the rest are added. The occluder covers the target if one of them contains all corners of the target.
use super::clip::clip;
use super::cone::{Cones, Corner, Edge, Kind, Place, size};
use super::corners::{copy, deviation_error};
use super::interval::greater;
use super::target::{Apart, Target};
use crate::exact::deviation::{self, swept as swept_by};
use crate::exact::lambert::{Direction, swept};
use crate::exact::planarity;
use crate::numeric::rounding::ROUNDING;
use crate::shapes::polygon::PlanarPolygon;
use glam::DVec3;
use std::cmp::Ordering;

/// What an occluder does to the target.
#[derive(Clone, Copy, Debug)]
pub(super) enum Class {
    /// It hides nothing, but for a form factor of at most `error`.
    Misses { error: f64 },
    /// It may hide a part: its cones were pushed. Its deviation leaves a form factor of at most `error` open.
    Blocks { error: f64, is_clipped: bool },
    /// It hides all of the target.
    Covers,
}

/// Classifies an occluder, and adds the cones of its convex pieces where it may block; `None` where doubles do not decide it.
pub(super) fn classify(
    target: &Target,
    occluder: &PlanarPolygon,
    buffers: &mut [Vec<Corner>; 2],
    cones: &mut Cones,
) -> Option<Class> {
    let deviation = occluder.deviation() + target.to.deviation();
    match target.apart(occluder) {
        Some(Apart::Outside) => return Some(Class::Misses { error: 0.0 }),
        Some(Apart::Touching(edge)) => {
            return Some(Class::Misses { error: of_touch(edge, target, occluder, deviation) });
        }
        None => (),
    }
    if let Some(error) = edge_on(target, occluder) {
        return Some(Class::Misses { error });
    }
    let loose = loose(target, occluder)?;
    let facing = occluder.plane().side_of(target.from.position());
    if facing == Ordering::Equal {
        return Some(Class::Misses { error: 0.0 });
    }
    let mut pieces = occluder.convex_pieces().peekable();
    pieces.peek()?;
    let (mut hidden, mut all_clipped) = (None, false);
    for piece in pieces {
        let Some(is_clipped) = before(target, piece) else { continue };
        let cone = push(target, (piece, occluder.deviation() + loose), facing, is_clipped, buffers, cones)?;
        let error = deviation_error(&buffers[0], cone)?;
        if error == 0.0 && covers(cone, target) {
            return Some(Class::Covers);
        }
        hidden = Some(error + hidden.unwrap_or(0.0));
        all_clipped |= is_clipped;
    }
    let moved = if loose > 0.0 { swept_by(target.from.position(), occluder, loose) } else { 0.0 };
    Some(match hidden {
        Some(error) => Class::Blocks { error: error + moved, is_clipped: all_clipped },
        None => Class::Misses { error: 0.0 },
    })
}

/// What a polygon may hide at most is so little that it is left out.
const LITTLE: f64 = 1e-15;

/// A bound on what a polygon hides that is seen edge-on but for roundings, as coplanar neighbours of dA's own polygon are.
///
/// If dA is off its plane by h, and all of it is at least d away, it lies within an angle of sine h/d on one side of the plane:
/// at most 2 h/d of a form factor. Where it rises above the horizon by a sine of s at most, that is at most s^2.
fn edge_on(target: &Target, occluder: &PlanarPolygon) -> Option<f64> {
    let (origin, points) = (target.from.position(), occluder.points());
    let off = occluder.normal().dot(points[0] - origin).abs();
    if off > 1e-9 * size(points[0] - origin) {
        return None;
    }
    let reach = points.iter().fold(0.0, |reach, p| greater(reach, size(*p - origin)));
    let roundings = 16.0 * ROUNDING * (reach + size(origin)) + occluder.deviation();
    let height = off + roundings;
    let middle = points.iter().map(|p| *p - origin).sum::<DVec3>().normalize_or_zero();
    let nearest = points.iter().map(|p| middle.dot(*p - origin)).fold(f64::INFINITY, f64::min);
    let least = nearest - 16.0 * ROUNDING * reach - occluder.deviation();
    let up = target.from.normal();
    let risen = points.iter().map(|p| up.dot(*p - origin)).fold(0.0, f64::max) + roundings;
    let hidden = f64::min(2.0 * height / least, (risen / least) * (risen / least));
    (least > 0.0 && hidden <= LITTLE).then_some(hidden)
}

/// How far the line may be where an occluder meets the target's plane, as vertices stand for others nearby; nothing where the two may
/// be coplanar, or dA in the occluder's plane.
fn loose(target: &Target, occluder: &PlanarPolygon) -> Option<f64> {
    if occluder.deviation() + target.to.deviation() == 0.0 {
        return Some(0.0);
    }
    let is_open = deviation::of_facing(target.from.position(), occluder) > 0.0
        || planarity::is_coplanar(target.to, occluder);
    (!is_open).then(|| planarity::at_target(target.to, occluder))
}

/// Whether a piece passes through the target's plane; nothing where it is behind.
fn before(target: &Target, piece: &[DVec3]) -> Option<bool> {
    let (mut is_clipped, mut is_before) = (false, false);
    for side in piece.iter().map(|p| target.to.plane().side_of(*p)) {
        is_clipped |= side == Ordering::Less;
        is_before |= side == Ordering::Greater;
    }
    is_before.then_some(is_clipped)
}

/// Adds the cone of what is left of a convex piece before the target's plane, counter-clockwise seen from dA; its corners are in the
/// first of the buffers where any has a deviation. `None` where so little is left that its corners coincide.
fn push<'c>(
    target: &Target,
    (piece, deviation): (&[DVec3], f64),
    facing: Ordering,
    is_clipped: bool,
    [corners, spare]: &mut [Vec<Corner>; 2],
    cones: &'c mut Cones,
) -> Option<&'c [Edge]> {
    let (origin, plane) = (target.from.position(), target.to.plane());
    let is_reversed = facing == Ordering::Less;
    let edges = if is_clipped || deviation > 0.0 {
        copy(piece, deviation, origin, is_reversed, corners);
        if is_clipped {
            clip(corners, spare, |p| plane.side_of(p), |p| plane.side(p).value.round());
        }
        cones.push(corners, Kind::of_occluder(deviation == 0.0))
    } else {
        corners.clear();
        let given = piece.iter().copied();
        if is_reversed { cones.push_given(given.rev(), origin) } else { cones.push_given(given, origin) }
    };
    (edges.len() >= 3).then_some(edges)
}

/// Whether a cone contains the target for certain.
fn covers(cone: &[Edge], target: &Target) -> bool {
    let contains = |edge: &Edge| target.cone.edges.iter().all(|t| edge.place(t.start) == Place::Inside);
    cone.iter().all(contains)
}

/// A bound on what a polygon may hide that touches a side of the target from outside: a band along the side.
fn of_touch(edge: &Edge, target: &Target, occluder: &PlanarPolygon, deviation: f64) -> f64 {
    if deviation == 0.0 {
        return 0.0;
    }
    let origin = target.from.position();
    let reached = occluder.points().iter().map(|p| p.distance(origin));
    let nearest = reached.fold(edge.start.length().min(edge.end.length()), f64::min);
    let error = 2.0 * deviation / nearest;
    swept(Direction { toward: edge.start, error }, Direction { toward: edge.end, error })
}
