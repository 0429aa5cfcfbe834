//! Parts of edges, their rounded fragments, and when two of these are in conflict.

use crate::predicates::{Segment, Side, is_inside, side};
use glam::DVec2;
use std::ops::Range;

/// A part of one edge between neighbouring vertices of the boundary, in the boundary's direction. Vertices are slots,
/// or nodes counted behind the slots.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) start: u32,
    pub(super) end: u32,
    pub(super) edge: u32,
}

/// A piece of a part between neighbouring cuts, rounded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fragment {
    pub(super) segment: Segment,
    pub(super) edge: u32,
    /// The vertices whose abscissae its ends have.
    pub(super) ends: [u32; 2],
    /// Whether an end is a rounded point.
    pub(super) moved: bool,
    /// The last round of cuts in which it was in conflict, from 1 on.
    pub(super) round: u32,
}

/// A cut of a fragment, by its place, at a vertex's abscissa.
pub(super) type CutAt = (u32, u32);

/// Fragments with the same ends, as a span of `alike`, whether any has a rounded end, and the last round of any.
#[derive(Clone, Debug)]
pub(super) struct Class {
    pub(super) members: Range<usize>,
    pub(super) moved: bool,
    pub(super) round: u32,
}

/// Whether two segments meet elsewhere than in common ends.
pub(super) fn in_conflict([s, t]: [Segment; 2]) -> bool {
    let (p, q) = (side(s[0], s[1], t[0]), side(s[0], s[1], t[1]));
    if p == q && p != Side::On {
        return false;
    }
    let (r, o) = (side(t[0], t[1], s[0]), side(t[0], t[1], s[1]));
    let touches = |side: Side, segment: Segment, point: DVec2| side == Side::On && is_inside(segment, point);
    let touch = touches(p, s, t[0]) || touches(q, s, t[1]) || touches(r, t, s[0]) || touches(o, t, s[1]);
    let cross = p == q.reversed() && p != Side::On && r == o.reversed() && r != Side::On;
    touch || cross
}
