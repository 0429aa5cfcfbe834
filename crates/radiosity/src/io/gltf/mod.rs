//! glTF 2.0, text and binary: reading scenes and writing lit meshes.
//!
//! Read: the default scene's nodes with their transforms, triangles, strips and fans (those of a plane joined back to
//! polygons), the base colour as reflectance, its texture, the emissive factor times `KHR_materials_emissive_strength` as
//! radiance, the lights of `KHR_lights_punctual`, perspective cameras. A double-sided material makes two patches of each polygon, the second one named
//! `.back`. A warning tells what is not read. Lengths are metres, y is up.
mod accessor;
mod buffer;
mod compose;
mod container;
mod dimmed;
mod document;
mod embedded;
mod exposed;
mod lights;
mod lit;
mod material;
mod prepare;
mod read;
mod repaired;
mod write;

pub use compose::scene_glb;
pub use exposed::exposed;
pub use write::glb;

use super::error::FileError;
use super::save::{bytes_of, is_another};
use super::surface::changes::{changes, dimmed};
use crate::scene::{Scene, patch::Origin};
use read::ReadPrimitive;
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

    /// The file repaired, see [`Gltf::repaired`].
    pub(super) fn with_repaired(&self, before: &Scene, after: &Scene) -> Result<Self, FileError> {
        Ok(Self { bytes: self.repaired(before, after)?, ..self.clone() })
    }

    /// The same file for a folder: with all that it names in it, where it is from another one.
    pub(super) fn moved_to(self, folder: &Path) -> Result<Self, FileError> {
        if !is_another(self.folder.as_deref(), folder) {
            return Ok(self);
        }
        match embedded::embedded(&self.name, &self.bytes, self.folder.as_deref())? {
            Some(bytes) => Ok(Self { bytes, ..self }),
            None => Ok(self),
        }
    }

    /// The extension of its kind.
    pub(super) fn extension(&self) -> &'static str {
        if self.bytes.starts_with(b"glTF") { "glb" } else { "gltf" }
    }

    /// The contents of the file.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The scene: patches, cameras and warnings, in metres, y up.
    ///
    /// # Errors
    /// [`FileError::Gltf`] for bytes that are not glTF 2.0, [`FileError::Part`] for a part with a fault.
    pub fn scene(&self) -> Result<Scene, FileError> {
        let mut warnings = Vec::new();
        let document = document::prepared(&self.name, &self.bytes, &mut warnings)?;
        let file = document::check(&self.name, document)?;
        Ok(read::read(&self.name, &file, self.folder.as_deref(), warnings)?.0)
    }

    /// The bytes of this file with the polygons of a repaired scene: triangles of polygons that were cut give way to those of their pieces,
    /// which are added behind the file's data; base colours whose reflectance was limited are lowered; everything else stays. Text stays
    /// text, and binary stays binary. Triangles of bodies that are closed no longer get a copy of their material that is not double-sided, so
    /// that the sides stay hidden that were; those whose two sides were cut in different ways become two.
    ///
    /// `before` must be this file's scene, and `after` that scene [repaired](crate::repair()). Positions are in single precision.
    ///
    /// # Errors
    /// As [`Gltf::scene`], and [`FileError::Size`] when the data exceed the format's 4 GiB.
    pub fn repaired(&self, before: &Scene, after: &Scene) -> Result<Vec<u8>, FileError> {
        let (mut document, blob) = document::prepared(&self.name, &self.bytes, &mut Vec::new())?;
        let file = document::check(&self.name, (document.clone(), blob.clone()))?;
        let (scene, primitives) = read::read(&self.name, &file, self.folder.as_deref(), Vec::new())?;
        let flawed = |read: &ReadPrimitive| {
            let origin = read.origin;
            read.flawed.iter().map(move |&polygon| Origin { polygon, ..origin }).collect::<Vec<_>>()
        };
        let flawed: Vec<Origin> = primitives.iter().flat_map(flawed).collect();
        let (changes, dimmed) = (changes([&scene, before, after], &flawed), dimmed(before, after));
        if changes.is_empty() && dimmed.is_empty() {
            return Ok(self.bytes.clone());
        }
        dimmed::dim(&mut document, &primitives, &dimmed);
        repaired::repaired((document, blob), &primitives, &changes)
    }
}
