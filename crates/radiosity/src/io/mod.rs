//! Scene files in, results out: COLLADA, glTF, View3D's format; whole files only.
pub mod collada;
mod error;
pub mod gltf;
mod image;
mod save;
mod source;
mod surface;
pub mod vs3;

pub(crate) use image::fetch;

pub use error::{Error, Fault};
pub use save::save;
pub use source::Source;
