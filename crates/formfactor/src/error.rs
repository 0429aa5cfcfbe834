//! Errors in the input.
use std::fmt;

/// Why an input was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate of the point or of the normal is NaN, infinite, or beyond 2^200 in magnitude.
    BadPoint,
    /// The normal has no direction: it is zero, or its length is outside 2^-200 to 2^200.
    BadNormal,
    /// The tolerance is not positive, or NaN.
    BadTolerance,
    /// The rows of a matrix cannot be made to add to 1.
    NotClosed {
        /// The row that is furthest from it.
        row: usize,
        /// What it lacks.
        defect: f64,
    },
    /// An emittance is missing, or not above 0 and at most 1.
    BadEmittance {
        /// Whose it is.
        surface: usize,
    },
    /// The polygon has no loops.
    NoLoops,
    /// A loop has fewer than three vertices.
    TooFewVertices {
        /// Index of the loop, in the order given.
        loop_index: usize,
        /// Number of vertices it has.
        count: usize,
    },
    /// A coordinate is NaN, infinite, or beyond 2^200 in magnitude.
    BadVertex {
        /// Index of the loop, in the order given.
        loop_index: usize,
        /// Index of the vertex within that loop.
        vertex: usize,
    },
    /// The first loop encloses no area, so that the polygon has no front.
    ZeroArea,
    /// The first loop encloses less area than a square of side 2^-200.
    TooSmall,
    /// A vertex lies further off the polygon's plane than rounding of its coordinates explains.
    NotPlanar {
        /// Index of the loop, in the order given.
        loop_index: usize,
        /// Index of the vertex within that loop.
        vertex: usize,
        /// Distance from the plane, in the coordinates' units.
        distance: f64,
        /// The largest distance that is accepted.
        allowed: f64,
    },
    /// A vertex of a part lies further off the plane of the polygon that it is of than rounding of coordinates explains.
    OffSurface {
        /// Index of the part's loop, in the order given.
        loop_index: usize,
        /// Index of the vertex within that loop.
        vertex: usize,
        /// Distance from the plane, in the coordinates' units.
        distance: f64,
        /// The largest distance that is accepted.
        allowed: f64,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Error::BadPoint => write!(
                f,
                "the point has a coordinate that is NaN, infinite or beyond 2^200; give finite numbers"
            ),
            Error::BadNormal => {
                write!(
                    f,
                    "the normal is zero, not finite, or shorter than 2^-200 or longer than 2^200; give it a length near 1, as only its direction counts"
                )
            }
            Error::BadTolerance => write!(f, "the tolerance is not positive; give a number like 1e-6"),
            Error::NotClosed { row, defect } => write!(
                f,
                "row {row} lacks {defect:e} of 1, so the scene is not closed; add space as a receiver, or close the scene"
            ),
            Error::BadEmittance { surface } => {
                write!(f, "surface {surface}: its emittance is not above 0 and at most 1; correct it")
            }
            Error::NoLoops => write!(f, "the polygon has no loops; give at least its outer loop"),
            Error::TooFewVertices { loop_index, count } => {
                write!(f, "loop {loop_index} has {count} vertices; a loop needs at least three")
            }
            Error::BadVertex { loop_index, vertex } => write!(
                f,
                "loop {loop_index}, vertex {vertex}: a coordinate is NaN, infinite or beyond 2^200; give finite numbers"
            ),
            Error::ZeroArea => {
                write!(f, "the first loop encloses no area, so that the polygon has no front; drop it")
            }
            Error::TooSmall => write!(
                f,
                "the first loop is too small: it encloses less than a square of side 2^-200; scale all coordinates up, as form factors have no unit, or drop it"
            ),
            Error::NotPlanar { loop_index, vertex, distance, allowed } => write!(
                f,
                "loop {loop_index}, vertex {vertex}: {distance:e} off the polygon's plane where {allowed:e} is allowed; split the polygon into triangles"
            ),
            Error::OffSurface { loop_index, vertex, distance, allowed } => write!(
                f,
                "loop {loop_index}, vertex {vertex} of the part: {distance:e} off the plane of its polygon where {allowed:e} is allowed; give points of that plane"
            ),
        }
    }
}

impl std::error::Error for Error {}
