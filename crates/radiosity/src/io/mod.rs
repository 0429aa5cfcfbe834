//! Reading scene files and writing results: COLLADA, glTF and View3D's format. Files are written completely or not at all.
//!
//! ```text
//! source     a scene file of any kind
//! gltf       glTF 2.0, read and written
//! collada    COLLADA 1.4 and 1.5, read and written
//! vs3        View3D's input, read
//! photometry IES and EULUMDAT files of luminaires, read
//! surface    what all readers do with polygons
//! save       whole files or none
//! error      what can go wrong
//! ```
pub mod collada;
pub(crate) mod error;
pub mod gltf;
pub mod photometry;
mod save;
mod source;
mod surface;
pub mod vs3;

pub use error::{Fault, FileError};
pub use save::{save, save_with};
pub use source::Source;
