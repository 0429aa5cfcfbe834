//! Arithmetic on doubles and twice that, and the signs that it decides.
pub(crate) mod gauss;
pub(crate) mod offset;
pub(crate) mod predicates;
pub(crate) mod rounding;
