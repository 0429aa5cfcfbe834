//! PLY, as text and binary: faces of any number of vertices, and strips.
//!
//! ```text
//! mod     the file
//! write   scenes and lit meshes, binary
//! read    vertices and faces to patches
//! body    numbers behind the header
//! header  elements and their properties
//! ```
//! Read: points, normals and places in the picture that a comment `TextureFile` names; the colour of a face, or the mean of its vertices'
//! colours, as its reflectance: whole numbers are sRGB, others linear. Without a colour it is 0.5. Triangles of a plane and a colour are
//! joined. A warning tells what is not read. The format has no unit and no up axis: metres and y.
//!
//! The rows are ours to read: the libraries that we tried tell no place of a fault in one line, and misread a header that names a thing
//! twice.
mod body;
mod header;
mod read;
mod write;

pub use write::{lit, ply};

use super::error::FileError;
use super::save::bytes_of;
use super::words::MARK;
use crate::scene::Scene;
use std::path::{Path, PathBuf};

/// The bytes of a PLY file.
#[derive(Clone, Debug)]
pub struct Ply {
    name: String,
    bytes: Vec<u8>,
    folder: Option<PathBuf>,
}

impl Ply {
    /// Reads a file. A picture that it names is read from its folder, by [`Ply::scene`].
    ///
    /// # Errors
    /// [`FileError::Read`] when the file cannot be read.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        Ok(Self::from_bytes(path.display().to_string(), bytes_of(path)?).within(path.parent()))
    }

    /// Bytes as the contents of a file that is in no folder; messages show its `name`.
    pub fn from_bytes(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self { name: name.into(), bytes: bytes.into(), folder: None }
    }

    /// The same file in a folder, from which the files that it names are read.
    pub(super) fn within(self, folder: Option<&Path>) -> Self {
        Self { folder: folder.map(Into::into), ..self }
    }

    /// The contents of the file.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The scene: patches and warnings, in metres, y up.
    ///
    /// # Errors
    /// [`FileError::Garbled`] for bytes that are not PLY, [`FileError::Line`] and [`FileError::Part`] with the line or the row.
    pub fn scene(&self) -> Result<Scene, FileError> {
        let bytes = self.bytes.strip_prefix(MARK).unwrap_or(&self.bytes);
        if !(bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")) {
            let reason = "its first line is not the word ply";
            return Err(FileError::Garbled { file: self.name.clone(), wanted: "PLY", reason });
        }
        read::scene(&self.name, bytes, self.folder.as_deref())
    }
}
