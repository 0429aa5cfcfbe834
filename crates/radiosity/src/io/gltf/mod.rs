//! glTF 2.0, text and binary: reading scenes and writing lit meshes.
//!
//! Read: the default scene's nodes with their transforms, triangles, strips and fans (those of a plane joined back to
//! polygons), the base colour as reflectance, its texture, the emissive factor times `KHR_materials_emissive_strength` as
//! radiance, the lights of `KHR_lights_punctual`, perspective cameras. A double-sided material makes two patches of each polygon, the second one named
//! `.back`. A warning tells what is not read. Lengths are metres, y is up.
mod accessor;
mod buffer;
mod container;
mod document;
mod exposed;
mod lights;
mod lit;
mod material;
mod read;
mod write;

pub use exposed::exposed;
pub use write::glb;

use super::error::FileError;
use crate::scene::Scene;
use std::path::{Path, PathBuf};

/// The bytes of a `.glb` or `.gltf` file.
#[derive(Clone, Debug)]
pub struct Gltf {
    name: String,
    bytes: Vec<u8>,
    folder: Option<PathBuf>,
}

impl Gltf {
    /// Reads a file. Other files that it names are read from its folder, by [`Gltf::scene`].
    ///
    /// # Errors
    /// [`FileError::Read`] when the file cannot be read.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(|source| FileError::Read { path: path.into(), source })?;
        let folder = path.parent().map(Into::into);
        Ok(Self { name: path.display().to_string(), bytes, folder })
    }

    /// Bytes as the contents of a file that is in no folder; messages show its `name`.
    pub fn from_bytes(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self { name: name.into(), bytes: bytes.into(), folder: None }
    }

    /// The scene: patches, cameras and warnings, in metres, y up.
    ///
    /// # Errors
    /// [`FileError::Gltf`] for bytes that are not glTF 2.0, [`FileError::Part`] for a part with a fault.
    pub fn scene(&self) -> Result<Scene, FileError> {
        let file = document::parse(&self.name, &self.bytes)?;
        read::scene(&self.name, &file, self.folder.as_deref())
    }
}
