//! Vertices and faces to patches: of each colour one surface for all triangles, and one for all other faces.
use super::body::{PlyBody, whole};
use super::header::{Header, NumberType, PlyElement, Property};
use crate::image_file;
use crate::io::error::{Fault, FileError};
use crate::io::surface::facets;
use crate::io::surface::finish::{Finish, Surface};
use crate::io::surface::place::Surfaces;
use crate::io::surface::polygon::{Corner, Polygon};
use crate::scene::{Scene, finding::Finding, patch::Origin, texture::Image};
use glam::{DMat4, DVec2};
use std::collections::BTreeMap;
use std::{path::Path, sync::Arc};

/// The reflectance of a face that says nothing.
const DEFAULT_REFLECTANCE: [f64; 3] = [0.5; 3];

pub(super) fn scene(file: &str, bytes: &[u8], folder: Option<&Path>) -> Result<Scene, FileError> {
    let mesh = PlyMesh::read(file, bytes)?;
    let (mut warnings, mut surfaces) = (Vec::new(), Surfaces::default());
    mesh.tell(file, &mut warnings);
    let image = mesh.picture.as_ref().and_then(|name| picture(file, name, folder, &mut warnings));
    let mut groups: BTreeMap<([u64; 3], bool), Vec<Polygon>> = BTreeMap::new();
    for (polygon, colour) in mesh.polygons(file)? {
        let is_triangle = polygon.len() == 3;
        groups.entry((colour.map(f64::to_bits), is_triangle)).or_default().push(vec![polygon]);
    }
    for (primitive, ((colour, is_cut), polygons)) in groups.into_iter().enumerate() {
        let reflectance = if image.is_some() { [1.0; 3] } else { colour.map(f64::from_bits) };
        let (material, emission) = ("".into(), [0.0; 3]);
        let finish = Finish { material, reflectance, emission, image: image.clone(), spectra: None };
        let facets = facets(&polygons, is_cut, image.is_some());
        let origin = Origin { instance: 0, primitive, polygon: 0 };
        let (name, place, world) = ("patch", file, DMat4::IDENTITY);
        let surface = Surface { name, place, facets: &facets, world, finish, two_sided: false, origin };
        surfaces.add(&surface, &mut warnings).map_err(|refusal| part(file, "faces", refusal.into()))?;
    }
    Ok(Scene { patches: surfaces.named(), bands: 3, warnings, ..Scene::default() })
}

fn part(file: &str, part: &str, fault: Fault) -> FileError {
    FileError::Part { file: file.into(), part: part.into(), fault }
}

fn picture(file: &str, name: &str, folder: Option<&Path>, warnings: &mut Vec<Finding>) -> Option<Arc<Image>> {
    let read = image_file::fetch(name, folder).map(Arc::new);
    let told = read.map_err(|reason| {
        let what = "a texture cannot be read; the faces' own colours are taken";
        let repair = "put the picture beside the file, as PNG or JPEG";
        Finding::note(warnings, format!("{file}: {reason}"), what, repair);
    });
    told.ok()
}

/// The corners of a face, and its reflectance.
type ColouredFace = (Vec<Corner>, [f64; 3]);

/// What a row says of one vertex.
#[derive(Clone, Copy, Debug, Default)]
struct PlyVertex {
    corner: Corner,
    colour: [Option<f64>; 3],
}

/// What a row says of one face, or of a run of strips.
#[derive(Clone, Debug, Default)]
struct PlyFace {
    corners: Vec<f64>,
    /// Two numbers for each corner.
    places: Vec<f64>,
    colour: [Option<f64>; 3],
}

#[derive(Debug, Default)]
struct PlyMesh {
    vertices: Vec<PlyVertex>,
    faces: Vec<PlyFace>,
    strips: Vec<PlyFace>,
    picture: Option<String>,
    /// The names of elements that are none of these.
    others: Vec<String>,
}

impl PlyMesh {
    fn read(file: &str, bytes: &[u8]) -> Result<PlyMesh, FileError> {
        let header = Header::parse(bytes).map_err(|(line, fault)| FileError::Line {
            file: file.into(),
            line,
            fault,
        })?;
        header.check().map_err(|(element, fault)| part(file, element, fault))?;
        let mut mesh = PlyMesh { picture: header.picture.clone(), ..PlyMesh::default() };
        let mut body = PlyBody::new(bytes, &header);
        for element in &header.elements {
            mesh.element(element, &mut body).map_err(|(row, fault)| match body.line() {
                Some(line) => FileError::Line { file: file.into(), line, fault },
                None => part(file, &format!("{} {row}", element.name), fault),
            })?;
        }
        Ok(mesh)
    }

