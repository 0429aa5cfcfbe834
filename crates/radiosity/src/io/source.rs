//! A scene file of any kind.
use super::save::bytes_of;
use super::{collada::Collada, error::FileError, format::Format, gltf::Gltf};
use super::{obj::Obj, ply::Ply, stl::Stl, vs3::Vs3};
use crate::mesh::element::Mesh;
use crate::scene::Scene;
use std::path::Path;

/// A scene file: COLLADA (`.dae`), glTF (`.gltf`, `.glb`), OBJ (`.obj`), PLY (`.ply`), STL (`.stl`) or View3D (`.vs3`). What its first
/// bytes say counts before its extension.
///
/// ```no_run
/// use radiosity::io::Source;
/// let scene = Source::open("room.glb")?.scene()?;
/// println!("{} patches", scene.patches.len());
/// # Ok::<(), radiosity::io::FileError>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Source {
    /// COLLADA 1.4 or 1.5.
    Collada(Collada),
    /// glTF 2.0, text or binary.
    Gltf(Gltf),
    /// OBJ with MTL.
    Obj(Obj),
    /// PLY, text or binary.
    Ply(Ply),
    /// STL, text or binary.
    Stl(Stl),
    /// View3D's vertices and surfaces.
    Vs3(Vs3),
}

impl Source {
    /// Reads a file. The files that it names are read from its folder, by [`Source::scene`].
    ///
    /// # Errors
    /// [`FileError::Unknown`] for a file of no known kind, [`FileError::Unread`] for one of a kind that is not read, and those of the
    /// format's own `open`.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        Self::read(path.display().to_string(), bytes_of(path)?, path.parent())
    }

    /// Bytes as the contents of a file, as they come through a pipe; messages show its `name`, whose extension counts where the bytes
    /// leave a doubt. The files that they name are read from the current folder.
    ///
    /// # Errors
    /// As [`Source::open`].
    pub fn from_bytes(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Result<Self, FileError> {
        Self::read(name.into(), bytes.into(), Some(Path::new("")))
    }

    fn read(name: String, bytes: Vec<u8>, folder: Option<&Path>) -> Result<Self, FileError> {
        Ok(match Format::of(&name, &bytes)? {
            Format::Collada => Self::Collada(Collada::from_bytes(name, bytes)?),
            Format::Gltf => Self::Gltf(Gltf::from_bytes(name, bytes).within(folder)),
            Format::Obj => Self::Obj(Obj::from_bytes(name, bytes)?.within(folder)),
            Format::Ply => Self::Ply(Ply::from_bytes(name, bytes).within(folder)),
            Format::Stl => Self::Stl(Stl::from_bytes(name, bytes)),
            Format::Vs3 => Self::Vs3(Vs3::from_text(name, String::from_utf8_lossy(&bytes))),
        })
    }

    /// The scene: patches, cameras and warnings.
    ///
    /// # Errors
    /// [`FileError`] for a fault of the file.
    pub fn scene(&self) -> Result<Scene, FileError> {
        match self {
            Self::Collada(file) => file.scene(),
            Self::Gltf(file) => file.scene(),
            Self::Obj(file) => file.scene(),
            Self::Ply(file) => file.scene(),
            Self::Stl(file) => file.scene(),
            Self::Vs3(file) => file.scene(),
        }
    }

    /// The contents of the file.
    pub(super) fn bytes(&self) -> &[u8] {
        match self {
            Self::Collada(file) => file.text().as_bytes(),
            Self::Gltf(file) => file.bytes(),
            Self::Obj(file) => file.bytes(),
            Self::Ply(file) => file.bytes(),
            Self::Stl(file) => file.bytes(),
            Self::Vs3(file) => file.bytes(),
        }
    }

    /// A COLLADA text in which the mesh's triangles replace the scene's polygons, with `colours` (red, green and blue for each
    /// vertex of the mesh) at their vertices: [`Collada::with_light`] for COLLADA, a new text for the other formats.
    ///
    /// `scene` must be this file's scene and `mesh` a mesh of its patches.
    ///
    /// # Errors
    /// As [`Source::scene`].
    pub fn with_light(&self, scene: &Scene, mesh: &Mesh, colours: &[[f64; 3]]) -> Result<String, FileError> {
        match self {
            Self::Collada(file) => file.with_light(scene, mesh, colours),
            _ => {
                let file = Collada::of(scene);
                file.with_light(&file.scene()?, mesh, colours)
            }
        }
    }
}
