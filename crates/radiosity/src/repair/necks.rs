//! Corners that nearly touch an edge become corners of it: what is thinner than a width between them, a neck or a spike, is gone.
//!
//! ```text
//! ┌─────┐   ┌─────┐       ┌─────┐   ┌─────┐
//! │     └───┘     │   →   │     │   │     │
//! └───────────────┘       └─────┴───┴─────┘     the edge below runs to and fro between the two
//! ```
use crate::extent::{BoxTree, Extent};
use glam::DVec2;
use polycsg::{FillRule, Region};

/// A region without what is thinner than the width between a corner and an edge, and with one corner for those that rounding keeps apart,
/// nearer than `near`; its outline moves by no more than that. O(n log n) for n edges that are short or spread out.
pub(super) fn without_necks(region: &Region, width: f64, near: f64) -> Region {
    let corners: Vec<DVec2> = region.rings().flatten().copied().collect();
    let tree = BoxTree::new(corners.iter().map(|corner| around(&[*corner])));
    let through = |ends: [DVec2; 2]| {
        let near = tree.meeting(&around(&ends).grown(width)).into_iter().map(|index| corners[index]);
        let mut stops: Vec<(f64, DVec2)> =
            near.filter_map(|corner| Some((share(corner, ends, width)?, corner))).collect();
        stops.sort_by(|a, b| a.0.total_cmp(&b.0));
        std::iter::once(ends[0]).chain(stops.into_iter().map(|(_, corner)| corner)).collect::<Vec<_>>()
    };
    let ring = |points: &[DVec2]| {
        let edges = points.iter().zip(points.iter().cycle().skip(1));
        edges.flat_map(|(a, b)| through([*a, *b])).collect::<Vec<_>>()
    };
    let smooth = Region::from_rings(region.rings().map(ring), FillRule::EvenOdd)
        .expect("a region's coordinates are finite");
    with_corners_joined(&smooth, near)
}

/// A region with the first corner in place of all that are nearer to it.
fn with_corners_joined(region: &Region, near: f64) -> Region {
    let corners: Vec<DVec2> = region.rings().flatten().copied().collect();
    let tree = BoxTree::new(corners.iter().map(|corner| around(&[*corner])));
    let first = |corner: &DVec2| {
        let others = tree.meeting(&around(&[*corner]).grown(near)).into_iter();
        others.map(|other| corners[other]).find(|other| other.distance(*corner) <= near).unwrap_or(*corner)
    };
    let rings = region.rings().map(|ring| ring.iter().map(first).collect::<Vec<_>>());
    Region::from_rings(rings, FillRule::EvenOdd).expect("a region's coordinates are finite")
}

/// Which share of the way along an edge a corner is nearest to it, where it is nearer than the width and at neither end.
fn share(corner: DVec2, [a, b]: [DVec2; 2], width: f64) -> Option<f64> {
    let (edge, arm) = (b - a, corner - a);
    let share = arm.dot(edge) / edge.length_squared();
    let is_within = share > 0.0 && share < 1.0 && corner != a && corner != b;
    (is_within && corner.distance(a + share * edge) <= width).then_some(share)
}

fn around(points: &[DVec2]) -> Extent {
    Extent::of_points(points.iter().map(|point| point.extend(0.0)))
}
