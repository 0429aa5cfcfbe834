//! How two edges lie to one another, where rounding cannot make a difference.
//!
//! Rounding moves a crossing by less than `2 u M` (`u = 2^-53`, `M` the largest coordinate's size) and never out of its
//! edges' boxes. Two edges are *clear* of one another when either
//!
//! - all of one lies further than `4 u M` from the other's line, on one side; or
//! - they meet in one point only, at an angle with a sine of at least `2^-15`, and every other point where something
//!   happens on them (contact or end) lies further than `2^-36 M` from it along its edge, so further than
//!   `2^-15 · 2^-36 M = 4 u M` from the other edge.
//!
//! Then no two of their pieces can meet after rounding but in a vertex that they share: pieces that do not end in the
//! common point lie `4 u M` apart, and those that do keep different directions from it.

use super::{orient::Area, segment::Segment};

/// The distances of the module's page.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Margins {
    /// `4 u M`.
    pub(crate) close: f64,
    /// `2^-36 M`.
    pub(crate) gap: f64,
}

/// How two edges lie that are clear of one another, or that they may not be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Clear {
    Apart,
    /// The second one crosses the first from its left.
    CrossFromLeft,
    CrossFromRight,
    Unclear,
}

/// The least sine of an angle that is not flat.
const FLAT: f64 = f64::from_bits((1023 - 15) << 52);

impl Margins {
    /// For coordinates up to a size. Where the margins themselves would lose bits nothing is clear.
    pub(crate) fn for_size(size: f64) -> Margins {
        let close = size * f64::from_bits((1023 - 51) << 52);
        if close < f64::MIN_POSITIVE {
            return Margins { close: f64::INFINITY, gap: f64::INFINITY };
        }
        Margins { close, gap: size * f64::from_bits((1023 - 36) << 52) }
    }

    /// Whether both of two ends lie on one side of a line through an edge, clear of it, by their areas.
    #[inline]
    pub(crate) fn are_apart(&self, edge: Segment, ends: [Area; 2]) -> bool {
        let margin = self.close * length_bound(edge);
        ends.iter().all(|area| area.value - area.error > margin)
            || ends.iter().all(|area| area.value + area.error < -margin)
    }

    /// Whether a point lies clear of the line through an edge, by its area.
    #[inline]
    pub(crate) fn is_apart(&self, edge: Segment, area: Area) -> bool {
        area.value.abs() - area.error > self.close * length_bound(edge)
    }

    /// How two edges lie, by the areas of each one's ends against the other; the second one's ends are known not to be apart from the first.
    #[inline]
    pub(crate) fn relation(&self, [e, f]: [Segment; 2], ends_of_f: [Area; 2], ends_of_e: [Area; 2]) -> Clear {
        if self.are_apart(f, ends_of_e) {
            return Clear::Apart;
        }
        let (of_e, of_f) = (length_bound(e), length_bound(f));
        let steep = ends_of_f[0].value.abs() + ends_of_f[1].value.abs() > 2.0 * FLAT * of_e * of_f;
        // Whether the first end lies left and the second right of a line, both far from it.
        let passes = |[a, b]: [Area; 2], length: f64| {
            let margin = self.gap * length;
            a.value - a.error > margin && b.value + b.error < -margin
        };
        let swapped = |[a, b]: [Area; 2]| [b, a];
        if !steep || !(passes(ends_of_e, of_f) || passes(swapped(ends_of_e), of_f)) {
            Clear::Unclear
        } else if passes(ends_of_f, of_e) {
            Clear::CrossFromLeft
        } else if passes(swapped(ends_of_f), of_e) {
            Clear::CrossFromRight
        } else {
            Clear::Unclear
        }
    }

    /// Whether two edges with a common point are far from parallel, by the doubled area of a triangle of both.
    #[inline]
    pub(crate) fn are_steep(&self, [e, f]: [Segment; 2], area: Area) -> bool {
        area.value.abs() - area.error > FLAT * length_bound(e) * length_bound(f)
    }
}

/// Not less than the length, and less than 1.5 times it.
#[inline]
fn length_bound([a, b]: Segment) -> f64 {
    (b.x - a.x).abs() + (b.y - a.y).abs()
}
