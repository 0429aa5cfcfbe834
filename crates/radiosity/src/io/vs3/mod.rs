//! View3D's input files (`.vs3`): surfaces of three or four vertices (geometry `3`), or in their own planes (`3a`).
//!
//! ```text
//! mod      the scene
//! request  what the file asks of a program beside its geometry
//! rows     lines to surfaces
//! blast    surfaces in planes given by angles: geometry 3a
//! fields   the words of a line
//! ```
//! A surface becomes a one-sided patch with reflectance 1 − emittance and without emission; one that is not planar, two
//! triangles. A surface that has a base surface is cut out of it; a null surface is a hole in its base; an obstruction only
//! blocks.
mod blast;
mod fields;
mod request;
mod rows;

pub use request::Request;

use super::error::{Fault, FileError, Wrong};
use super::save::bytes_of;
use crate::plane::Plane;
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::{Origin, Patch},
};
use formfactor::PlanarPolygon;
use glam::DVec3;
use polycsg::{Csg, FillRule, Region};
use rows::{Row, RowKind, Rows};
use std::{collections::HashSet, path::Path};

/// The text of a `.vs3` file.
#[derive(Clone, Debug)]
pub struct Vs3 {
    name: String,
    text: String,
}

impl Vs3 {
    /// Reads a file's text; bytes that are not UTF-8, as in old comments, are replaced.
    ///
    /// # Errors
    /// [`FileError::Read`] when the file cannot be read.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        Ok(Self::from_text(path.display().to_string(), String::from_utf8_lossy(&bytes_of(path)?)))
    }

    /// A text as the contents of a file; messages show its `name`.
    pub fn from_text(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { name: name.into(), text: text.into() }
    }

    /// The contents of the file.
    pub(super) fn bytes(&self) -> &[u8] {
        self.text.as_bytes()
    }

    /// The scene: one band, z up (the format has no up axis).
    ///
    /// # Errors
    /// [`FileError::Line`], with the line; [`FileError::Garbled`] for a text without a surface.
    pub fn scene(&self) -> Result<Scene, FileError> {
        let Rows { surfaces, warnings, .. } = self.rows()?;
        if surfaces.is_empty() {
            let reason = "it has no surface, a line that begins with S";
            return Err(FileError::Garbled { file: self.name.clone(), wanted: "View3D", reason });
        }
        let mut scene = Scene { bands: 1, warnings, ..Scene::default() };
        scene.asset.up = DVec3::Z;
        let mut taken = HashSet::new();
        for (index, surface) in
            surfaces.iter().enumerate().filter(|(_, surface)| surface.kind != RowKind::Hole)
        {
            let holes: Vec<&Row> = surfaces.iter().filter(|part| part.base == index + 1).collect();
            let (polygons, bend) = shape(surface, &holes)
                .map_err(|source| self.fault((surface.line, Fault::Shape { polygon: index, source })))?;
            let first = scene.patches.len();
            for polygon in polygons {
                let mut name = surface.name.clone();
                while !taken.insert(name.clone()) {
                    name.push('\'');
                }
                let mut patch = Patch::new(name, polygon, vec![1.0 - surface.emittance], vec![0.0]);
                patch.only_blocks = surface.kind == RowKind::Obstruction;
                patch.origin = Origin { polygon: index, ..Origin::default() };
                scene.patches.push(patch);
            }
            scene.warnings.extend(bend.map(|distance| bent(surface, &scene.patches[first..], distance)));
        }
        Ok(scene)
    }

    /// What the file asks of a program that computes view factors, beside its geometry.
    ///
    /// # Errors
    /// [`FileError::Line`], with the line.
    pub fn request(&self) -> Result<Request, FileError> {
        Ok(self.rows()?.request())
    }

    fn rows(&self) -> Result<Rows, FileError> {
        Rows::parse(self.text.trim_start_matches('\u{feff}')).map_err(|wrong| self.fault(wrong))
    }

    fn fault(&self, (line, fault): Wrong) -> FileError {
        FileError::Line { file: self.name.clone(), line, fault }
    }
}

/// A surface without the parts that are cut out of it; and how far off a plane it is, where it was split into triangles.
fn shape(surface: &Row, parts: &[&Row]) -> Result<(Vec<PlanarPolygon>, Option<f64>), formfactor::Error> {
    let whole = match PlanarPolygon::new([points(surface)]) {
        Err(formfactor::Error::NotPlanar { distance, .. }) if parts.is_empty() => {
            return Ok((triangles(surface)?, Some(distance)));
        }
        whole => whole?,
    };
    if parts.is_empty() {
        return Ok((vec![whole], None));
    }
    let plane = Plane::of(&whole);
    let region = |row: &Row| {
        let flat: Vec<_> = points(row).into_iter().map(|point| plane.flatten(point)).collect();
        Region::from_rings([flat], FillRule::NonZero).unwrap_or_default()
    };
    let holes: Vec<Region> = parts.iter().map(|part| region(part)).collect();
    let rest = (Csg::from(&region(surface)) - Csg::union(&holes)).evaluate();
    Ok((plane.lift(&rest, whole.loops().flatten().copied()), None))
}

/// A quadrangle's two triangles, by its first diagonal.
fn triangles(surface: &Row) -> Result<Vec<PlanarPolygon>, formfactor::Error> {
    let [a, b, c, d] = [0, 1, 2, 3].map(|corner| surface.corners[corner]);
    [[a, b, c], [a, c, d]].into_iter().map(|triangle| PlanarPolygon::new([triangle])).collect()
}

fn bent(surface: &Row, pieces: &[Patch], distance: f64) -> Finding {
    Finding {
        kind: Kind::NonPlanar,
        what: format!(
            "line {}: {} is not planar by {distance:.1e}; split into two triangles",
            surface.line, surface.name
        ),
        patches: pieces.iter().map(|patch| patch.name.clone()).collect(),
        repair: "move the vertices into one plane, or split it yourself".into(),
        places: Vec::new(),
    }
}

/// The corners without those that stand twice in a row, the last before the first included.
fn points(row: &Row) -> Vec<DVec3> {
    let mut points = row.corners.clone();
    points.dedup();
    while points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    points
}
