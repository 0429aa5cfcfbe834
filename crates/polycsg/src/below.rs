//! What lies right below a point: one vertical look into the arrangement.

use crate::arrangement::Arrangement;
use crate::contacts::Contacts;
use crate::edges::Edges;
use crate::predicates::{Segment, Side, crossing_x_order, height_order, lexicographic, rightward, side};
use crate::strips::Strips;
use glam::DVec2;
use std::cmp::Ordering;

/// The nearest of the indexed segments that a ray straight down from just right of `p` meets.
///
/// The ray keeps right of `p`, so that a segment counts from its leftmost end to just before its rightmost one; of
/// segments that meet below `p` the one that is higher right of it is the nearer. No segment may run through `p`,
/// unless it starts there and is to be passed over.
pub(crate) fn nearest_segment_below(
    strips: &Strips,
    p: DVec2,
    segment: impl Fn(u32) -> Segment,
) -> Option<u32> {
    let mut best: Option<(u32, f64)> = None;
    strips.below(p.x, p.y, |id| {
        let [a, b] = rightward(segment(id));
        let spans = a.x <= p.x && p.x < b.x;
        if spans && side(a, b, p) == Side::Left {
            let nearer =
                best.is_none_or(|(other, _)| height_order([a, b], segment(other), p.x) == Ordering::Greater);
            if nearer {
                best = Some((id, a.y.min(b.y)));
            }
        }
        best.map(|(_, low)| low)
    });
    best.map(|(id, _)| id)
}

/// The half-edge on whose left `p` lies, of the sub-edge nearest below.
pub(crate) fn nearest_below(
    edges: &Edges,
    strips: &Strips,
    contacts: &Contacts,
    arrangement: &Arrangement,
    p: DVec2,
) -> Option<u32> {
    let edge = nearest_segment_below(strips, p, |e| edges.segment(e))?;
    let [a, b] = edges.segment(edge);
    let rightward = lexicographic(a, b) == Ordering::Less;
    let is_left = |vertex: u32| match contacts.crossing(vertex) {
        None => edges.point(vertex).x <= p.x,
        Some([e, f]) => crossing_x_order(edges.segment(e), edges.segment(f), p.x) != Ordering::Greater,
    };
    // The sub-edge that spans the abscissa just right of p.
    let subs = arrangement.of_edge(edge);
    let mut spanning = subs.filter(|&sub| {
        let (tail, head) = (is_left(arrangement.tail(sub)), is_left(arrangement.head(sub)));
        tail == rightward && head != rightward
    });
    let sub = arrangement.stand_in(spanning.next()?);
    // The one that stands in may run the other way.
    let along = arrangement.edge(sub) == edge || {
        let [c, d] = edges.segment(arrangement.edge(sub));
        lexicographic(c, d) == lexicographic(a, b)
    };
    Some(2 * sub + u32::from(rightward != along))
}
