//! Stage 7: makes the rounded pieces meet in shared points only.
//!
//! Rounding moves crossings by half an ulp, which may carry a vertex over a piece, or a piece onto another. Where that
//! happened, both pieces are cut at the *exact* abscissae of each other's ends and the cut points are rounded:
//!
//! ```text
//!   exact              rounded: they cross       cut at a, b; rounded again
//!   ----__             -------                   ------+---+
//!     a   ---b           \/                            a   b     weakly ordered on each vertical, so no crossing
//!   --------             -/\----                 ------+---+
//! ```
//!
//! Why this ends, and ends well. Exactly, pieces meet only in common vertices, so between two cuts at equal abscissae
//! two fragments keep one order; rounding each coordinate to nearest is monotone, so they keep it weakly at both
//! ends: they may share ends or coincide, never cross. When two fragments still conflict, some end of one lies
//! strictly inside the abscissae of the other, so a cut is added; there are finitely many (piece, vertex) pairs.
//! Only fragments that rounding made vertical escape this argument: they can overlap on their one abscissa, and are cut
//! at the points that lie on them, which moves nothing.

mod fragments;
mod mend;
mod near;
mod sound;

pub(crate) use mend::mend;
pub(crate) use sound::is_sound;

use crate::contacts::Contacts;
use crate::edges::Edges;
use crate::predicates::{Segment, Side, is_inside, side};
use crate::select::Selection;
use glam::DVec2;
use std::ops::Range;

/// A part of one edge between neighbouring vertices of the boundary, in the boundary's direction. Vertices are slots,
/// or nodes counted behind the slots.
#[derive(Clone, Copy, Debug)]
struct Part {
    start: u32,
    end: u32,
    edge: u32,
}

/// A piece of a part between neighbouring cuts, rounded.
#[derive(Clone, Copy, Debug)]
struct Fragment {
    segment: Segment,
    edge: u32,
    /// The vertices whose abscissae its ends have.
    ends: [u32; 2],
    /// Whether an end is a rounded point.
    moved: bool,
}

/// A cut of a fragment, by its place, at a vertex's abscissa.
type CutAt = (u32, u32);

/// Fragments with the same ends, as a span of `alike`, and whether any has a rounded end.
#[derive(Clone, Debug)]
struct Class {
    members: Range<usize>,
    moved: bool,
}

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct Mending {
    parts: Vec<Part>,
    fragments: Vec<Fragment>,
    /// The fragments that are not empty, by their ends, and the spans of those with the same ends.
    alike: Vec<u32>,
    classes: Vec<Class>,
    /// Pairs of classes.
    conflicts: Vec<[u32; 2]>,
    /// The cuts to be made next, sorted.
    cuts: Vec<CutAt>,
    /// The suspected edges, sorted.
    edges: Vec<u32>,
    /// How many vertices were put into edges since the count was set to 0.
    pub(crate) mended: usize,
}

/// What the stage looks at.
#[derive(Clone, Copy)]
pub(crate) struct Rounded<'a> {
    pub(crate) edges: &'a Edges,
    pub(crate) contacts: &'a Contacts,
    pub(crate) selection: &'a Selection,
}

/// Whether two segments have more in common than single ends, or nothing.
fn in_conflict([s, t]: [Segment; 2]) -> bool {
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
