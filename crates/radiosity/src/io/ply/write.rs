//! PLY out, binary: scenes with a colour for each face, and lit meshes with light at each vertex.
use crate::expose::{Exposure, srgb};
use crate::io::collada::model::Model;
use crate::io::surface::cut;
use crate::io::upright::y_up;
use crate::io::words::TOOL;
use crate::record::Record;
use crate::scene::{Scene, patch::Patch};
use glam::DVec3;
use std::collections::HashMap;

/// A scene, turned to y up: the reflectance of each patch, in sRGB, is the colour of its faces. Patches with holes, and those of more than 255 vertices,
/// are cut into triangles. The format has no light, no textures and no names.
#[must_use]
pub fn ply(scene: &Scene) -> Vec<u8> {
    let model = Model::of(scene);
    let (mut points, mut numbers, mut faces) = (Vec::new(), HashMap::new(), Vec::new());
    for (patch, face) in scene.patches.iter().zip(&model.faces) {
        let [reflectance, _] = model.materials[face.material].colours(&model.wavelengths);
        for ring in rings(patch) {
            let number = |point: &DVec3| {
                *numbers.entry(point.to_array().map(|number| (number + 0.0).to_bits())).or_insert_with(|| {
                    points.push(*point);
                    points.len() - 1
                })
            };
            let corners: Vec<usize> = ring.iter().map(number).collect();
            faces.push((corners, reflectance.map(byte)));
        }
    }
    let mut bytes = header(
        points.len(),
        "",
        faces.len(),
        "property uchar red\nproperty uchar green\nproperty uchar blue\n",
    );
    let turn = y_up(scene.asset.up);
    for point in points {
        bytes.extend((turn * point).to_array().into_iter().flat_map(f64::to_le_bytes));
    }
    for (corners, colour) in faces {
        add_face(&mut bytes, &corners);
        bytes.extend(colour);
    }
    bytes
}

/// The outline of a patch, or triangles where it has holes or too many vertices.
fn rings(patch: &Patch) -> Vec<Vec<DVec3>> {
    let mut loops = patch.polygon.loops();
    match (loops.next(), loops.next()) {
        (Some(outline), None) if outline.len() < 256 => vec![outline.to_vec()],
        _ => cut(patch).iter().map(|triangle| triangle.map(|corner| corner.point).to_vec()).collect(),
    }
}

/// A lit mesh, turned to y up: at each vertex the exposed colour in sRGB, and the radiosity itself, W/m², as `radiosity_red` and so on.
#[must_use]
pub fn lit(record: &Record, exposure: Exposure) -> Vec<u8> {
    let colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n\
                   property float radiosity_red\nproperty float radiosity_green\nproperty float radiosity_blue\n";
    let mut bytes = header(record.vertices.len(), colours, record.elements.len(), "");
    let turn = y_up(record.asset.up);
    for (point, colour) in record.vertices.iter().zip(record.colours()) {
        bytes.extend((turn * *point).to_array().into_iter().flat_map(f64::to_le_bytes));
        bytes.extend(exposure.intensity(colour).map(byte));
        bytes.extend(colour.into_iter().flat_map(|band| single(band).to_le_bytes()));
    }
    for &[_, a, b, c] in &record.elements {
        add_face(&mut bytes, &[a, b, c]);
    }
    bytes
}

fn header(vertices: usize, of_vertex: &str, faces: usize, of_face: &str) -> Vec<u8> {
    format!(
        "ply\nformat binary_little_endian 1.0\ncomment {TOOL}\nelement vertex {vertices}\nproperty double x\nproperty double y\n\
         property double z\n{of_vertex}element face {faces}\nproperty list uchar int vertex_indices\n{of_face}end_header\n"
    )
    .into_bytes()
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "fewer than 256 corners; more vertices than 2^31 fit no memory"
)]
fn add_face(bytes: &mut Vec<u8>, corners: &[usize]) {
    bytes.push(corners.len() as u8);
    bytes.extend(corners.iter().flat_map(|corner| (*corner as i32).to_le_bytes()));
}

/// A linear intensity as a byte in sRGB.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
fn byte(intensity: f64) -> u8 {
    (255.0 * srgb(intensity.clamp(0.0, 1.0))).round() as u8
}

#[allow(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
fn single(number: f64) -> f32 {
    (number as f32).clamp(f32::MIN, f32::MAX)
}
