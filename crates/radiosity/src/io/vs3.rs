//! View3D's input files (`.vs3`, geometry `3`): vertices, and surfaces of three or four vertices.
//!
//! A surface becomes a one-sided patch with reflectance 1 − emittance and without emission. A surface that has a base surface
//! is cut out of it; a null surface is a hole in its base; an obstruction only blocks.
use super::error::{Fault, FileError};
use crate::plane::Plane;
use crate::scene::{
    Scene,
    finding::Finding,
    patch::{Origin, Patch},
};
use formfactor::PlanarPolygon;
use glam::DVec3;
use polycsg::{Csg, FillRule, Region};
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
        let bytes = std::fs::read(path).map_err(|source| FileError::Read { path: path.into(), source })?;
        Ok(Self::from_text(path.display().to_string(), String::from_utf8_lossy(&bytes)))
    }

    /// A text as the contents of a file; messages show its `name`.
    pub fn from_text(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { name: name.into(), text: text.into() }
    }

    /// The scene: one band, z up (the format has no up axis).
    ///
    /// # Errors
    /// [`FileError::Line`], with the line.
    pub fn scene(&self) -> Result<Scene, FileError> {
        let lines = lines(&self.text);
        let (vertices, surfaces, warnings) =
            lines.and_then(parse).map_err(|(line, fault)| self.fault(line, fault))?;
        let mut scene = Scene { bands: 1, warnings, ..Scene::default() };
        scene.asset.up = DVec3::Z;
        let mut taken = HashSet::new();
        for (index, surface) in
            surfaces.iter().enumerate().filter(|(_, surface)| surface.kind != RowKind::Hole)
        {
            let holes: Vec<&Row> = surfaces.iter().filter(|part| part.base == index + 1).collect();
            let polygons = shape(surface, &holes, &vertices)
                .map_err(|source| self.fault(surface.line, Fault::Shape { polygon: index, source }))?;
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
        }
        Ok(scene)
    }

    fn fault(&self, line: usize, fault: Fault) -> FileError {
        FileError::Line { file: self.name.clone(), line, fault }
    }
}

/// A surface's line.
struct Row {
    line: usize,
    kind: RowKind,
    corners: Vec<usize>,
    /// Number of the surface that it is cut out of; 0 for none.
    base: usize,
    emittance: f64,
    name: String,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum RowKind {
    Surface,
    Obstruction,
    Hole,
}

/// A fault and its line.
type Wrong = (usize, Fault);

/// The lines that say something, by number; none behind the one that ends the data.
fn lines(text: &str) -> Result<Vec<(usize, Vec<&str>)>, Wrong> {
    let words = text.lines().zip(1..).map(|(line, number)| {
        (
            number,
            line.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty()).collect(),
        )
    });
    let ends = |words: &Vec<&str>| words[0].starts_with(['E', 'e', '*']);
    let said = words.filter(|(_, words): &(usize, Vec<&str>)| !words.is_empty());
    Ok(said.take_while(|(_, words)| !ends(words)).collect())
}

type Parsed = (Vec<DVec3>, Vec<Row>, Vec<Finding>);

fn parse(lines: Vec<(usize, Vec<&str>)>) -> Result<Parsed, Wrong> {
    let (mut vertices, mut surfaces, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
    for (line, words) in lines {
        let fields = Fields { line, words: &words };
        match words[0].chars().next().map(|letter| letter.to_ascii_uppercase()) {
            Some('V') => {
                fields.numbered(vertices.len() + 1)?;
                vertices.push(DVec3::new(fields.number(2)?, fields.number(3)?, fields.number(4)?));
            }
            Some('S') => {
                surfaces.push(fields.surface(surfaces.len() + 1, RowKind::Surface, &mut warnings)?)
            }
            Some('N') => surfaces.push(fields.surface(surfaces.len() + 1, RowKind::Hole, &mut warnings)?),
            Some('O') => {
                surfaces.push(fields.surface(surfaces.len() + 1, RowKind::Obstruction, &mut warnings)?)
            }
            Some('F') if words.get(1) != Some(&"3") => {
                let found = words.get(1).copied().unwrap_or_default().into();
                return Err((line, Fault::Word { found, wanted: "geometry 3" }));
            }
            Some('M') => {
                let found = words[0].into();
                return Err((
                    line,
                    Fault::Word { found, wanted: "S, N or O: masks are not read, so a surface" },
                ));
            }
            Some('T' | 'F' | 'C' | '!' | '/') => {}
            _ => {
                let what = format!("line {line}: {:?} is not read", words[0]);
                warnings.push(Finding::of_file(what, "correct its first letter, or remove the line"));
            }
        }
    }
    let len = vertices.len();
    for row in &surfaces {
        if let Some(&index) = row.corners.iter().find(|&&index| index == 0 || index > len) {
            return Err((row.line, Fault::Index { index, len }));
        }
        if row.base > surfaces.len() {
            return Err((row.line, Fault::Index { index: row.base, len: surfaces.len() }));
        }
    }
    Ok((vertices, surfaces, warnings))
}

/// The words of a line.
struct Fields<'l> {
    line: usize,
    words: &'l [&'l str],
}

