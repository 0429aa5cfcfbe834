//! Which polygons can block: the target's pyramid, facing, total cover. What is not needed is not done.
use crate::PlanarPolygon;
use crate::predicates::turn;
use crate::view::View;
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// The four planes through dA and the sides of a rectangle around the target, in the plane's kept coordinates.
///
/// The planes are rounded: they may only drop what they say to be outside by more than their error, or cut what lies
/// well outside of the target.
#[derive(Clone, Debug)]
pub(crate) struct Pyramid {
    position: DVec3,
    /// The sides of the target's bounding rectangle.
    tight: [Side; 4],
    /// The sides of a rectangle three times as large.
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
    /// Whether an offset from the origin is outside by more than rounding can pretend: 1e-13 of the terms is far more
    /// than the few roundings that they take.
    fn excludes(&self, offset: DVec3) -> bool {
        self.normal.dot(offset) < -1e-13 * self.terms.dot(offset.abs())
    }
}

impl Pyramid {
    pub(crate) fn over(position: DVec3, to: &PlanarPolygon, height: f64, flat: &[Vec<DVec2>]) -> Self {
        let points = flat.iter().flatten().copied();
        let low = points.clone().reduce(DVec2::min).unwrap_or_default();
        let high = points.reduce(DVec2::max).unwrap_or_default();
        let size = DVec2::splat((high - low).max_element());
        let normal = to.plane().normal.round();
        let sides = |low: DVec2, high: DVec2| sides(position, to.axes(), -normal, height, low, high);
        Self {
            position,
            tight: sides(low, high),
            wide: sides(low - size, high + size),
            near: Side { normal, terms: normal.abs() },
            anchor: to.plane().corners[0],
            bounds: [low - 2.0 * size, high + 2.0 * size],
        }
    }

    /// Whether `polygon` lies wholly outside one side of the pyramid or behind the target, for certain.
    pub(crate) fn misses(&self, polygon: &PlanarPolygon) -> bool {
        let outside =
            |side: &Side, origin: DVec3| polygon.points().iter().all(|p| side.excludes(*p - origin));
        self.tight.iter().any(|side| outside(side, self.position)) || outside(&self.near, self.anchor)
    }
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Blocking {
    /// Nothing, for certain.
    None,
    /// Something, perhaps.
    Partial,
    /// All of it: decided exactly.
    Total,
}

/// What `occluder` can hide of the target.
///
/// Coplanar with dA or with the target, or behind the target's plane, it hides nothing: decided exactly.
pub(crate) fn blocking(view: &View, occluder: &PlanarPolygon) -> Blocking {
    if view.pyramid.misses(occluder) {
        return Blocking::None;
    }
    let facing = occluder.plane().side(view.from.position()).sign;
    let mut sides = occluder.points().iter().map(|p| view.to.plane().side(*p).sign);
    if facing == Ordering::Equal || sides.clone().all(|s| s != Ordering::Greater) {
        return Blocking::None;
    }
    let before = sides.all(|s| s != Ordering::Less);
    if before
        && occluder.is_convex()
        && occluder.deviation() + view.to.deviation() == 0.0
        && covers(view, occluder, facing)
    {
        return Blocking::Total;
    }
    Blocking::Partial
}

/// Whether every vertex of the target lies in the cone of dA over a convex occluder before the target's plane.
fn covers(view: &View, occluder: &PlanarPolygon, facing: Ordering) -> bool {
    let (origin, corners) = (view.from.position(), occluder.points());
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let mut edges = edges.filter(|(a, b)| a != b);
    // Seen from its front a loop is counter-clockwise, so that its cone's inside is to the right of a x b.
    edges.all(|(a, b)| view.to.points().iter().all(|p| turn(origin, *a, *b, *p) != facing))
}
