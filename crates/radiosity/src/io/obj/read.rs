//! Faces to patches: one surface for all faces of a name and a material.
use super::material::{Mtl, materials};
use super::statements::{Statement, shortened};
use crate::image_file;
use crate::io::error::{Fault, FileError, Wrong};
use crate::io::surface::finish::Surface;
use crate::io::surface::place::Surfaces;
use crate::io::surface::polygon::{Corner, Polygon};
use crate::io::surface::{facets, is_cut};
use crate::scene::{Scene, finding::Finding, patch::Origin};
use glam::{DMat4, DVec2, DVec3};
use std::collections::HashMap;
use std::path::Path;

pub(super) fn scene(file: &str, text: &str, folder: Option<&Path>) -> Result<Scene, FileError> {
    let mut reader = ObjReader { file, folder, ..ObjReader::default() };
    for statement in Statement::all(text) {
        reader.read(&statement).map_err(|wrong| fault(file, wrong))?;
    }
    if reader.points.is_empty() {
        let reason = "it has no vertex";
        return Err(FileError::Garbled { file: file.into(), wanted: "OBJ", reason });
    }
    reader.scene()
}

fn fault(file: &str, (line, fault): Wrong) -> FileError {
    FileError::Line { file: file.into(), line, fault }
}

/// The faces of one name and material.
#[derive(Debug, Default)]
struct ObjGroup {
    name: String,
    material: String,
    /// The line of its first face.
    line: usize,
    polygons: Vec<Polygon>,
}

#[derive(Default)]
struct ObjReader<'f> {
    file: &'f str,
    folder: Option<&'f Path>,
    points: Vec<DVec3>,
    places: Vec<DVec2>,
    normals: Vec<DVec3>,
    materials: HashMap<String, Mtl>,
    name: String,
    material: String,
    groups: Vec<ObjGroup>,
    numbers: HashMap<(String, String), usize>,
    warnings: Vec<Finding>,
}

