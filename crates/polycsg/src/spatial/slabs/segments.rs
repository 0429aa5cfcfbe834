//! What slabs are made of: edges by the ranks of their ends, the lines that they lie on, and the edges that span a slab.

use glam::DVec2;

/// Into so many slabs one is cut.
const PARTS: u32 = 5;

/// No span.
pub(super) const NONE: u32 = u32::MAX;

/// An edge, by the ranks of its ends among all distinct ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct RankedSegment {
    pub(super) ranks: [u32; 2],
    pub(super) id: u32,
}

/// A slab by the ranks of the points at its sides.
pub(super) type Slab = [u32; 2];

impl RankedSegment {
    /// Whether the boxes of two edges, widened, meet: where all is within the heights' error, boxes still tell short
    /// edges apart.
    #[inline]
    pub(super) fn meets(self, other: RankedSegment, ends: &[DVec2], reach: f64) -> bool {
        let [[a, b], [c, d]] = [self, other].map(|segment| segment.ranks.map(|rank| ends[rank as usize]));
        let (low, high) = (a.min(b) - reach, a.max(b) + reach);
        low.cmple(c.max(d)).all() && high.cmpge(c.min(d)).all()
    }
}

/// The line through an edge: by its left end and its slope, not a number where a slope would not do.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) end: DVec2,
    pub(super) slope: f64,
}

/// An edge in a slab, with its heights where it enters the slab or starts and where it leaves the slab or ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClippedSegment {
    pub(super) heights: [f64; 2],
    pub(super) line: Line,
    pub(super) segment: RankedSegment,
}

/// A slab cut at some of its ends, as evenly as may be.
pub(super) fn parts([left, right]: Slab) -> impl Iterator<Item = Slab> {
    let length = right - left;
    let parts = PARTS.min(length);
    let cut = move |i: u32| left + length / parts * i + length % parts * i / parts;
    (0..parts).map(move |i| [cut(i), cut(i + 1)])
}
