//! Where an edge is at an end of another one: a height with a bound on its error.

use super::SlabDecomposition;
use super::segments::{Line, RankedSegment, Slab, SpanningSegment};
use glam::DVec2;

impl SlabDecomposition {
    #[inline]
    pub(super) fn line(&self, segment: RankedSegment, slab: Slab) -> Line {
        let [a, b] = self.ends_of(segment);
        let [left, right] = slab.map(|rank| self.ends[rank as usize].x);
        let is_right_end = b.x - right < left - a.x;
        Line {
            end: if is_right_end { b } else { a },
            is_right_end,
            slope: (b.y - a.y) / (b.x - a.x),
            has_slope: self.has_slopes && a.x != b.x,
        }
    }

    /// Where an edge has a rank, as a height; wrong by a quarter of the slack at most.
    #[inline]
    pub(super) fn height(&self, ranks: [u32; 2], line: Line, rank: u32) -> f64 {
        let p = self.ends[rank as usize];
        if ranks.contains(&rank) { p.y } else { self.height_at(ranks, line, p) }
    }

    /// The same, for a rank between the edge's ends.
    #[inline]
    pub(super) fn height_inside(&self, span: &SpanningSegment, rank: u32) -> f64 {
        self.height_at(span.segment.ranks, span.line, self.ends[rank as usize])
    }

    /// The slope is wrong by 3u of itself, its product by 5u, which is 10u times the larger height at most, and the sum by
    /// 2u of that (u = 2^-53).
    #[inline]
    fn height_at(&self, ranks: [u32; 2], line: Line, p: DVec2) -> f64 {
        if line.has_slope {
            line.end.y + (p.x - line.end.x) * line.slope
        } else {
            self.height_anywhere(ranks, p)
        }
    }

    /// The same for all coordinates. With t the part of the way: t is wrong by 3u t, 1 - t by 3u t + u, the products and
    /// their sum by 2u each: less than 10u times the larger height.
    #[cold]
    fn height_anywhere(&self, ranks: [u32; 2], p: DVec2) -> f64 {
        let [a, b] = ranks.map(|rank| self.ends[rank as usize]);
        let run = b.x - a.x;
        if run == 0.0 {
            return p.y;
        }
        let halves = |x: f64| x * 0.5 - a.x * 0.5;
        let t = if run.is_finite() { (p.x - a.x) / run } else { halves(p.x) / halves(b.x) };
        a.y * (1.0 - t) + b.y * t
    }
}
