//! Where an edge is at an end of another one: a height with a bound on its error.

use super::SlabDecomposition;
use super::segments::{ClippedSegment, Line, RankedSegment, Slab};
use glam::DVec2;

impl SlabDecomposition {
    fn line(&self, segment: RankedSegment) -> Line {
        let [a, b] = self.ends_of(segment);
        let has_slope = self.has_slopes && a.x != b.x;
        Line { end: a, slope: if has_slope { (b.y - a.y) / (b.x - a.x) } else { f64::NAN } }
    }

    /// An edge in a slab that both have more than a point in common.
    #[inline]
    pub(super) fn clip(&self, segment: RankedSegment, slab: Slab) -> ClippedSegment {
        let mut clipped = ClippedSegment { heights: [0.0; 2], line: self.line(segment), segment };
        clipped.heights = [
            self.height(&clipped, segment.ranks[0].max(slab[0])),
            self.height(&clipped, segment.ranks[1].min(slab[1])),
        ];
        clipped
    }

    /// Where an edge has a rank, as a height; wrong by a quarter of the slack at most.
    #[inline]
    pub(super) fn height(&self, clipped: &ClippedSegment, rank: u32) -> f64 {
        let p = self.ends[rank as usize];
        if rank == clipped.segment.ranks[1] { p.y } else { self.height_inside(clipped, p) }
    }

    /// The same, for a rank before the edge's right end.
    ///
    /// The slope is wrong by 3u of itself, its product by 5u, which is 10u times the larger height at most, and the sum by
    /// 2u of that (u = 2^-53).
    #[inline]
    pub(super) fn height_inside(&self, clipped: &ClippedSegment, p: DVec2) -> f64 {
        let Line { end, slope } = clipped.line;
        let height = end.y + (p.x - end.x) * slope;
        if height.is_nan() { self.height_anywhere(clipped.segment.ranks, p) } else { height }
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
