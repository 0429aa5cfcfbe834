//! OBJ out: scenes with their materials, and lit meshes with colours at their vertices.
use crate::expose::{Exposure, srgb};
use crate::io::collada::model::{Material, Model};
use crate::io::surface::cut;
use crate::io::upright::y_up;
use crate::io::words::{TOOL, decimal, list};
use crate::record::Record;
use crate::scene::{Scene, patch::Patch};
use glam::{DMat3, DVec2, DVec3};
use std::fmt::Write;

/// A scene as OBJ, and the files that go beside it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ObjFiles {
    /// The text of the OBJ file. It names its file of materials.
    pub obj: String,
    /// The name of the file of materials, and its text.
    pub mtl: (String, String),
    /// The names of pictures, and their bytes.
    pub pictures: Vec<(String, Vec<u8>)>,
}

/// A scene, turned to y up, with an object for each patch. Patches with holes are cut into triangles. The files that go beside are named after the stem.
#[must_use]
pub fn text(scene: &Scene, stem: &str) -> ObjFiles {
    let model = Model::of(scene);
    let mtl_name = format!("{stem}.mtl");
    let mut obj = format!("# {TOOL}\nmtllib {mtl_name}\n");
    let (mut counts, turn) = ([0, 0], y_up(scene.asset.up));
    for (patch, face) in scene.patches.iter().zip(&model.faces) {
        // Writing to a string cannot fail.
        let _ = writeln!(obj, "o {}\nusemtl {}", patch.name, model.materials[face.material].name);
        object(&mut obj, patch, &turn, &mut counts);
    }
    let textured = model.materials.iter().filter_map(|material| Some((material, material.texture.as_ref()?)));
    let pictures =
        textured.map(|(material, texture)| (picture_name(stem, material), texture.image.bytes.clone()));
    let materials: String =
        model.materials.iter().map(|material| newmtl(material, &model.wavelengths, stem)).collect();
    ObjFiles { obj, mtl: (mtl_name, format!("# {TOOL}\n{materials}")), pictures: pictures.collect() }
}

/// A patch's vertices and faces; `counts` are those of all vertices and places in pictures so far.
fn object(text: &mut String, patch: &Patch, turn: &DMat3, counts: &mut [usize; 2]) {
    let outline: Vec<DVec3> = patch.polygon.loops().next().unwrap_or_default().to_vec();
    let is_whole = patch.polygon.loops().count() == 1;
    let rings: Vec<Vec<DVec3>> = match is_whole {
        true => vec![outline],
        false => cut(patch).iter().map(|triangle| triangle.map(|corner| corner.point).to_vec()).collect(),
    };
    for ring in rings {
        let mut face = Vec::new();
        for point in &ring {
            let place = *turn * *point;
            let _ = writeln!(text, "v {}", list(place.to_array().iter().map(decimal)));
            counts[0] += 1;
            if let Some(texture) = &patch.texture {
                let DVec2 { x, y } = texture.place(*point);
                let _ = writeln!(text, "vt {} {}", decimal(&x), decimal(&(1.0 - y)));
                counts[1] += 1;
            }
            face.push(match patch.texture {
                None => counts[0].to_string(),
                Some(_) => format!("{}/{}", counts[0], counts[1]),
            });
        }
        let _ = writeln!(text, "f {}", face.join(" "));
    }
}

fn newmtl(material: &Material, wavelengths: &[f64], stem: &str) -> String {
    let [reflectance, emission] = material.colours(wavelengths);
    let factor = material.texture.as_ref().map_or(reflectance, |texture| texture.factor);
    let [diffuse, emitted] = [factor, emission].map(|colour| list(colour.iter().map(decimal)));
    let map = match material.texture {
        None => String::new(),
        Some(_) => format!("map_Kd {}\n", picture_name(stem, material)),
    };
    format!("newmtl {}\nKd {diffuse}\nKe {emitted}\n{map}", material.name)
}

fn picture_name(stem: &str, material: &Material) -> String {
    let mime = material.texture.as_ref().map_or("image/png", |texture| texture.image.mime);
    format!("{stem}-{}.{}", material.name, mime.trim_start_matches("image/"))
}

/// A lit mesh, turned to y up: behind each vertex's position its exposed colour in sRGB, 0 to 1, as many programs read it.
#[must_use]
pub fn lit(record: &Record, exposure: Exposure) -> String {
    let mut text = format!("# {TOOL}: light of {}\n", record.scene.replace(['\n', '\r'], " "));
    let turn = y_up(record.asset.up);
    for (point, colour) in record.vertices.iter().zip(record.colours()) {
        let place = turn * *point;
        let shown = exposure.intensity(colour).map(srgb);
        let _ = writeln!(
            text,
            "v {} {}",
            list(place.to_array().iter().map(decimal)),
            list(shown.iter().map(|band| format!("{band:.4}")))
        );
    }
    let mut last = None;
    for &[patch, a, b, c] in &record.elements {
        if last.replace(patch) != Some(patch) {
            let _ = writeln!(text, "o {}", record.patches[patch].name);
        }
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text
}
