//! Shafts: the polygons that can stand between two sets of points meet the convex hull of both.
use crate::numeric::predicates::turn;
use crate::shapes::{extent::Extent, polygon::PlanarPolygon};
use glam::DVec3;
use std::cmp::Ordering;

/// More planes than this are not tried.
const MOST: usize = 4096;

/// The convex hull of two sets of points, as far as planes through an edge of one and a vertex of the other bound it, and
/// the box around it.
#[derive(Clone, Debug)]
pub(crate) struct Shaft {
    extent: Extent,
    /// Three points of each plane, and the side of it on which the hull is not.
    planes: Vec<([DVec3; 3], Ordering)>,
}

impl Shaft {
    /// The shaft between points and a polygon. When the points are few, all pairs of them count as edges.
    pub(crate) fn between(points: &[DVec3], to: &PlanarPolygon) -> Self {
        let all: Vec<DVec3> = points.iter().chain(to.points()).copied().collect();
        let extent = Extent::around(&all);
        let mut planes = Vec::new();
        if points.len().pow(2) * to.points().len() * all.len() <= MOST {
            let pairs =
                points.iter().enumerate().flat_map(|(i, a)| points[..i].iter().map(move |b| (*a, *b)));
            planes.extend(pairs.flat_map(|edge| bounding(edge, to.points(), &all)));
            planes.extend(to.edges().flat_map(|edge| bounding(edge, points, &all)));
        }
        Self { extent, planes }
    }

    /// Whether a box is wholly outside, its polygons lying off their vertices by `deviation`.
    pub(crate) fn misses_box(&self, extent: &Extent, deviation: f64) -> bool {
        extent.low.cmpgt(self.extent.high + deviation).any()
            || extent.high.cmplt(self.extent.low - deviation).any()
    }

    /// Whether a polygon is outside of the hull, touching allowed.
    pub(crate) fn misses(&self, polygon: &PlanarPolygon) -> bool {
        let is_out = |([a, b, c], outer): &([DVec3; 3], Ordering)| {
            polygon.points().iter().all(|p| turn(*a, *b, *c, *p) != outer.reverse())
        };
        polygon.deviation() == 0.0 && self.planes.iter().any(is_out)
    }
}

/// The planes through an edge and one of the points that have all points on one side.
fn bounding<'a>(
    (a, b): (DVec3, DVec3),
    points: &'a [DVec3],
    all: &'a [DVec3],
) -> impl Iterator<Item = ([DVec3; 3], Ordering)> + 'a {
    points.iter().filter_map(move |c| {
        let mut side = Ordering::Equal;
        for point in all {
            let here = turn(a, b, *c, *point);
            if here != Ordering::Equal && side == here.reverse() {
                return None;
            }
            side = side.then(here);
        }
        (side != Ordering::Equal).then_some(([a, b, *c], side.reverse()))
    })
}
