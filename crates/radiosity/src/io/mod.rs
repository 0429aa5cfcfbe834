//! Scene files in, results out: COLLADA, glTF binary, whole files only.
pub mod collada;
mod error;
pub mod glb;
mod image;
mod save;
mod surface;

pub use error::{Error, Fault};
pub use save::save;