    fn element(&mut self, element: &PlyElement, body: &mut PlyBody<'_>) -> Result<(), (usize, Fault)> {
        match element.name.as_str() {
            "vertex" => body.rows(element, |row, property, numbers| {
                self.vertices.resize_with(row + 1, PlyVertex::default);
                self.vertices[row].set(property, numbers);
                Ok(())
            }),
            "face" => {
                body.rows(element, |row, property, numbers| set(&mut self.faces, row, property, numbers))
            }
            "tristrips" => {
                body.rows(element, |row, property, numbers| set(&mut self.strips, row, property, numbers))
            }
            name => {
                if element.count > 0 {
                    self.others.push(name.chars().take(40).collect());
                }
                body.rows(element, |_, _, _| Ok(()))
            }
        }
    }

    fn tell(&self, file: &str, warnings: &mut Vec<Finding>) {
        for name in &self.others {
            let what = "elements that are neither vertices, faces nor strips are left out";
            Finding::note(warnings, format!("{file}: {name}"), what, "turn them into faces");
        }
        if self.faces.is_empty() && self.strips.is_empty() && !self.vertices.is_empty() {
            let what = "points have no area; they are left out";
            Finding::note(warnings, file, what, "make surfaces of them");
        }
    }

    /// Every face and every triangle of a strip, with its reflectance.
    fn polygons(&self, file: &str) -> Result<Vec<ColouredFace>, FileError> {
        let strips = self.strips.iter().flat_map(strip_triangles);
        let all = self.faces.iter().cloned().chain(strips);
        let polygon = |(index, face): (usize, PlyFace)| {
            self.polygon(&face).map_err(|fault| part(file, &format!("face {index}"), fault))
        };
        all.enumerate().map(polygon).collect()
    }

    fn polygon(&self, face: &PlyFace) -> Result<ColouredFace, Fault> {
        let (mut corners, mut sum, mut is_coloured) = (Vec::new(), [0.0; 3], true);
        for (place, number) in face.corners.iter().enumerate() {
            let (index, len) = (whole(*number)?, self.vertices.len());
            let vertex = self.vertices.get(index).ok_or(Fault::Index { index, len })?;
            let mut corner = vertex.corner;
            if let Some(&[u, v]) = face.places.get(2 * place..2 * place + 2) {
                corner.place = DVec2::new(u, 1.0 - v);
            }
            corners.push(corner);
            is_coloured &= vertex.colour.iter().all(Option::is_some);
            sum = std::array::from_fn(|band| sum[band] + vertex.colour[band].unwrap_or_default());
        }
        let count = corners.len() as f64;
        let colour = match face.colour {
            [Some(red), Some(green), Some(blue)] => [red, green, blue],
            _ if is_coloured && count > 0.0 => sum.map(|band| band / count),
            _ => DEFAULT_REFLECTANCE,
        };
        Ok((corners, colour))
    }
}

fn set(faces: &mut Vec<PlyFace>, row: usize, property: &Property, numbers: &[f64]) -> Result<(), Fault> {
    faces.resize_with(row + 1, PlyFace::default);
    let face = &mut faces[row];
    match (property.name.as_str(), property.length) {
        ("vertex_indices" | "vertex_index", Some(_)) => face.corners = numbers.to_vec(),
        ("texcoord", Some(_)) => face.places = numbers.to_vec(),
        (name, None) => tint(&mut face.colour, name, property.number, numbers[0])?,
        _ => {}
    }
    Ok(())
}

impl PlyVertex {
    fn set(&mut self, property: &Property, numbers: &[f64]) {
        let (None, &[number]) = (property.length, numbers) else { return };
        let Corner { point, place, normal } = &mut self.corner;
        match property.name.as_str() {
            "x" => point.x = number,
            "y" => point.y = number,
            "z" => point.z = number,
            "nx" => normal.x = number,
            "ny" => normal.y = number,
            "nz" => normal.z = number,
            "s" | "u" | "texture_u" => place.x = number,
            // The picture's rows are counted from below.
            "t" | "v" | "texture_v" => place.y = 1.0 - number,
            // A negative colour of a vertex is as good as none.
            name => tint(&mut self.colour, name, property.number, number).unwrap_or_default(),
        }
    }
}

/// A band of a colour: whole numbers are sRGB up to their type's largest, others linear.
fn tint(colour: &mut [Option<f64>; 3], name: &str, kind: NumberType, number: f64) -> Result<(), Fault> {
    let Some(band) = ["red", "green", "blue"].iter().position(|known| *known == name) else { return Ok(()) };
    if number < 0.0 {
        return Err(Fault::Negative { what: "colour", value: number });
    }
    colour[band] = Some(match kind {
        NumberType::U8 => image_file::linear(number / 255.0),
        NumberType::U16 => image_file::linear(number / 65535.0),
        _ => number,
    });
    Ok(())
}

/// The triangles of a run of strips, which −1 parts; every second one of a strip is turned.
fn strip_triangles(run: &PlyFace) -> impl Iterator<Item = PlyFace> {
    run.corners.split(|number| *number < 0.0).flat_map(|strip| {
        strip.windows(3).enumerate().map(|(index, ends)| {
            let corners = if index % 2 == 0 { ends.to_vec() } else { vec![ends[1], ends[0], ends[2]] };
            PlyFace { corners, places: Vec::new(), colour: run.colour }
        })
    })
}
