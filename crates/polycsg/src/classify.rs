//! How a directed segment lies in a region.

use crate::arrangement::labels::LabelledArrangement;
use crate::base::id::index;
use crate::contacts::Place;
use crate::error::Error;
use crate::expression::csg::Csg;
use crate::pipeline::{self, scratch::Scratch};
use crate::predicates::crossing_point;
use crate::region::{Region, membership::Membership};
use glam::DVec2;

/// A part of a classified segment, between neighbouring contacts with the region's boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Interval {
    /// Where it starts, rounded if it is a crossing.
    pub start: DVec2,
    /// Where it ends.
    pub end: DVec2,
    /// Which of its sides lie in the region, in the segment's direction.
    pub membership: Membership,
}

/// Cuts a directed segment where it meets the region's boundary, and returns the membership of each interval.
///
/// The result is exact: the segment is cut at every contact, and the order and membership of the intervals are right even
/// where rounding makes an interval's ends equal. A segment of no length has no intervals. Expected O(n), plus sorting.
///
/// # Errors
/// [`Error::NonFinite`], with ring 0, when an end of the segment has a NaN or an infinity.
///
/// ```
/// use polycsg::{DVec2, FillRule, Membership, Region, classify};
/// let square = Region::from_rings([[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]], FillRule::NonZero)?;
/// let along_the_floor = classify([DVec2::new(-1.0, 0.0), DVec2::new(5.0, 0.0)], &square)?;
/// let memberships: Vec<_> = along_the_floor.iter().map(|i| i.membership).collect();
/// assert_eq!(memberships, [Membership::Out, Membership::OnPlus, Membership::Out]);
/// # Ok::<(), polycsg::Error>(())
/// ```
pub fn classify(segment: [DVec2; 2], region: &Region) -> Result<Vec<Interval>, Error> {
    if let Some(vertex) = segment.iter().position(|p| !p.is_finite()) {
        return Err(Error::NonFinite { ring: 0, vertex });
    }
    let segment = segment.map(|p| p + DVec2::ZERO);
    if segment[0] == segment[1] {
        return Ok(Vec::new());
    }
    let mut scratch = Scratch::default();
    let csg = Csg::edge_beside(segment, region);
    let LabelledArrangement { edges, contacts, arrangement, labels, .. } =
        pipeline::memberships(&csg, &mut scratch).expect("no limit was given");
    let point = |sub_edge: u32| match contacts.place(arrangement.node(sub_edge)) {
        Place::Vertex(vertex) => edges.point(vertex),
        Place::Crossing(e, f) => crossing_point(edges.segment(e), edges.segment(f)),
    };
    // The segment is the first operand. What is counted last is its end.
    let ring = edges.rings().iter().position(|ring| ring.origin.operand == 0).map_or(0, index);
    let sub_edges = arrangement.of_ring(ring);
    let sub_edges = sub_edges.start..sub_edges.end - 1;
    let intervals = sub_edges.map(|sub_edge| {
        let representative = arrangement.representative(sub_edge);
        let along = arrangement.is_along(edges, representative, sub_edge);
        let membership = labels.of(representative);
        Interval {
            start: point(sub_edge),
            end: point(arrangement.following(edges, sub_edge)),
            membership: if along { membership } else { membership.reversed() },
        }
    });
    Ok(intervals.collect())
}
