//! Vectors of double-doubles, exact signs, quadrature rules.
pub(crate) mod angle;
pub(crate) mod gauss;
pub(crate) mod offset;
pub(crate) mod predicates;
pub(crate) mod rounding;
pub(crate) mod taylor;
