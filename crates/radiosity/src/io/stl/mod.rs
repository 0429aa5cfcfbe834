//! STL, binary and text: triangles without materials.
//!
//! ```text
//! mod     the file and its scene
//! write   scenes, binary
//! binary  a header, a number, 50 bytes a triangle
//! text    solids, facets, vertices
//! solid   what both have
//! ```
//! Triangles of a plane are joined. The front is the side from which the vertices are counter-clockwise; the file's own normals are not
//! read. The format has no material, no unit and no up axis: the reflectance is 0.5, lengths are metres, z is up, as in the programs for
//! solids that write it.
//!
//! A binary file may begin with the word that begins a text, so its length decides which it is.
mod binary;
mod solid;
mod text;
mod write;

pub use write::stl;

use super::error::{Fault, FileError};
use super::save::bytes_of;
use super::surface::finish::{Finish, Surface};
use super::surface::{facets, place::Surfaces};
use super::words::MARK;
use crate::scene::{Scene, finding::Finding, patch::Origin};
use glam::{DMat4, DVec3};
use solid::Solid;
use std::path::Path;

/// The bytes of an STL file.
#[derive(Clone, Debug)]
pub struct Stl {
    name: String,
    bytes: Vec<u8>,
}

impl Stl {
    /// Reads a file.
    ///
    /// # Errors
    /// [`FileError::Read`] when the file cannot be read.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        Ok(Self::from_bytes(path.display().to_string(), bytes_of(path)?))
    }

    /// Bytes as the contents of a file; messages show its `name`.
    pub fn from_bytes(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self { name: name.into(), bytes: bytes.into() }
    }

    /// The contents of the file.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The scene: patches and warnings, in metres, z up.
    ///
    /// # Errors
    /// [`FileError::Line`] and [`FileError::Part`], with the line or the triangle; [`FileError::Garbled`] for bytes that are neither kind.
    pub fn scene(&self) -> Result<Scene, FileError> {
        let (mut warnings, mut surfaces) = (Vec::new(), Surfaces::in_single_precision());
        let solids = self.solids(&mut warnings)?;
        let what = "the format has no materials; the reflectance is 0.5";
        Finding::note(&mut warnings, self.name.as_str(), what, "use another format where colours matter");
        for (instance, solid) in solids.iter().enumerate() {
            let facets = facets(&solid.triangles, true, false);
            let (material, reflectance, emission) = ("".into(), [0.5; 3], [0.0; 3]);
            let finish = Finish { material, reflectance, emission, image: None, spectra: None };
            let origin = Origin { instance, primitive: 0, polygon: 0 };
            let name = if solid.name.is_empty() { "patch" } else { &solid.name };
            let (place, world) = (solid.place.as_str(), DMat4::IDENTITY);
            let surface = Surface { name, place, facets: &facets, world, finish, two_sided: false, origin };
            surfaces.add(&surface, &mut warnings).map_err(|refusal| {
                let (file, part) = (self.name.clone(), solid.place.clone());
                FileError::Part { file, part, fault: Fault::from(refusal) }
            })?;
        }
        let mut scene = Scene { patches: surfaces.named(), bands: 3, warnings, ..Scene::default() };
        scene.asset.up = DVec3::Z;
        Ok(scene)
    }

    fn solids(&self, warnings: &mut Vec<Finding>) -> Result<Vec<Solid>, FileError> {
        let (file, bytes) = (&self.name, self.bytes.as_slice());
        let garbled = |reason| Err(FileError::Garbled { file: file.clone(), wanted: "STL", reason });
        if let Some(rows) = binary::rows(bytes) {
            return binary::solid(file, rows, warnings).map(|solid| vec![solid]);
        }
        let text = bytes.strip_prefix(MARK).unwrap_or(bytes).trim_ascii_start();
        if !text.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) {
            return garbled(
                "it neither begins with the word solid nor has the length of a binary file, 84 bytes and 50 for each triangle",
            );
        }
        if text.contains(&0) {
            return garbled(
                "its bytes are no text, and it has not the length of a binary file: it may be cut short",
            );
        }
        let solids = text::solids(&String::from_utf8_lossy(text))
            .map_err(|(line, fault)| FileError::Line { file: file.clone(), line, fault })?;
        if solids.iter().all(|solid| solid.triangles.is_empty()) {
            return garbled("it has no facet");
        }
        Ok(solids)
    }
}
