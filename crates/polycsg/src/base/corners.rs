//! The box around points.

use glam::DVec2;

/// The lower left and upper right corners of the box around points; of none, inside out.
///
/// Four points are compared with one another first: the smallest so far always waits for the one before.
#[inline]
pub(crate) fn corners(points: &[DVec2]) -> [DVec2; 2] {
    let rows = points.chunks_exact(4);
    let rest = rows.remainder().iter().map(|&p| [p, p]);
    let rows = rows.map(|row| {
        let (low, high) =
            ([row[0].min(row[1]), row[2].min(row[3])], [row[0].max(row[1]), row[2].max(row[3])]);
        [low[0].min(low[1]), high[0].max(high[1])]
    });
    let around = |[low, high]: [DVec2; 2], other: [DVec2; 2]| [low.min(other[0]), high.max(other[1])];
    rest.chain(rows).fold([DVec2::INFINITY, DVec2::NEG_INFINITY], around)
}
