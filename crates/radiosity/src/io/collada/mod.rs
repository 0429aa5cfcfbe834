//! COLLADA 1.4 and 1.5: reading scenes, and writing them with light on their surfaces.
//!
//! Read: the visual scene that `<scene>` instances, nodes with their transforms (all but `<skew>`), `<instance_node>`,
//! `<polylist>`, `<polygons>` with holes, `<triangles>`, `<tristrips>`, `<trifans>`, materials by the diffuse colour
//! (reflectance) and the emission colour (radiance) of their common profile, or spectra of any number of bands from an
//! `<extra>` of this program, point, spot and directional lights and Blender's area lights, perspective cameras. A warning tells what is not read. Every polygon becomes a one-sided patch;
//! its front is the side from which it is counter-clockwise.
//!
//! A polygon that is not planar is split into triangles, and one without area is left out, both with a warning. A solid keeps
//! its outside where a node's transform mirrors it; a node whose transform flattens it is left out, with a warning.
mod camera;
pub(crate) mod compose;
mod dimmed;
mod embedded;
mod encoding;
mod exposed;
mod file;
mod images;
mod kept;
mod light_text;
mod lights;
mod lit_mesh;
mod material;
pub(crate) mod model;
mod outlines;
mod patches;
mod pieces;
mod primitive;
mod repaired;
mod spectra;
mod splice;
mod transform;
mod unread;
mod vertices;
mod walk;
mod write;

use super::error::FileError;
use super::save::{bytes_of, is_another};
use crate::expose::Exposure;
use crate::io::surface::changes::{changes, dimmed};
use crate::mesh::element::Mesh;
use crate::scene::{Scene, asset::Asset, patch::Origin};
use compose::text_with;
use file::{File, child};
use glam::DVec3;
use light_text::WrittenLights;
use model::Model;
use std::path::Path;

/// The text of a COLLADA file, into which a result can be written.
#[derive(Clone, Debug)]
pub struct Collada {
    name: String,
    text: String,
}

