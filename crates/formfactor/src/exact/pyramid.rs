//! The planes through dA that bound what can matter for a target: what lies outside of one is dropped unseen.
use crate::numeric::predicates::turn;
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// The planes through dA that bound what can matter for a target.
///
/// They are rounded. So they may only drop what is outside by more than their error, or cut where it is well outside of the
/// target.
#[derive(Clone, Debug)]
pub(crate) struct Pyramid {
    position: DVec3,
    /// dA's horizon; then the planes through the edges of a convex target, or the sides of its bounding rectangle.
    tight: Vec<Side>,
    /// The sides of a rectangle three times as large as the target's.
    pub(crate) walls: [Wall; 4],
    /// The near side of the target's plane, and a point of it.
    near: Side,
    anchor: DVec3,
    /// The box around the target and dA: planes reach far where dA is hardly before the target's plane.
    extent: Extent,
    /// The rectangle into which rounded projections are kept, five times as large.
    pub(crate) bounds: [DVec2; 2],
}

/// The plane through dA and the line of the target's plane where a kept coordinate is `bound`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    pub(crate) axis: usize,
    pub(crate) bound: f64,
    pub(crate) is_upper: bool,
    /// The same, rounded.
    pub(crate) side: Side,
}

/// A half-space through some origin: its inward normal, and the sums of magnitudes that the normal's components are
/// rounded from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    normal: DVec3,
    terms: DVec3,
}

impl Side {
    fn of(normal: DVec3) -> Self {
        Self { normal, terms: normal.abs() }
    }

    /// Through dA and the edge from `a` to `b` of a target that is to its left.
    fn through(a: DVec3, b: DVec3) -> Self {
        let (p, q) = (a.abs(), b.abs());
        let terms = DVec3::new(p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x);
        Self { normal: b.cross(a), terms }
    }

    /// On which side an offset from the origin lies; `Equal` when rounding leaves it open, or when it lies within
    /// `deviation` of the plane. 1e-13 of the terms is far more than the few roundings that they take.
    pub(crate) fn of_offset(&self, offset: DVec3, deviation: f64) -> Ordering {
        let (height, size) = (self.normal.dot(offset), offset.abs() + DVec3::splat(deviation * 1e13));
        if height.abs() <= 1e-13 * self.terms.dot(size) { Ordering::Equal } else { height.total_cmp(&0.0) }
    }

    /// Whether the whole box between two offsets is outside: its innermost corner is, by the largest error of any.
    fn excludes_box(&self, low: DVec3, high: DVec3, deviation: f64) -> bool {
        let innermost = (self.normal * low).max(self.normal * high).element_sum();
        let size = low.abs().max(high.abs()) + DVec3::splat(deviation * 1e13);
        innermost < -1e-13 * self.terms.dot(size)
    }
}

impl Pyramid {
    pub(crate) fn over(
        from: &DifferentialArea,
        to: &PlanarPolygon,
        eye: DVec3,
        height: f64,
        flat: &[Vec<DVec2>],
    ) -> Self {
        let points = flat.iter().flatten().copied();
        let low = points.clone().reduce(DVec2::min).unwrap_or_default();
        let high = points.reduce(DVec2::max).unwrap_or_default();
        let size = DVec2::splat((high - low).max_element());
        let (position, normal) = (from.position(), to.plane().normal.round());
        let walls = |low: DVec2, high: DVec2| walls(eye, to.axes(), -normal, height, low, high);
        let mut tight = vec![Side::of(from.normal())];
        if has_few_edges(to) {
            tight.extend(to.edges().map(|(a, b)| Side::through(a - position, b - position)));
        } else {
            tight.extend(walls(low, high).map(|wall| wall.side));
        }
        Self {
            position,
            tight,
            walls: walls(low - size, high + size),
            near: Side::of(normal),
            anchor: to.plane().corners[0],
            extent: Extent::around(to.points()).with(Extent::around(&[position])),
            bounds: [low - 2.0 * size, high + 2.0 * size],
        }
    }

    /// Whether a polygon lies wholly below the horizon, outside one side, behind the target, or beside it and dA, for certain.
    pub(crate) fn misses(&self, polygon: &PlanarPolygon, deviation: f64) -> bool {
        let outside = |side: &Side, origin: DVec3| {
            polygon.points().iter().all(|p| side.of_offset(*p - origin, deviation) == Ordering::Less)
        };
        self.extent.is_beside(&Extent::around(polygon.points()), deviation)
            || outside(&self.near, self.anchor)
            || self.tight.iter().any(|side| outside(side, self.position))
    }

    /// Whether everything in a box is outside for certain.
    pub(crate) fn misses_box(&self, extent: &Extent, deviation: f64) -> bool {
        let outside = |side: &Side, origin: DVec3| {
            side.excludes_box(extent.low - origin, extent.high - origin, deviation)
        };
        self.extent.is_beside(extent, deviation)
            || outside(&self.near, self.anchor)
            || self.tight.iter().any(|side| outside(side, self.position))
    }

    /// An edge of a convex target which `polygon` touches from outside, at most: by exact decision, but for `deviation`.
    pub(crate) fn touched_edge(
        &self,
        to: &PlanarPolygon,
        polygon: &PlanarPolygon,
        deviation: f64,
    ) -> Option<(DVec3, DVec3)> {
        if !has_few_edges(to) {
            return None;
        }
        let points = || polygon.points().iter().copied();
        let place = |side: &Side, p: DVec3| side.of_offset(p - self.position, deviation);
        let outside = |side: &Side, a: DVec3, b: DVec3, p: DVec3| {
            place(side, p) == Ordering::Less
                || p == a
                || p == b
                || turn(self.position, a, b, p) != Ordering::Less
        };
        let mut candidates = self.tight[1..].iter().zip(to.edges());
        let found = candidates.find(|(side, (a, b))| {
            // The cheap test first.
            points().all(|p| place(side, p) != Ordering::Greater)
                && points().all(|p| outside(side, *a, *b, p))
        });
        found.map(|(_, edge)| edge)
    }
}

/// Whether planes through the edges are worth their cost.
fn has_few_edges(polygon: &PlanarPolygon) -> bool {
    polygon.is_convex() && polygon.points().len() <= 8
}

/// The planes u >= low.x, u <= high.x, and so for v, seen from `eye`: a point W before the target's plane is
/// projected to u = O_u + W_u H / (outward . W).
fn walls(
    eye: DVec3,
    [u, v, _]: [usize; 3],
    outward: DVec3,
    height: f64,
    low: DVec2,
    high: DVec2,
) -> [Wall; 4] {
    let wall = |axis: usize, bound: f64, is_upper: bool| {
        let (along, across) = (height * DVec3::AXES[axis], (bound - eye[axis]) * outward);
        let normal = if is_upper { across - along } else { along - across };
        Wall { axis, bound, is_upper, side: Side { normal, terms: along.abs() + across.abs() } }
    };
    [wall(u, low.x, false), wall(u, high.x, true), wall(v, low.y, false), wall(v, high.y, true)]
}
