//! A target as a differential area sees it, before anything stands in between.
use super::horizon::{Loops, Vertex, above};
use super::lambert::{ContourSum, Direction};
use super::projected_vertex::{ProjectedVertex, swept};
use super::{deviation, pyramid::Pyramid};
use crate::numeric::{offset::Offset, predicates::place, rounding::ROUNDING};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use exactfloat::DoubleDouble;
use glam::DVec2;
use polycsg::{Csg, Scratch};
use std::cmp::Ordering;

/// The part of a target above dA's horizon: as loops in space and, rounded, in the two kept coordinates of its plane.
#[derive(Debug)]
pub(crate) struct View<'a> {
    pub(crate) from: &'a DifferentialArea,
    pub(crate) to: &'a PlanarPolygon,
    /// dA's distance from the target's plane, times the length of the plane's normal: positive.
    pub(crate) height: DoubleDouble,
    pub(crate) loops: Loops,
    pub(crate) flat: Vec<Vec<DVec2>>,
    /// A bound on what rounding the clip points of `flat` changes in the form factor of any part of the target.
    pub(crate) clip_error: f64,
    /// A bound on what the deviation of the target's vertices leaves open about the side on which dA lies.
    pub(crate) facing_error: f64,
    pub(crate) pyramid: Pyramid,
}

impl<'a> View<'a> {
    /// `None` when the target turns its back or lies below the horizon: decided exactly, nothing of it is seen.
    pub(crate) fn new(from: &'a DifferentialArea, to: &'a PlanarPolygon) -> Option<Self> {
        if to.plane().side_of(from.position()) != Ordering::Greater {
            return None;
        }
        let height = to.plane().side(from.position());
        let (loops, is_cut) = above(from, to);
        if loops.is_empty() {
            return None;
        }
        let projected = |v: &Vertex| ProjectedVertex::of_target(from, to, v);
        let vertices: Vec<Vec<ProjectedVertex>> =
            loops.iter().map(|l| l.iter().map(projected).collect()).collect();
        let flat: Vec<Vec<DVec2>> = vertices.iter().map(|l| l.iter().map(|v| v.flat).collect()).collect();
        let pyramid = Pyramid::over(from, to, height.value.round(), &flat);
        let clip_error = if is_cut { vertices.iter().map(|l| swept(l)).sum() } else { 0.0 };
        let facing_error = deviation::of_facing(from.position(), to);
        Some(Self { from, to, height: height.value, loops, flat, clip_error, facing_error, pyramid })
    }

    /// Lambert's sum over the target as it stands: right for a convex one.
    ///
    /// Edges on the horizon are added as such. Where dA is near the target's plane such an edge passes close to dA. Added like
    /// any other edge, its bound would be far larger than what the errors of its ends can change.
    pub(crate) fn contour(&self) -> ContourSum {
        let mut sum = ContourSum::new(self.from.normal());
        for vertices in &self.loops {
            let Some(last) = vertices.last() else { continue };
            for (a, b) in std::iter::once(last).chain(vertices).zip(vertices) {
                if self.is_on_horizon(a) && self.is_on_horizon(b) {
                    sum.add_horizon(a.direction(), b.direction());
                } else {
                    sum.add(a.direction(), b.direction());
                }
            }
        }
        sum
    }

    /// Lambert's sum over the boundary of a set of the target's plane.
    pub(crate) fn sum_over(&self, set: &Csg<'_>, scratch: &mut Scratch) -> ContourSum {
        let boundary = set.boundary(scratch);
        let mut sum = ContourSum::new(self.from.normal());
        for edge in boundary.edges() {
            sum.add(self.direction(edge.start), self.direction(edge.end));
        }
        sum
    }

    /// Whether a vertex lies on the horizon exactly: it was clipped there, or given so. Never for a target with a deviation,
    /// whose vertices stand elsewhere.
    fn is_on_horizon(&self, vertex: &Vertex) -> bool {
        let place = |i: usize| place(self.from.given_normal(), self.from.position(), self.to.points()[i]);
        self.to.deviation() == 0.0 && vertex.given.is_none_or(|i| place(i) == Ordering::Equal)
    }

    /// The direction to a point of the target's plane. It is exact for the target's own vertices, but for its own rounding; for
    /// other points it includes the error of rounding their two coordinates.
    pub(crate) fn direction(&self, flat: DVec2) -> Direction {
        let deviation = self.to.deviation();
        let given = self.to.find(flat);
        if let Some(index) = given {
            let offset = Offset::between(self.from.position(), self.to.points()[index]);
            return Vertex { offset, given, deviation, depth: DoubleDouble::ZERO }.direction();
        }
        let offset = self.to.lift(self.from.position(), flat);
        let seen = Vertex { offset, given, deviation, depth: DoubleDouble::ZERO }.direction();
        let anchor = self.to.flat(self.to.plane().corners[0]);
        // The dropped axis is the steepest: a step in a kept coordinate is at most sqrt 2 times as long in the plane.
        let step = 1.5 * ROUNDING * (flat.x.abs() + flat.y.abs());
        let slope = self.to.lift_error() * ((flat.x - anchor.x).abs() + (flat.y - anchor.y).abs());
        Direction { error: seen.error + (step + slope) / seen.toward.length(), ..seen }
    }
}
