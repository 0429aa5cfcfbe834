//! polycsg side by side with the other polygon libraries of the registry: inputs, engines, and how they are timed.

pub mod engines;
pub mod job;
pub mod random;
pub mod shapes;
