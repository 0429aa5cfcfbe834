//! The expression: what the user states, and the state of a walk that tells where it holds.

mod apart;
pub(crate) mod bounds;
pub(crate) mod circuit;
pub(crate) mod csg;
pub(crate) mod simple_ring;
pub(crate) mod winding;
