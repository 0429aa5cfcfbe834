//! Lines to surfaces.
use super::blast;
use super::fields::Fields;
use super::request::Request;
use crate::io::error::{Fault, Wrong};
use crate::scene::finding::Finding;
use glam::DVec3;

/// What a file says.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub(super) surfaces: Vec<Row>,
    pub(super) asked: Request,
    pub(super) warnings: Vec<Finding>,
}

/// A surface.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) line: usize,
    pub(super) kind: RowKind,
    /// Three or four.
    pub(super) corners: Vec<DVec3>,
    /// Number of the surface that it is cut out of; 0 for none.
    pub(super) base: usize,
    /// Number of the surface that it is one with in the results; 0 for none.
    pub(super) combined: usize,
    pub(super) emittance: f64,
    pub(super) name: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RowKind {
    Surface,
    Obstruction,
    Hole,
}

impl Rows {
    pub(super) fn parse(text: &str) -> Result<Rows, Wrong> {
        let lines = Fields::lines(text);
        let (mut rows, mut vertices, mut in_planes) = (Rows::default(), Vec::new(), false);
        let mut corners_of = Vec::new();
        let mut at = 0;
        while let Some(fields) = lines.get(at) {
            at += 1;
            match fields.letter() {
                'V' => {
                    fields.numbered(vertices.len() + 1)?;
                    vertices.push(DVec3::new(fields.number(2)?, fields.number(3)?, fields.number(4)?));
                }
                letter @ ('S' | 'N' | 'O') => {
                    let kind = match letter {
                        'S' => RowKind::Surface,
                        'N' => RowKind::Hole,
                        _ => RowKind::Obstruction,
                    };
                    fields.numbered(rows.surfaces.len() + 1)?;
                    let mut row = rows.finish(fields, kind, if in_planes { 3 } else { 6 })?;
                    if in_planes {
                        row.corners = blast::corners(fields, &lines, &mut at)?;
                    } else {
                        corners_of.push((rows.surfaces.len(), quadrangle(fields)?));
                    }
                    rows.surfaces.push(row);
                }
                'F' => in_planes = is_in_planes(fields)?,
                'C' => rows.asked.read(fields, &mut rows.warnings)?,
                'M' => {
                    let found = fields.words[0].into();
                    let wanted = "S, N or O: masks are not read, so a surface";
                    return Err((fields.line, Fault::Word { found, wanted }));
                }
                'T' | '!' | '/' => {}
                _ => {
                    let what = "lines with another first letter are not read";
                    let place = format!("line {}: {:?}", fields.line, fields.words[0]);
                    Finding::note(&mut rows.warnings, place, what, "correct the letter, or remove the line");
                }
            }
        }
        // Vertices may come behind the surfaces that they are corners of.
        for (surface, corners) in corners_of {
            let row = &mut rows.surfaces[surface];
            let vertex = |&index: &usize| {
                let vertex = index.checked_sub(1).and_then(|place| vertices.get(place));
                vertex.copied().ok_or((row.line, Fault::Index { index, len: vertices.len() }))
            };
            row.corners = corners.iter().map(vertex).collect::<Result<_, _>>()?;
        }
        rows.check()
    }

    /// The request with what the surfaces say.
    pub(super) fn request(&self) -> Request {
        let combined = self.surfaces.iter().enumerate().map(|(index, surface)| {
            (surface.kind == RowKind::Surface).then(|| surface.combined.checked_sub(1).unwrap_or(index))
        });
        Request { combined: combined.collect(), ..self.asked.clone() }
    }

    /// `base cmb emit name` from a word on; an obstruction has none of them but the name.
    fn finish(&self, fields: &Fields<'_>, kind: RowKind, from: usize) -> Result<Row, Wrong> {
        let (line, number, corners) = (fields.line, self.surfaces.len() + 1, Vec::new());
        let name = |at: usize, otherwise: &str| {
            fields.words.get(at).map_or_else(|| format!("{otherwise}-{number}"), |name| (*name).into())
        };
        if kind == RowKind::Obstruction {
            let name = name(from, "obstruction");
            return Ok(Row { line, kind, corners, base: 0, combined: 0, emittance: 1.0, name });
        }
        let (base, combined) = (fields.whole(from)?, fields.whole(from + 1)?);
        let (emittance, name) = (fields.number(from + 2)?, name(from + 3, "surface"));
        if !(0.0..=1.0).contains(&emittance) {
            let found = emittance.to_string();
            return Err((line, Fault::Word { found, wanted: "an emittance from 0 to 1" }));
        }
        Ok(Row { line, kind, corners, base, combined, emittance, name })
    }

    /// Bases are surfaces of the file; a surface is combined with an earlier one, which is with none.
    fn check(self) -> Result<Rows, Wrong> {
        let len = self.surfaces.len();
        for (row, number) in self.surfaces.iter().zip(1..) {
            if row.base > len {
                return Err((row.line, Fault::Index { index: row.base, len }));
            }
            let is_one = |other: &Row| other.kind == RowKind::Surface && other.combined == 0;
            let other = row.combined.checked_sub(1).and_then(|place| self.surfaces.get(place));
            let is_earlier = row.combined < number && other.is_some_and(is_one);
            if row.combined > 0 && (row.kind != RowKind::Surface || !is_earlier) {
                let found = format!("cmb {}", row.combined);
                let wanted = "0 or the number of an earlier surface that is not combined itself";
                return Err((row.line, Fault::Word { found, wanted }));
            }
        }
        Ok(self)
    }
}

/// The numbers of the corners: four, the last of which is 0 for a triangle.
fn quadrangle(fields: &Fields<'_>) -> Result<Vec<usize>, Wrong> {
    let mut corners = vec![fields.whole(2)?, fields.whole(3)?, fields.whole(4)?, fields.whole(5)?];
    if corners[3] == 0 {
        corners.pop();
    }
    Ok(corners)
}

/// Whether surfaces stand in planes of their own: geometry 3a, not 3.
fn is_in_planes(fields: &Fields<'_>) -> Result<bool, Wrong> {
    match fields.words.get(1).copied().unwrap_or_default() {
        "3" => Ok(false),
        "3a" | "3A" => Ok(true),
        found => Err((fields.line, Fault::Word { found: found.into(), wanted: "geometry 3 or 3a" })),
    }
}
