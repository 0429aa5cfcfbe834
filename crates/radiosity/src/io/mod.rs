//! Reading scene files and writing results: COLLADA, glTF, OBJ, PLY, STL and View3D's format. Files are written completely or not at
//! all.
//!
//! ```text
//! source         a scene file of any kind
//! repaired_file  files written repaired
//! scene_file     scenes to files of any kind
//! format         which kind a file is
//! gltf           glTF 2.0, read and written
//! obj            Wavefront OBJ with MTL, read and written
//! ply            PLY, read and written
//! stl            STL, read and written
//! collada        COLLADA 1.4 and 1.5, read and written
//! vs3            View3D's input, read
//! photometry     IES and EULUMDAT files of luminaires, read
//! surface        what all readers do with polygons
//! upright        to the up axis of formats that have none of their own
//! words          lists and numbers as text
//! save           whole files or none
//! error          what can go wrong
//! ```
pub mod collada;
pub(crate) mod error;
mod format;
pub mod gltf;
pub mod obj;
pub mod photometry;
pub mod ply;
mod repaired_file;
mod save;
mod scene_file;
mod source;
pub mod stl;
mod surface;
mod upright;
pub mod vs3;
mod words;

pub use error::{Fault, FileError};
pub use repaired_file::RepairedFile;
pub use save::{save, save_with};
pub use scene_file::save_scene;
pub use source::Source;
