//! Classifies occluders, as far as doubles decide it: one misses the target, covers it, or may block a part of it.
//!
//! The steps come in the order of what they cost. An occluder misses the target if it is outside of one of the target's
//! half-spaces, coplanar with dA, or behind the target's plane. Otherwise what is behind that plane is cut off, and the cone of
//! the rest is added. The occluder covers the target if that cone contains all corners of the target.
use super::clip::clip;
use super::cone::{Cones, Corner, Edge, Place, size};
use super::corners::{copy, deviation_error};
use super::target::{Apart, Target};
use crate::exact::deviation;
use crate::exact::lambert::{Direction, swept};
use crate::shapes::polygon::PlanarPolygon;
use glam::DVec3;
use std::cmp::Ordering;

/// What an occluder does to the target.
#[derive(Clone, Copy, Debug)]
pub(super) enum Class {
    /// It hides nothing, but for a form factor of at most `error`.
    Misses { error: f64 },
    /// It may hide a part: its cone is the last one pushed. Its deviation leaves a form factor of at most `error` open.
    Blocks { error: f64, is_clipped: bool },
    /// It hides all of the target.
    Covers,
}

/// Classifies an occluder, and adds its cone where it may block; `None` where doubles do not decide it.
pub(super) fn classify(
    target: &Target,
    occluder: &PlanarPolygon,
    [corners, spare]: &mut [Vec<Corner>; 2],
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
    if !occluder.is_convex() {
        return None;
    }
    let (origin, plane) = (target.from.position(), target.to.plane());
    let facing = occluder.plane().side_of(origin);
    // On which side of the target's plane its vertices are: what is behind it is cut off.
    let (mut is_clipped, mut is_before) = (false, false);
    for side in occluder.points().iter().map(|p| plane.side_of(*p)) {
        is_clipped |= side == Ordering::Less;
        is_before |= side == Ordering::Greater;
    }
    if deviation > 0.0 {
        // Vertices stand for others nearby: near the planes that decide, the exact route bounds what that changes.
        let is_clear = |p: &DVec3| {
            plane.quick_side(*p) == Some(Ordering::Greater)
                && plane.rounded().dot(*p - plane.corners[0]) > 4.0 * deviation * size(plane.rounded())
        };
        if deviation::of_facing(origin, occluder) > 0.0 || !occluder.points().iter().all(is_clear) {
            return None;
        }
    }
    if facing == Ordering::Equal || !is_before {
        return Some(Class::Misses { error: 0.0 });
    }
    let is_reversed = facing == Ordering::Less;
    // From here on the occluder is what is left of it, counter-clockwise seen from dA.
    let edges = if is_clipped || occluder.deviation() > 0.0 {
        copy(occluder, origin, is_reversed, corners);
        if is_clipped {
            clip(corners, spare, |p| plane.side_of(p), |p| plane.side(p).value.round());
        }
        cones.push(corners.iter().copied())
    } else {
        corners.clear();
        let given = occluder.points().iter().map(|p| Corner::given(*p, origin, 0.0));
        if is_reversed { cones.push(given.rev()) } else { cones.push(given) }
    };
    if edges.len() < 3 {
        // So little is in front of the target that its corners coincide.
        return None;
    }
    let error = deviation_error(corners, edges)?;
    if error == 0.0
        && edges.iter().all(|edge| target.cone.edges.iter().all(|t| edge.place(t.start) == Place::Inside))
    {
        return Some(Class::Covers);
    }
    Some(Class::Blocks { error, is_clipped })
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
