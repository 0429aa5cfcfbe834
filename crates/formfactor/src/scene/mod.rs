//! Many polygons that see and hide each other: which of them can stand before a target.
pub(crate) mod apart;
pub(crate) mod blockers;
pub(crate) mod body;
pub(crate) mod cap;
pub(crate) mod coplanar;
pub(crate) mod enclosure;
pub(crate) mod inside;
pub(crate) mod line;
mod looks;
pub(crate) mod occluder;
pub(crate) mod plates;
pub(crate) mod pool;
pub(crate) mod shaft;
pub(crate) mod shell;
mod sight;
pub(crate) mod slab;
pub(crate) mod surfaces;
pub(crate) mod tree;
