//! Polygons, the differential area that sees them, and boxes around them.
pub(crate) mod cell;
pub(crate) mod convex;
pub(crate) mod differential_area;
pub(crate) mod extent;
pub(crate) mod holes;
pub(crate) mod loops;
pub(crate) mod pieces;
mod plane;
pub(crate) mod polygon;
