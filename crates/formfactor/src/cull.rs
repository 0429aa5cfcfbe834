//! Which polygons can block: the target's pyramid, facing, total cover. What is not needed is not done.
use crate::lambert::{Arc, Sight};
use crate::predicates::turn;
use crate::view::View;
use crate::{DifferentialArea, PlanarPolygon};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// The planes through dA that bound what can matter for a target.
///
/// They are rounded: they may only drop what they say to be outside by more than their error, or cut what lies well
/// outside of the target.
#[derive(Clone, Debug)]
pub(crate) struct Pyramid {
    position: DVec3,
    /// dA's horizon; then the planes through the edges of a convex target, or the sides of its bounding rectangle.
    tight: Vec<Side>,
    /// The sides of a rectangle three times as large as the target's.
    pub(crate) wide: [Side; 4],
    /// The near side of the target's plane, and a point of it.
    near: Side,
    anchor: DVec3,
    /// The rectangle into which rounded projections are kept, five times as large.
    pub(crate) bounds: [DVec2; 2],
}

/// A half-space through some origin: its inward normal, and the sums of magnitudes that the normal's components are
/// rounded from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) normal: DVec3,
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
    /// `slack` of the plane. 1e-13 of the terms is far more than the few roundings that they take.
    fn of_offset(&self, offset: DVec3, slack: f64) -> Ordering {
        let (height, size) = (self.normal.dot(offset), offset.abs() + DVec3::splat(slack * 1e13));
        if height.abs() <= 1e-13 * self.terms.dot(size) { Ordering::Equal } else { height.total_cmp(&0.0) }
    }
}

impl Pyramid {
    pub(crate) fn over(
        from: &DifferentialArea,
        to: &PlanarPolygon,
        height: f64,
        flat: &[Vec<DVec2>],
    ) -> Self {
        let points = flat.iter().flatten().copied();
        let low = points.clone().reduce(DVec2::min).unwrap_or_default();
        let high = points.reduce(DVec2::max).unwrap_or_default();
        let size = DVec2::splat((high - low).max_element());
        let (position, normal) = (from.position(), to.plane().normal.round());
        let sides = |low: DVec2, high: DVec2| sides(position, to.axes(), -normal, height, low, high);
        let mut tight = vec![Side::of(from.normal())];
        if to.is_convex() {
            tight.extend(edges(to).map(|(a, b)| Side::through(a - position, b - position)));
        } else {
            tight.extend(sides(low, high));
        }
        Self {
            position,
            tight,
            wide: sides(low - size, high + size),
            near: Side::of(normal),
            anchor: to.plane().corners[0],
            bounds: [low - 2.0 * size, high + 2.0 * size],
        }
    }

    /// Whether a polygon lies wholly below the horizon, outside one side, or behind the target, for certain.
    fn misses(&self, polygon: &PlanarPolygon, slack: f64) -> bool {
        let outside = |side: &Side, origin: DVec3| {
            polygon.points().iter().all(|p| side.of_offset(*p - origin, slack) == Ordering::Less)
        };
        self.tight.iter().any(|side| outside(side, self.position)) || outside(&self.near, self.anchor)
    }

    /// An edge of a convex target which `polygon` touches from outside, at most: by exact decision, but for `slack`.
    fn touched_edge(
        &self,
        to: &PlanarPolygon,
        polygon: &PlanarPolygon,
        slack: f64,
    ) -> Option<(DVec3, DVec3)> {
        let outside =
            |side: &Side, a: DVec3, b: DVec3, p: DVec3| match side.of_offset(p - self.position, slack) {
                Ordering::Less => true,
                Ordering::Equal => p == a || p == b || turn(self.position, a, b, p) != Ordering::Less,
                Ordering::Greater => false,
            };
        let mut candidates = self.tight[1..].iter().zip(edges(to));
        let found =
            candidates.find(|(side, (a, b))| polygon.points().iter().all(|p| outside(side, *a, *b, *p)));
        found.map(|(_, edge)| edge)
    }
}

/// The edges of a polygon of one loop.
fn edges(polygon: &PlanarPolygon) -> impl Iterator<Item = (DVec3, DVec3)> {
    let points = polygon.points();
    points.iter().copied().zip(points.iter().copied().cycle().skip(1)).filter(|(a, b)| a != b)
}

/// The half-spaces u >= low.x, u <= high.x, and so for v, seen from `position`: a point W before the target's plane is
/// projected to u = O_u + W_u H / (outward . W).
fn sides(
    position: DVec3,
    [u, v, _]: [usize; 3],
    outward: DVec3,
    height: f64,
    low: DVec2,
    high: DVec2,
) -> [Side; 4] {
    let side = |axis: usize, bound: f64, sign: f64| {
        let (along, across) = (height * DVec3::AXES[axis], (bound - position[axis]) * outward);
        Side { normal: sign * (along - across), terms: along.abs() + across.abs() }
    };
    [side(u, low.x, 1.0), side(u, high.x, -1.0), side(v, low.y, 1.0), side(v, high.y, -1.0)]
}

/// What a polygon can hide of a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Blocking {
    /// Nothing; rounding of vertices that are not exactly coplanar leaves at most this form factor open.
    None { doubt: f64 },
    /// Something, perhaps.
    Partial,
    /// All of it: decided exactly.
    Total,
}

/// What `occluder` can hide of the target.
///
/// Coplanar with dA or with the target, behind the target's plane, or outside of one of a convex target's edges, it hides
/// nothing: decided exactly, touching included.
pub(crate) fn blocking(view: &View, occluder: &PlanarPolygon) -> Blocking {
    const NOTHING: Blocking = Blocking::None { doubt: 0.0 };
    let slack = occluder.deviation() + view.to.deviation();
    if view.pyramid.misses(occluder, slack) {
        return NOTHING;
    }
    let facing = occluder.plane().side(view.from.position()).sign;
    let mut sides = occluder.points().iter().map(|p| view.to.plane().side(*p).sign);
    if facing == Ordering::Equal || sides.clone().all(|s| s != Ordering::Greater) {
        return NOTHING;
    }
    if view.to.is_convex() {
        if let Some((a, b)) = view.pyramid.touched_edge(view.to, occluder, slack) {
            return Blocking::None { doubt: doubt_along(view.from.position(), a, b, occluder, slack) };
        }
    }
    let before = sides.all(|s| s != Ordering::Less);
    if before && slack == 0.0 && occluder.is_convex() && covers(view, occluder, facing) {
        return Blocking::Total;
    }
    Blocking::Partial
}

/// A bound on what a polygon that touches the plane of dA and the edge from `a` to `b` hides when its vertices, and the
/// edge, move by `slack`: the form factor of a band along the edge.
fn doubt_along(position: DVec3, a: DVec3, b: DVec3, polygon: &PlanarPolygon, slack: f64) -> f64 {
    let nearest =
        polygon.points().iter().chain([&a, &b]).map(|p| p.distance(position)).fold(f64::INFINITY, f64::min);
    let sight = |p: DVec3| Sight { toward: p - position, blur: 0.0 };
    Arc::between(sight(a), sight(b)).swept(4.0 * slack / nearest)
}

/// Whether every vertex of the target lies in the cone of dA over a convex occluder before the target's plane.
fn covers(view: &View, occluder: &PlanarPolygon, facing: Ordering) -> bool {
    let origin = view.from.position();
    // Seen from its front a loop is counter-clockwise, so that its cone's inside is to the right of a x b.
    edges(occluder).all(|(a, b)| view.to.points().iter().all(|p| turn(origin, a, b, *p) != facing))
}