impl ObjReader<'_> {
    fn read(&mut self, statement: &Statement<'_>) -> Result<(), Wrong> {
        match statement.keyword {
            "v" => {
                if statement.words.len() > 4 {
                    self.note(statement, "vertex colours are left out", "give the faces materials");
                }
                self.points.push(statement.vector()?);
            }
            "vt" => self.places.push(statement.place()?),
            "vn" => {
                if statement.vector().is_err() {
                    self.note(statement, "normals that cannot be read are left out", "export the file again");
                }
                self.normals.push(statement.vector().unwrap_or_default());
            }
            "f" | "fo" => self.face(statement)?,
            "o" | "g" => self.name = statement.name(),
            "usemtl" => self.material = statement.name(),
            "mtllib" => self.library(statement)?,
            "l" | "p" => {
                let what = "lines and points have no area; they are left out";
                self.note(statement, what, "remove them, or make them surfaces");
            }
            "vp" | "cstype" | "deg" | "bmat" | "step" | "curv" | "curv2" | "surf" | "parm" | "trim"
            | "hole" | "scrv" | "sp" | "end" | "con" => {
                let what = "curves and free-form surfaces are left out";
                self.note(statement, what, "turn them into polygons");
            }
            "s" | "mg" | "bevel" | "c_interp" | "d_interp" | "lod" | "shadow_obj" | "trace_obj" | "ctech"
            | "stech" | "maplib" | "usemap" => {}
            _ => self.note(
                statement,
                "statements that are not OBJ's are passed over",
                "correct or remove them",
            ),
        }
        Ok(())
    }

    fn note(&mut self, statement: &Statement<'_>, what: &str, repair: &str) {
        let place = format!("{}:{}: {}", self.file, statement.line, shortened(statement.keyword));
        Finding::note(&mut self.warnings, place, what, repair);
    }

    /// The materials of the files that a statement names; a name may hold spaces.
    fn library(&mut self, statement: &Statement<'_>) -> Result<(), Wrong> {
        let whole = statement.name();
        let read = |name: &str| image_file::bytes(name.trim_matches('"'), self.folder);
        let files: Vec<(String, Result<Vec<u8>, String>)> = match read(&whole) {
            Err(_) if statement.words.len() > 1 => {
                statement.words.iter().map(|name| ((*name).to_owned(), read(name))).collect()
            }
            bytes => vec![(whole, bytes)],
        };
        for (name, bytes) in files {
            match bytes {
                Ok(bytes) => {
                    let text = String::from_utf8_lossy(&bytes);
                    let name = if name.starts_with("data:") { "embedded" } else { &name };
                    let known = materials(name, &text, self.folder, &mut self.warnings).map_err(
                        |(line, fault)| {
                            (
                                statement.line,
                                Fault::Within { file: name.into(), line, fault: Box::new(fault) },
                            )
                        },
                    )?;
                    self.materials.extend(known);
                }
                Err(reason) => {
                    let place = format!("{}:{}: {reason}", self.file, statement.line);
                    let what = "a file of materials cannot be read";
                    Finding::note(&mut self.warnings, place, what, "put it beside the scene");
                }
            }
        }
        Ok(())
    }

    fn face(&mut self, statement: &Statement<'_>) -> Result<(), Wrong> {
        let corners =
            statement.words.iter().map(|word| self.corner(word).map_err(|fault| (statement.line, fault)));
        let corners = corners.collect::<Result<Vec<Corner>, Wrong>>()?;
        let key = (self.name.clone(), self.material.clone());
        let number = *self.numbers.entry(key).or_insert_with(|| {
            let (name, material) = (self.name.clone(), self.material.clone());
            self.groups.push(ObjGroup { name, material, line: statement.line, polygons: Vec::new() });
            self.groups.len() - 1
        });
        self.groups[number].polygons.push(vec![corners]);
        Ok(())
    }

    /// `point`, `point/place`, `point//normal` or `point/place/normal`, counted from 1, or back from the last.
    fn corner(&self, word: &str) -> Result<Corner, Fault> {
        let mut parts = word.split('/');
        let mut next = || parts.next().filter(|part| !part.is_empty());
        let wrong = || Fault::Word { found: shortened(word), wanted: "a vertex as 1, 1/2, 1//3 or 1/2/3" };
        let [point, place, normal] = [next(), next(), next()];
        let point = *pick(&self.points, point.ok_or_else(wrong)?).ok_or_else(wrong)??;
        let place = place.map(|part| pick(&self.places, part).ok_or_else(wrong)?).transpose()?;
        let normal = normal.map(|part| pick(&self.normals, part).ok_or_else(wrong)?).transpose()?;
        let (place, normal) = (place.copied().unwrap_or_default(), normal.copied().unwrap_or_default());
        Ok(Corner { point, place, normal })
    }

    fn scene(mut self) -> Result<Scene, FileError> {
        let mut surfaces = Surfaces::default();
        for (index, group) in self.groups.iter().enumerate() {
            let place = format!("{}:{}", self.file, group.line);
            let material = self.materials.get(&group.material).cloned().unwrap_or_else(|| {
                let what = "faces without a material have a reflectance of 0.5";
                Finding::note(&mut self.warnings, place.clone(), what, "give them a material with Kd");
                Mtl::default()
            });
            let polygons: Vec<Polygon> =
                group.polygons.iter().map(|polygon| laid(polygon, &material)).collect();
            let facets = facets(&polygons, is_cut(&polygons), material.finish.image.is_some());
            let name = if group.name.is_empty() { "patch" } else { &group.name };
            let origin = Origin { instance: index, primitive: 0, polygon: 0 };
            let (world, finish) = (DMat4::IDENTITY, material.finish);
            let surface =
                Surface { name, place: &place, facets: &facets, world, finish, two_sided: false, origin };
            let added = surfaces.add(&surface, &mut self.warnings);
            added.map_err(|refusal| fault(self.file, (group.line, refusal.into())))?;
        }
        Ok(Scene { patches: surfaces.named(), bands: 3, warnings: self.warnings, ..Scene::default() })
    }
}

/// The row that an index names; `None` where it is no whole number.
fn pick<'r, T>(rows: &'r [T], word: &str) -> Option<Result<&'r T, Fault>> {
    let number: i64 = word.parse().ok()?;
    let len = rows.len();
    let counted = usize::try_from(number.unsigned_abs()).ok()?;
    let index = if number < 0 { len.checked_sub(counted) } else { counted.checked_sub(1) };
    let row = index.and_then(|index| rows.get(index));
    let fault =
        if number < 0 { Fault::FromEnd { back: counted, len } } else { Fault::Index { index: counted, len } };
    Some(row.ok_or(fault))
}

/// A polygon with its places in the material's picture, v down.
fn laid(polygon: &Polygon, material: &Mtl) -> Polygon {
    let lay = |corner: &Corner| {
        let place = corner.place * material.scale + material.offset;
        Corner { place: DVec2::new(place.x, 1.0 - place.y), ..*corner }
    };
    polygon.iter().map(|ring| ring.iter().map(lay).collect()).collect()
}
