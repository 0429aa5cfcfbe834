//! A scene file of any kind.
use super::{collada::Collada, error::FileError, gltf::Gltf, vs3::Vs3};
use crate::mesh::element::Mesh;
use crate::scene::Scene;
use std::path::Path;

/// A scene file in the format of its extension: COLLADA (`.dae`), glTF (`.gltf`, `.glb`) or View3D (`.vs3`).
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
    /// View3D's vertices and surfaces.
    Vs3(Vs3),
}

impl Source {
    /// Reads a file.
    ///
    /// # Errors
    /// [`FileError::Unknown`] for another extension, and those of the format's own `open`.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("dae") => Collada::open(path).map(Self::Collada),
            Some("gltf" | "glb") => Gltf::open(path).map(Self::Gltf),
            Some("vs3") => Vs3::open(path).map(Self::Vs3),
            _ => Err(FileError::Unknown { file: path.display().to_string() }),
        }
    }

    /// The scene: patches, cameras and warnings.
    ///
    /// # Errors
    /// [`FileError`] for a fault of the file.
    pub fn scene(&self) -> Result<Scene, FileError> {
        match self {
            Self::Collada(file) => file.scene(),
            Self::Gltf(file) => file.scene(),
            Self::Vs3(file) => file.scene(),
        }
    }

    /// The bytes of this file with the polygons of a repaired scene: the file's own text or document, in which polygons that were cut give
    /// way to their pieces, for COLLADA and glTF; a new COLLADA text for the other formats.
    ///
    /// `before` must be this file's scene, and `after` that scene [repaired](crate::repair()).
    ///
    /// # Errors
    /// As [`Source::scene`].
    pub fn repaired(&self, before: &Scene, after: &Scene) -> Result<Vec<u8>, FileError> {
        match self {
            Self::Collada(file) => file.repaired(before, after).map(String::into_bytes),
            Self::Gltf(_) | Self::Vs3(_) => Ok(Collada::of(after).text().into()),
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
            Self::Gltf(_) | Self::Vs3(_) => {
                let file = Collada::of(scene);
                file.with_light(&file.scene()?, mesh, colours)
            }
        }
    }
}
