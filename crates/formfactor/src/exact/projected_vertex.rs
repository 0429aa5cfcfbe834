//! Vertices put on the target's plane, and how far that turns the direction to them.
use super::horizon::Vertex;
use super::lambert::{self, Arc, Direction};
use crate::numeric::rounding::ROUNDING;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use exactfloat::DoubleDouble;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// A vertex put on the target's plane: its rounded coordinates, and the direction to it with the error that this brought.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProjectedVertex {
    pub(crate) flat: DVec2,
    direction: Direction,
}

impl ProjectedVertex {
    /// A vertex of the target, or of an edge of it that was cut: its two kept coordinates rounded.
    pub(crate) fn of_target(
        from: &DifferentialArea,
        to: &PlanarPolygon,
        eye: DVec3,
        vertex: &Vertex,
    ) -> Self {
        if let Some(index) = vertex.given.filter(|_| eye == from.position()) {
            return Self { flat: to.flat(to.points()[index]), direction: vertex.direction() };
        }
        let [u, v, _] = to.axes();
        let flat = [u, v].map(|axis| (DoubleDouble::from(eye[axis]) + vertex.offset.0[axis]).round());
        Self::measured(from, to, eye, flat.into(), vertex)
    }

    /// The vertex put at `flat`. Its error is measured: the angle between the directions to where it was put and to where
    /// it stands.
    pub(crate) fn measured(
        from: &DifferentialArea,
        to: &PlanarPolygon,
        eye: DVec3,
        flat: DVec2,
        vertex: &Vertex,
    ) -> Self {
        let lifted = to.lift(from.position(), eye, flat);
        let (toward, put) = (vertex.offset.round(), lifted.offset.round());
        let off =
            Arc::between(Direction { toward, error: 0.0 }, Direction { toward: put, error: 0.0 }).angle();
        let error = off * (1.0 + 16.0 * ROUNDING)
            + 4.0 * ROUNDING
            + lifted.error / put.length()
            + vertex.deviation / toward.length();
        // NaN comes of a vertex put at dA itself: it may be anywhere.
        Self { flat, direction: Direction { toward, error: if error <= PI { error } else { PI } } }
    }
}

/// A bound on the form factor of what the edges of a loop sweep when its vertices move to where they stand.
pub(crate) fn swept(vertices: &[ProjectedVertex]) -> f64 {
    let Some(last) = vertices.last() else { return 0.0 };
    let edges = std::iter::once(last).chain(vertices).zip(vertices);
    edges.map(|(a, b)| lambert::swept(a.direction, b.direction)).sum()
}
