//! A target as a differential area sees it, before anything stands in between.
use super::halves::halved;
use super::horizon::{Loops, Vertex, above};
use super::lambert::{ContourSum, Direction};
use super::projected_vertex::{ProjectedVertex, swept};
use super::{deviation, pyramid::Pyramid};
use crate::numeric::rounding::ROUNDING;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use exactfloat::DoubleDouble;
use glam::{DVec2, DVec3};
use polycsg::{Csg, Scratch};
use std::cmp::Ordering;

/// The part of a target above dA's horizon: as loops in space and, rounded, in the two kept coordinates of its plane.
#[derive(Debug)]
pub(crate) struct View<'a> {
    pub(crate) from: &'a DifferentialArea,
    pub(crate) to: &'a PlanarPolygon,
    /// Where dA lies in the coordinates of `flat`: where it is, or at 0 so that what is near it keeps all its digits.
    pub(crate) eye: DVec3,
    /// dA's distance from the target's plane, times the length of the plane's normal: positive.
    pub(crate) height: DoubleDouble,
    pub(crate) loops: Loops,
    pub(crate) flat: Vec<Vec<DVec2>>,
    /// A bound on what rounding the vertices of `flat` changes in the form factor of any part of the target.
    pub(crate) flat_error: f64,
    /// A bound on what the deviation of the target's vertices leaves open about the side on which dA lies.
    pub(crate) facing_error: f64,
    pub(crate) pyramid: Pyramid,
}

impl<'a> View<'a> {
    /// The target in coordinates relative to dA, in which a Boolean rounds directions by no more than a few roundings.
    ///
    /// `None` when the target turns its back or lies below the horizon: decided exactly, nothing of it is seen.
    pub(crate) fn new(from: &'a DifferentialArea, to: &'a PlanarPolygon) -> Option<Self> {
        Self::with_eye(from, to, DVec3::ZERO)
    }

    /// The target in its own coordinates, in which its vertices keep their bits.
    pub(crate) fn in_place(from: &'a DifferentialArea, to: &'a PlanarPolygon) -> Option<Self> {
        Self::with_eye(from, to, from.position())
    }

    fn with_eye(from: &'a DifferentialArea, to: &'a PlanarPolygon, eye: DVec3) -> Option<Self> {
        if to.plane().side_of(from.position()) != Ordering::Greater {
            return None;
        }
        let height = to.plane().side(from.position());
        let loops = above(from, to);
        if loops.is_empty() {
            return None;
        }
        let loops = halved(loops);
        let projected = |v: &Vertex| ProjectedVertex::of_target(from, to, eye, v);
        let vertices: Vec<Vec<ProjectedVertex>> =
            loops.iter().map(|l| l.iter().map(projected).collect()).collect();
        let flat: Vec<Vec<DVec2>> = vertices.iter().map(|l| l.iter().map(|v| v.flat).collect()).collect();
        let pyramid = Pyramid::over(from, to, eye, height.value.round(), &flat);
        let is_given = eye == from.position() && loops.iter().flatten().all(|v| v.given.is_some());
        let flat_error = if is_given { 0.0 } else { vertices.iter().map(|l| swept(l)).sum() };
        let facing_error = deviation::of_facing(from.position(), to);
        Some(Self { from, to, eye, height: height.value, loops, flat, flat_error, facing_error, pyramid })
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
                if a.is_on_horizon && b.is_on_horizon {
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

    /// The two kept coordinates of a point of the target's plane.
    pub(crate) fn flat_of(&self, point: DVec3) -> DVec2 {
        if self.eye == self.from.position() {
            return self.to.flat(point);
        }
        self.to.flat(point - self.from.position())
    }

    /// The direction to a point of the target's plane, with the error of rounding its two coordinates.
    pub(crate) fn direction(&self, flat: DVec2) -> Direction {
        let lifted = self.to.lift(self.from.position(), self.eye, flat);
        let (offset, deviation) = (lifted.offset, self.to.deviation());
        let seen = Vertex { offset, given: None, deviation, is_on_horizon: false, depth: DoubleDouble::ZERO }
            .direction();
        // The dropped axis is the steepest: a step in a kept coordinate is at most sqrt 2 times as long in the plane.
        let step = 1.5 * ROUNDING * (flat.x.abs() + flat.y.abs());
        Direction { error: seen.error + (step + lifted.error) / seen.toward.length(), ..seen }
    }
}
