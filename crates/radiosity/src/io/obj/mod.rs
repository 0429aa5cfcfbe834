//! Wavefront OBJ with MTL: faces of any number of vertices, and their materials.
//!
//! ```text
//! mod         the file
//! write       scenes and lit meshes
//! read        faces to patches
//! material    MTL
//! statements  words on a line
//! ```
//! Read: `v`, `vt`, `vn`, `f` with indices from 1 or back from the last, `o` and `g` as names, `usemtl` and `mtllib`; of MTL the
//! diffuse colour `Kd` (reflectance), `map_Kd` with its scale and offset, and the emission `Ke` (radiance). Triangles of a plane are
//! joined where a material has nothing else. A warning tells what is not read. The format has no unit and no up axis: metres and y,
//! as most exporters have it.
//!
//! The lines are ours to read: the libraries that we tried do not tell which line is wrong, and pass over what they do not know.
mod material;
mod read;
mod statements;
mod write;

pub use write::{ObjFiles, lit, text};

use super::error::FileError;
use super::save::bytes_of;
use crate::scene::Scene;
use std::path::{Path, PathBuf};

/// The text of an OBJ file.
#[derive(Clone, Debug)]
pub struct Obj {
    name: String,
    text: String,
    folder: Option<PathBuf>,
}

impl Obj {
    /// Reads a file's text. The files that it names are read from its folder, by [`Obj::scene`].
    ///
    /// # Errors
    /// [`FileError::Read`] when the file cannot be read, [`FileError::Garbled`] when it is no text.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        Ok(Self::from_bytes(path.display().to_string(), bytes_of(path)?)?.within(path.parent()))
    }

    /// Bytes as the contents of a file that is in no folder; messages show its `name`. Bytes that are not UTF-8, as in old names,
    /// are replaced.
    ///
    /// # Errors
    /// [`FileError::Garbled`] for bytes that are no text.
    pub fn from_bytes(name: impl Into<String>, bytes: impl AsRef<[u8]>) -> Result<Self, FileError> {
        let (name, bytes) = (name.into(), bytes.as_ref());
        if bytes.contains(&0) {
            return Err(FileError::Garbled { file: name, wanted: "OBJ", reason: "its bytes are no text" });
        }
        Ok(Self { name, text: String::from_utf8_lossy(bytes).into_owned(), folder: None })
    }

    /// The same file in a folder, from which the files that it names are read.
    pub(super) fn within(self, folder: Option<&Path>) -> Self {
        Self { folder: folder.map(Into::into), ..self }
    }

    /// The contents of the file.
    pub(super) fn bytes(&self) -> &[u8] {
        self.text.as_bytes()
    }

    /// The scene: patches and warnings, in metres, y up.
    ///
    /// # Errors
    /// [`FileError::Line`], with the line; [`FileError::Garbled`] for a text without a vertex.
    pub fn scene(&self) -> Result<Scene, FileError> {
        read::scene(&self.name, &self.text, self.folder.as_deref())
    }
}
