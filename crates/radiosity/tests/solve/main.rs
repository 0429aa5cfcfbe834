//! What the solver promises, on scenes built here.
mod build;
mod extreme;
mod interpolation;
mod lasting;
mod sources;
mod stiff;