impl Collada {
    /// Reads a file's text.
    ///
    /// # Errors
    /// [`FileError::Read`] when the file cannot be read, and those of [`Collada::from_bytes`].
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        Self::from_bytes(path.display().to_string(), bytes_of(path)?)
    }

    /// Bytes as the contents of a file: text in UTF-8, UTF-16 or the encoding that its declaration names. Messages show its `name`,
    /// and pictures are read from the folder that is part of it.
    ///
    /// # Errors
    /// [`FileError::Encoding`] for bytes that are not in that encoding, [`FileError::Garbled`] for what is no XML at all.
    pub fn from_bytes(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Result<Self, FileError> {
        let name = name.into();
        Ok(Self { text: encoding::text(&name, bytes.into())?, name })
    }

    /// A new file of a scene, with a node for each patch. Read again, it has the same patches, lamps and suns. Spectra are written as such,
    /// beside their colours. A measured lamp is written as even: COLLADA has no place for a table.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let Scene { lamps, suns, wavelengths, .. } = scene;
        Self::from_text(
            "scene.dae",
            text_with(&Model::of(scene), &WrittenLights { lamps, suns, wavelengths }),
        )
    }

    /// The file's text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// A text as the contents of a file; messages show its `name`.
    pub fn from_text(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { name: name.into(), text: text.into() }
    }

    /// The scene: patches, cameras and warnings, in the file's units and axes.
    ///
    /// # Errors
    /// [`FileError::Xml`] and [`FileError::Scene`], with the line.
    pub fn scene(&self) -> Result<Scene, FileError> {
        self.with_file(|file| Ok(self.read(file)?.0))
    }

    /// The scene, and where polygons were split or left out.
    fn read(&self, file: &File<'_>) -> Result<(Scene, Vec<Origin>), FileError> {
        let walk::Walk { instances, camera_instances, light_instances, mut warnings } = walk::walk(file)?;
        unread::tell(file, &mut warnings);
        let asset = asset(file)?;
        let folder = Path::new(&self.name).parent();
        let mut images = images::Images::new(folder);
        let lights = lights::lights(file, &light_instances, asset.unit, &mut warnings)?;
        let (patches, flawed) =
            patches::patches(file, &instances, &lights.areas, &mut images, &mut warnings)?;
        let cameras = camera::cameras(file, &camera_instances, &mut warnings);
        let (bands, wavelengths) = spectra::bands(file, &patches)?;
        let lights::ReadLights { lamps, suns, .. } = lights;
        let scene =
            Scene { patches, lamps, suns, cameras, bands, wavelengths, warnings, asset, ..Scene::default() };
        Ok((scene, flawed))
    }

    /// The file's text in which the mesh's triangles replace each lit geometry, in the node's coordinates, with `colours` (red,
    /// green and blue for each vertex of the mesh) at their vertices. Everything else stays byte for byte. A geometry that
    /// several nodes instance gets a copy for each.
    ///
    /// `scene` must be this file's scene and `mesh` a mesh of its patches.
    ///
    /// # Errors
    /// As [`Collada::scene`].
    pub fn with_light(&self, scene: &Scene, mesh: &Mesh, colours: &[[f64; 3]]) -> Result<String, FileError> {
        self.with_file(|file| write::with_light(&self.text, file, &write::LitScene { scene, mesh, colours }))
    }

    /// The file's text with the polygons of a repaired scene: those that were cut give way to their pieces, and everything else stays byte
    /// for byte, but for diffuse colours whose reflectance was limited. Polygons behind which nothing changed keep their vertices bit for bit.
    /// Polygons of bodies that are closed no longer are said not to be double-sided, so that the sides stay hidden that were; those whose two
    /// sides were cut in different ways become two.
    ///
    /// `before` must be this file's scene, and `after` that scene [repaired](crate::repair()). A file that has no room for more vertices is
    /// written anew, as by [`Collada::of`], and so is one whose limited reflectances are spectra. A picture that reflects all light
    /// everywhere stays: the format cannot lower it.
    ///
    /// # Errors
    /// As [`Collada::scene`].
    pub fn repaired(&self, before: &Scene, after: &Scene) -> Result<String, FileError> {
        let spliced = self.with_file(|file| {
            let (scene, flawed) = self.read(file)?;
            let repairs = (changes([&scene, before, after], &flawed), dimmed(before, after));
            repaired::repaired(&self.text, file, &repairs)
        })?;
        Ok(spliced.unwrap_or_else(|| Self::of(after).text))
    }

    /// The file repaired, see [`Collada::repaired`].
    pub(super) fn with_repaired(&self, before: &Scene, after: &Scene) -> Result<Self, FileError> {
        Ok(Self::from_text(self.name.as_str(), self.repaired(before, after)?))
    }

    /// The same file for a folder: with the pictures that it names in it, where it is from another one.
    pub(super) fn moved_to(self, folder: &Path) -> Result<Self, FileError> {
        let old = Path::new(&self.name).parent();
        if !is_another(old, folder) {
            return Ok(self);
        }
        let text = self.with_file(|file| Ok(embedded::embedded(&self.text, file, old)))?;
        Ok(Self { text, ..self })
    }

    /// The file's text with its vertex colours, read as radiosity, turned to intensities from 0 to 1; everything else stays byte
    /// for byte. Without an exposure it is the one of [`with_exposure`], or that of all lit vertices: see [`Exposure::of`].
    ///
    /// # Errors
    /// [`FileError::Xml`] and [`FileError::Scene`], with the line; the latter also when no surface has vertex colours.
    pub fn exposed(&self, exposure: Option<Exposure>) -> Result<String, FileError> {
        self.with_file(|file| exposed::exposed(&self.text, file, exposure))
    }

    fn with_file<T>(&self, read: impl FnOnce(&File) -> Result<T, FileError>) -> Result<T, FileError> {
        let document = roxmltree::Document::parse(&self.text)
            .map_err(|source| FileError::Xml { file: self.name.clone(), source })?;
        read(&File::new(&self.name, &document)?)
    }
}

/// The text of a file with light, in which an exposure for it is kept: see [`Collada::exposed`].
#[must_use]
pub fn with_exposure(text: &str, exposure: Exposure) -> String {
    exposed::with_exposure(text, exposure)
}

fn asset(file: &File) -> Result<Asset, FileError> {
    let asset = child(file.root, "asset");
    let axis = asset.and_then(|asset| child(asset, "up_axis")).and_then(|axis| axis.text());
    let up = match axis.map(str::trim) {
        Some("X_UP") => DVec3::X,
        Some("Z_UP") => DVec3::Z,
        _ => DVec3::Y,
    };
    let unit = asset.and_then(|asset| child(asset, "unit")).and_then(|unit| unit.attribute("meter"));
    let metres = unit.and_then(|metres| metres.trim().parse().ok());
    Ok(Asset { up, unit: metres.filter(|metres: &f64| metres.is_normal() && *metres > 0.0).unwrap_or(1.0) })
}
