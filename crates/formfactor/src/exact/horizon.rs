//! Clipping to dA's horizon, and clipping of loops by any plane.
use super::lambert::Direction;
use crate::numeric::offset::Offset;
use crate::numeric::predicates::{over_horizon, place};
use crate::numeric::rounding::{ROUNDING, SMALLEST};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use exactfloat::DoubleDouble;
use glam::DVec3;
use std::cmp::Ordering;

/// A vertex as seen from dA.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vertex {
    pub(crate) offset: Offset,
    /// Its index among the polygon's points, `None` for a point that was found on an edge.
    pub(crate) given: Option<usize>,
    /// How far it may lie from where it stands, once the polygon is moved onto its plane.
    pub(crate) deviation: f64,
    /// Whether it lies on the horizon exactly: it was clipped there, or given so. Never with a deviation.
    pub(crate) is_on_horizon: bool,
    /// For an occluder's vertex, its distance from dA toward the target's plane, in the unit of the view's `height`.
    pub(crate) depth: DoubleDouble,
}

/// A point of an edge is within 2^-98 of the lengths of the edge's ends: more than what an offset's arithmetic takes.
const ON_EDGE: f64 = 3.155_443_620_884_047e-30;

/// Shorter directions are scaled up, before their squares underflow.
const SHORT: f64 = 1e-100;

impl Vertex {
    /// The direction to it, rounded to doubles, of a length that can be squared.
    pub(crate) fn direction(&self) -> Direction {
        let toward = self.offset.round();
        let lost: f64 = self.offset.0.iter().map(|x| (x.hi - x.round() + x.lo).abs()).sum();
        let error = (lost + self.deviation) / toward.length() * (1.0 + 8.0 * ROUNDING);
        if toward.abs().max_element() >= SHORT {
            return Direction { toward, error };
        }
        // By powers of two, which round nothing that matters.
        let mut longer = toward;
        while longer.abs().max_element() < SHORT && longer != DVec3::ZERO {
            longer /= SMALLEST;
        }
        Direction { toward: longer, error: (lost + self.deviation) / toward.abs().max_element() }
    }

    /// The point at `share` of the way to `other`.
    pub(crate) fn toward(&self, other: &Self, share: DoubleDouble) -> Self {
        let reach = [self, other].map(|v| v.offset.round().length()).iter().sum::<f64>();
        Self {
            offset: self.offset.toward(other.offset, share),
            given: None,
            deviation: self.deviation.max(other.deviation) + ON_EDGE * reach,
            is_on_horizon: self.is_on_horizon && other.is_on_horizon,
            depth: self.depth + share * (other.depth - self.depth),
        }
    }
}

/// Loops of vertices as seen from dA.
pub(crate) type Loops = Vec<Vec<Vertex>>;

/// The loops of a polygon as seen from dA, unclipped.
pub(crate) fn seen(from: &DifferentialArea, polygon: &PlanarPolygon) -> Loops {
    let mut index = 0..polygon.points().len();
    let mut vertex = |p: &DVec3| Vertex {
        offset: Offset::between(from.position(), *p),
        given: index.next(),
        deviation: polygon.deviation(),
        is_on_horizon: false,
        depth: DoubleDouble::ZERO,
    };
    polygon.loops().map(|l| l.iter().map(&mut vertex).collect()).collect()
}

/// The part of `polygon` that is not below dA's horizon.
pub(crate) fn above(from: &DifferentialArea, polygon: &PlanarPolygon) -> Loops {
    let (normal, position) = (from.given_normal(), from.position());
    let places: Vec<Ordering> = polygon.points().iter().map(|p| place(normal, position, *p)).collect();
    let mut loops = seen(from, polygon);
    if polygon.deviation() == 0.0 {
        let level = loops.iter_mut().flatten().zip(&places).filter(|(_, place)| place.is_eq());
        level.for_each(|(vertex, _)| vertex.is_on_horizon = true);
    }
    if !places.contains(&Ordering::Less) {
        return loops;
    }
    if !places.contains(&Ordering::Greater) {
        return Vec::new();
    }
    // Nothing was clipped yet: every vertex is a given one.
    let place = |v: &Vertex| v.given.map_or(Ordering::Equal, |i| places[i]);
    let height = |i: usize| over_horizon(normal, position, polygon.points()[i]).into();
    let mut loops = clip(&loops, place, |v| v.given.map_or(LEVEL, height));
    let cuts = loops.iter_mut().flatten().filter(|v| v.given.is_none());
    cuts.for_each(|v| v.is_on_horizon = polygon.deviation() == 0.0);
    loops
}

