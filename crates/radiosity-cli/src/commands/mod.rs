//! The commands.
pub(crate) mod compare;
pub(crate) mod expose;
pub(crate) mod factors;
pub(crate) mod inspect;
mod patience;
pub(crate) mod plot;
pub(crate) mod report;
pub(crate) mod scene;
pub(crate) mod solve;
pub(crate) mod view;
