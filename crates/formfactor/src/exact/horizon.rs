//! Clipping to dA's horizon, and clipping of loops by any plane.
use super::lambert::Direction;
use crate::numeric::offset::Offset;
use crate::numeric::predicates::{over_horizon, place};
use crate::numeric::rounding::{ROUNDING, SMALLEST};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use exactfloat::DoubleDouble;
use glam::DVec3;
use std::cmp::Ordering;

/// A vertex as seen from dA. A clip point lies on its edge within 2^-98 of the lengths of the edge's ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vertex {
    pub(crate) offset: Offset,
    /// Its index among the polygon's points, `None` for a clip point.
    pub(crate) given: Option<usize>,
    /// How far it may lie from where it stands, once the polygon is moved onto its plane.
    pub(crate) deviation: f64,
    /// For an occluder's vertex, its distance from dA toward the target's plane, in the unit of the view's `height`.
    pub(crate) depth: DoubleDouble,
}

/// Shorter directions are scaled up, before their squares underflow.
const SHORT: f64 = 1e-100;

impl Vertex {
    /// The direction to it, rounded to doubles, of a length that can be squared.
    pub(crate) fn direction(&self) -> Direction {
        let toward = self.offset.round();
        let lost: f64 = self.offset.0.iter().map(|x| (x.hi - x.round() + x.lo).abs()).sum();
        let error = (lost + self.deviation) / toward.length() * (1.0 + 8.0 * ROUNDING);
        // A clip point is within 2^-98 of its edge by the lengths of the ends; 2^-96 leaves room for points nearer than those.
        let clipped = if self.given.is_none() { ROUNDING * ROUNDING * 1024.0 } else { 0.0 };
        if toward.abs().max_element() >= SHORT {
            return Direction { toward, error: error + clipped };
        }
        // By powers of two, which round nothing that matters.
        let mut longer = toward;
        while longer.abs().max_element() < SHORT && longer != DVec3::ZERO {
            longer /= SMALLEST;
        }
        Direction { toward: longer, error: (lost + self.deviation) / toward.abs().max_element() + clipped }
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
        depth: DoubleDouble::ZERO,
    };
    polygon.loops().map(|l| l.iter().map(&mut vertex).collect()).collect()
}

/// The part of `polygon` that is not below dA's horizon, and whether anything was cut off.
pub(crate) fn above(from: &DifferentialArea, polygon: &PlanarPolygon) -> (Loops, bool) {
    let (normal, position) = (from.given_normal(), from.position());
    let places: Vec<Ordering> = polygon.points().iter().map(|p| place(normal, position, *p)).collect();
    let loops = seen(from, polygon);
    if !places.contains(&Ordering::Less) {
        return (loops, false);
    }
    if !places.contains(&Ordering::Greater) {
        return (Vec::new(), true);
    }
    // Nothing was clipped yet: every vertex is a given one.
    let place = |v: &Vertex| v.given.map_or(Ordering::Equal, |i| places[i]);
    let height = |i: usize| over_horizon(normal, position, polygon.points()[i]).value;
    (clip(&loops, place, |v| v.given.map_or(DoubleDouble::ZERO, height)), true)
}

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
    height: impl Fn(&Vertex) -> DoubleDouble,
) -> Loops {
    let kept = loops.iter().map(|l| clip_loop(l, &place, &height));
    kept.filter(|l| l.len() > 2).collect()
}

fn clip_loop(
    vertices: &[Vertex],
    place: impl Fn(&Vertex) -> Ordering,
    height: impl Fn(&Vertex) -> DoubleDouble,
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
fn cut(inner: &Vertex, outer: &Vertex, height: impl Fn(&Vertex) -> DoubleDouble) -> Vertex {
    let (above, below) = (height(inner), height(outer));
    let share = above / (above - below);
    Vertex {
        offset: inner.offset.toward(outer.offset, share),
        given: None,
        deviation: inner.deviation.max(outer.deviation),
        depth: inner.depth + share * (outer.depth - inner.depth),
    }
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
                let loops = above(&from, polygon).0.concat();
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
