//! The functions of groups. A group's state is the rings that went in, so that no partition rounds anything.
pub(crate) mod accumulator;
pub(crate) mod components;
pub(crate) mod covered;
pub(crate) mod evaluate;
pub(crate) mod function;
pub(crate) mod group;
pub(crate) mod groups;
pub(crate) mod outline;
pub(crate) mod state;
