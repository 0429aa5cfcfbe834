//! A join by boxes, in place of a nested loop.
pub(crate) mod build;
pub(crate) mod collect;
pub(crate) mod condition;
pub(crate) mod exec;
pub(crate) mod overlaid;
pub(crate) mod probe;
pub(crate) mod rule;
pub(crate) mod sides;
pub(crate) mod tree;
