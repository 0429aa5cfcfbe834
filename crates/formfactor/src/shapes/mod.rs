//! What stands in space: polygons, the differential area that sees them, boxes around them.
pub(crate) mod differential_area;
pub(crate) mod extent;
pub(crate) mod loops;
pub(crate) mod polygon;