/// A height over some plane, and a bound on its error.
pub(crate) type Measured = (DoubleDouble, f64);

/// The height of what was clipped at the plane.
pub(crate) const LEVEL: Measured = (DoubleDouble::ZERO, 0.0);

/// The part of loops that is not on the lower side of a plane (Sutherland and Hodgman). `place` says where a vertex lies,
/// `height` how far from the plane in some measure, with the same sign.
///
/// The new end of a cut edge is a function of its inner and its outer vertex, whatever the direction of the edge: shared edges
/// stay shared.
///
/// ```text
///    b---c   f---g            A loop that is not convex keeps pieces along the cut that run there and back: the result
///    |   |   |   |            here is p b c q r f g s, with the piece from q to r, and the one from s to p over it. An
/// ---p---q---r---s--- plane   even-odd rule and a contour sum do not see them.
///    |   d---e   |
///    a-----------h
/// ```
pub(crate) fn clip(
    loops: &Loops,
    place: impl Fn(&Vertex) -> Ordering,
    height: impl Fn(&Vertex) -> Measured,
) -> Loops {
    let kept = loops.iter().map(|l| clip_loop(l, &place, &height));
    kept.filter(|l| l.len() > 2).collect()
}

fn clip_loop(
    vertices: &[Vertex],
    place: impl Fn(&Vertex) -> Ordering,
    height: impl Fn(&Vertex) -> Measured,
) -> Vec<Vertex> {
    let mut kept = Vec::with_capacity(vertices.len() + 2);
    let Some(last) = vertices.last() else { return kept };
    let (mut before, mut there) = (last, place(last));
    for vertex in vertices {
        let here = place(vertex);
        match (there, here) {
            (Ordering::Less, Ordering::Greater) => kept.push(cut(vertex, before, &height)),
            (Ordering::Greater, Ordering::Less) => kept.push(cut(before, vertex, &height)),
            _ => (),
        }
        if here != Ordering::Less {
            kept.push(*vertex);
        }
        (before, there) = (vertex, here);
    }
    kept
}

/// The point of an edge where its height is zero.
fn cut(inner: &Vertex, outer: &Vertex, height: impl Fn(&Vertex) -> Measured) -> Vertex {
    let ((above, above_error), (below, below_error)) = (height(inner), height(outer));
    let across = above - below;
    let mut cut = inner.toward(outer, above / across);
    // Both errors move it along the edge, by a little more than this where they are small against the heights.
    cut.deviation +=
        2.0 * (above_error + below_error) / across.hi * inner.offset.to(outer.offset).round().length();
    cut
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two polygons on either side of an edge that passes the horizon: both are cut there in the same bits.
    #[test]
    fn a_shared_edge_is_cut_in_one_point() {
        let from = DifferentialArea::new(DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.3, -0.7, 0.6))
            .expect("a direction");
        for i in 1..40 {
            let step = f64::from(i) / 7.0;
            let (a, b) = (DVec3::new(step, -1.3 - step, 1.1), DVec3::new(1.7, 2.1 + step, -0.9 / step));
            let left = PlanarPolygon::new([[a, b, DVec3::new(-3.0, step, 4.0)]]).expect("a triangle");
            let right = PlanarPolygon::new([[b, a, DVec3::new(5.0, -step, 0.1)]]).expect("a triangle");
            let cuts = |polygon: &PlanarPolygon| {
                let loops = above(&from, polygon).concat();
                let bits = |v: Vertex| v.offset.0.map(|x| [x.hi.to_bits(), x.lo.to_bits()]);
                loops.into_iter().filter(|v| v.given.is_none()).map(bits).collect::<Vec<_>>()
            };
            let (left, right) = (cuts(&left), cuts(&right));
            assert!(
                left.len() == 2 && left.iter().any(|cut| right.contains(cut)),
                "{a} {b}: {left:?} {right:?}"
            );
        }
    }
}