impl Fields<'_> {
    fn word(&self, at: usize) -> Result<&str, Wrong> {
        let found = self.words.get(at).copied();
        found.ok_or((self.line, Fault::Count { found: self.words.len(), wanted: at + 1 }))
    }

    fn number(&self, at: usize) -> Result<f64, Wrong> {
        let word = self.word(at)?;
        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| (self.line, Fault::Number(word.chars().take(40).collect())))
    }

    fn whole(&self, at: usize) -> Result<usize, Wrong> {
        let word = self.word(at)?;
        word.parse().map_err(|_| (self.line, Fault::Whole(word.chars().take(40).collect())))
    }

    /// Vertices and surfaces are numbered from 1, in order.
    fn numbered(&self, expected: usize) -> Result<(), Wrong> {
        match self.whole(1)? {
            number if number == expected => Ok(()),
            number => Err((
                self.line,
                Fault::Word { found: number.to_string(), wanted: "the next number in sequence" },
            )),
        }
    }

    /// `n v1 v2 v3 v4 base cmb emit name`; an obstruction ends behind its vertices.
    fn surface(&self, number: usize, kind: RowKind, warnings: &mut Vec<Finding>) -> Result<Row, Wrong> {
        self.numbered(number)?;
        let corners = [self.whole(2)?, self.whole(3)?, self.whole(4)?, self.whole(5)?];
        let mut corners = corners.to_vec();
        if corners[3] == 0 {
            corners.pop();
        }
        if kind == RowKind::Obstruction {
            let name =
                self.words.get(6).map_or_else(|| format!("obstruction-{number}"), |name| (*name).into());
            return Ok(Row { line: self.line, kind, corners, base: 0, emittance: 1.0, name });
        }
        let (base, combined, emittance) = (self.whole(6)?, self.whole(7)?, self.number(8)?);
        if !(0.0..=1.0).contains(&emittance) {
            return Err((
                self.line,
                Fault::Word { found: emittance.to_string(), wanted: "an emittance from 0 to 1" },
            ));
        }
        if combined > 0 {
            let what = format!("line {}: surfaces are not combined; {number} stays its own", self.line);
            warnings.push(Finding::of_file(what, "add up its factors yourself"));
        }
        let name = self.words.get(9).map_or_else(|| format!("surface-{number}"), |name| (*name).into());
        Ok(Row { line: self.line, kind, corners, base, emittance, name })
    }
}

/// A surface without the parts that are cut out of it.
fn shape(surface: &Row, parts: &[&Row], vertices: &[DVec3]) -> Result<Vec<PlanarPolygon>, formfactor::Error> {
    let points = |row: &Row| without_repeats(row.corners.iter().map(|corner| vertices[corner - 1]).collect());
    let whole = PlanarPolygon::new([points(surface)])?;
    if parts.is_empty() {
        return Ok(vec![whole]);
    }
    let plane = Plane::of(&whole);
    let region = |row: &Row| {
        let flat: Vec<_> = points(row).into_iter().map(|point| plane.flatten(point)).collect();
        Region::from_rings([flat], FillRule::NonZero).unwrap_or_default()
    };
    let holes: Vec<Region> = parts.iter().map(|part| region(part)).collect();
    let rest = (Csg::from(&region(surface)) - Csg::union(&holes)).evaluate();
    Ok(plane.lift(&rest, &[&whole]))
}

/// The points without those that stand twice in a row, the last before the first included.
fn without_repeats(mut points: Vec<DVec3>) -> Vec<DVec3> {
    points.dedup();
    while points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    points
}
