//! How two edges meet.
//!
//! ```text
//!  crossing          touch             shared end       overlap = two touches or shared ends
//!      \ f            f                  |f              ____f____
//!   ----x---- e   ----+---- e        e---+              e----+====+
//!        \
//! ```

use crate::edges::Edges;
use crate::predicates::{Area, Clear, Margins, Parameter, Segment, Side, doubled_area, side};
use glam::DVec2;

/// How two edges meet, as far as that is clear whatever rounding does.
#[derive(Clone, Copy, Debug)]
pub(super) enum Meeting {
    Apart,
    Crossing(Crossing),
    /// Not clear; with the areas of each one's ends against the other.
    Close {
        ends_of_f: [Area; 2],
        ends_of_e: [Area; 2],
    },
}

/// Two edges that cross, and where along each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub(super) edges: [u32; 2],
    pub(super) at: [Parameter; 2],
    /// Whether the second one comes from the left of the first.
    pub(super) from_left: bool,
}

impl Crossing {
    pub(super) fn new(
        edges: [u32; 2],
        ends_of_f: [Area; 2],
        ends_of_e: [Area; 2],
        from_left: bool,
    ) -> Crossing {
        let at = [ends_of_e, ends_of_f].map(|ends| Parameter::of_crossing(ends[0], ends[1]));
        Crossing { edges, at, from_left }
    }
}

/// Compares edge `e` with a later one.
#[inline]
pub(super) fn meeting(edges: &Edges, [e, f]: [u32; 2], margins: Margins) -> Meeting {
    let (s, t) = (edges.segment(e), edges.segment(f));
    // Most neighbours along a ring meet in their common end alone, as their corner tells.
    let corner = if f == e + 1 {
        Some([s[0], s[1], t[1]])
    } else {
        (t[1] == s[0] && edges.head(f) == e).then_some([t[0], t[1], s[1]])
    };
    let meet_there_alone = |[a, b, c]: [DVec2; 3]| {
        let shared = SharedEnd { common: b, end_of_s: a, end_of_t: c };
        shared.is_straight() || margins.are_steep([s, t], doubled_area(a, b, c))
    };
    if corner.is_some_and(meet_there_alone) {
        return Meeting::Apart;
    }
    let ends_of_f = [doubled_area(s[0], s[1], t[0]), doubled_area(s[0], s[1], t[1])];
    if margins.are_apart(s, ends_of_f) {
        return Meeting::Apart;
    }
    let ends_of_e = [doubled_area(t[0], t[1], s[0]), doubled_area(t[0], t[1], s[1])];
    let crossing = |from_left| Meeting::Crossing(Crossing::new([e, f], ends_of_f, ends_of_e, from_left));
    match margins.relation([s, t], ends_of_f, ends_of_e) {
        Clear::Apart => Meeting::Apart,
        Clear::CrossFromLeft => crossing(true),
        Clear::CrossFromRight => crossing(false),
        Clear::Unclear => Meeting::Close { ends_of_f, ends_of_e },
    }
}

/// Whether two edges whose boxes meet have more than a point in common.
pub(super) fn overlap(edges: &Edges, pair: [u32; 2]) -> bool {
    let [s, t] = pair.map(|edge| edges.segment(edge));
    let lie_on = |line: Segment, ends: Segment| ends.iter().all(|&p| side(line[0], line[1], p) == Side::On);
    lie_on(s, t) && lie_on(t, s) && !SharedEnd::of(s, t).is_some_and(|shared| shared.is_straight())
}

/// Two edges with one end in common.
pub(super) struct SharedEnd {
    pub(super) common: DVec2,
    pub(super) end_of_s: DVec2,
    pub(super) end_of_t: DVec2,
}

impl SharedEnd {
    pub(super) fn of(s: Segment, t: Segment) -> Option<SharedEnd> {
        let shared = |i: usize, j: usize| SharedEnd { common: s[i], end_of_s: s[1 - i], end_of_t: t[1 - j] };
        let mut corners = [(1, 0), (0, 1), (0, 0), (1, 1)]
            .into_iter()
            .filter(|&(i, j)| s[i] == t[j])
            .map(|(i, j)| shared(i, j));
        let first = corners.next()?;
        corners.next().is_none().then_some(first)
    }

    /// Whether the other ends lie in opposite quadrants from the common one: then the edges do not overlap, and are
    /// not flat to one another.
    pub(super) fn is_straight(&self) -> bool {
        let opposite = |a: f64, c: f64, b: f64| (a <= c && c <= b) || (b <= c && c <= a);
        let (c, p, q) = (self.common, self.end_of_s, self.end_of_t);
        opposite(p.x, c.x, q.x) && opposite(p.y, c.y, q.y)
    }
}
