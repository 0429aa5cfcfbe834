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
    /// In a common end alone, at an angle that is not flat; whether it is where each edge ends, not where it starts.
    Sharing([bool; 2]),
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
    #[inline]
    pub(super) fn new(
        edges: [u32; 2],
        ends_of_f: [Area; 2],
        ends_of_e: [Area; 2],
        from_left: bool,
    ) -> Crossing {
        let at_e = Parameter::of_crossing(ends_of_e[0], ends_of_e[1]);
        let at_f = Parameter::of_crossing(ends_of_f[0], ends_of_f[1]);
        Crossing { edges, at: [at_e, at_f], from_left }
    }
}

/// Compares edge `e` with a later one.
#[inline]
pub(super) fn meeting(edges: &Edges, [e, f]: [u32; 2], margins: Margins) -> Meeting {
    let (s, t) = (edges.segment(e), edges.segment(f));
    // Most neighbours along a ring meet in their common end alone.
    if f == e + 1 {
        if SharedEnd::at([true, false], s, t).is_clear([s, t], margins) {
            return Meeting::Apart;
        }
    } else if t[1] == s[0] && SharedEnd::at([false, true], s, t).is_clear([s, t], margins) {
        return Meeting::Sharing([false, true]);
    }
    let ends_of_f = [doubled_area(s[0], s[1], t[0]), doubled_area(s[0], s[1], t[1])];
    // So it is where an end is shared.
    if ends_of_f[0].value * ends_of_f[1].value == 0.0
        && let Some(at_end) = clear_corner(s, t, margins)
    {
        return Meeting::Sharing(at_end);
    }
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

/// Where each of two edges has their common end, if they meet there alone, whatever rounding does.
#[inline(never)]
fn clear_corner(s: Segment, t: Segment, margins: Margins) -> Option<[bool; 2]> {
    SharedEnd::of(s, t).filter(|shared| shared.is_clear([s, t], margins)).map(|shared| shared.at_end)
}

/// Whether two edges whose boxes meet have more than a point in common.
pub(super) fn overlap(edges: &Edges, pair: [u32; 2]) -> bool {
    let [s, t] = pair.map(|edge| edges.segment(edge));
    let lie_on = |line: Segment, ends: Segment| ends.iter().all(|&p| side(line[0], line[1], p) == Side::On);
    lie_on(s, t) && lie_on(t, s) && !SharedEnd::of(s, t).is_some_and(|shared| shared.is_straight())
}

/// Two edges with one end in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct SharedEnd {
    /// Whether it is where each edge ends, not where it starts.
    pub(super) at_end: [bool; 2],
    common: DVec2,
    others: [DVec2; 2],
}

impl SharedEnd {
    #[inline]
    fn at(at_end: [bool; 2], s: Segment, t: Segment) -> SharedEnd {
        let [i, j] = at_end.map(usize::from);
        SharedEnd { at_end, common: s[i], others: [s[1 - i], t[1 - j]] }
    }

    /// Without branches but for whether there is any, as edges share ends in any order.
    #[inline]
    pub(super) fn of(s: Segment, t: Segment) -> Option<SharedEnd> {
        let differ = |a: f64, b: f64| a.to_bits() ^ b.to_bits();
        let same = |i: usize, j: usize| {
            u32::from(differ(s[i].x, t[j].x) | differ(s[i].y, t[j].y) == 0) << (2 * i + j)
        };
        let ends = same(0, 0) | same(0, 1) | same(1, 0) | same(1, 1);
        let first = ends.trailing_zeros();
        ends.is_power_of_two().then(|| SharedEnd::at([first & 2 != 0, first & 1 != 0], s, t))
    }

    /// Whether the edges do not lead from the common end in nearly one direction.
    #[inline]
    fn is_clear(&self, edges: [Segment; 2], margins: Margins) -> bool {
        let area = || doubled_area(self.common, self.others[0], self.others[1]);
        self.is_straight() || margins.are_steep(edges, area())
    }

    /// Whether the edges do not lead from the common end in one direction.
    pub(super) fn is_corner(&self) -> bool {
        self.is_straight() || side(self.common, self.others[0], self.others[1]) != Side::On
    }

    /// Whether the other ends lie in opposite quadrants from the common one: then the edges do not overlap, and are
    /// not flat to one another.
    #[inline]
    pub(super) fn is_straight(&self) -> bool {
        let opposite = |a: f64, c: f64, b: f64| ((a <= c) & (c <= b)) | ((b <= c) & (c <= a));
        let (c, [p, q]) = (self.common, self.others);
        opposite(p.x, c.x, q.x) & opposite(p.y, c.y, q.y)
    }
}
