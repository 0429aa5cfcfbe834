//! Many polygons that see and hide each other: which of them can stand before a target.
pub(crate) mod body;
pub(crate) mod enclosure;
pub(crate) mod pool;
pub(crate) mod shaft;
pub(crate) mod tree;
pub(crate) mod apart;
pub(crate) mod coplanar;
pub(crate) mod occluder;
pub(crate) mod surfaces;
