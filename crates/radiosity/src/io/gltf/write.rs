//! glTF 2.0 binary: the lit mesh for any viewer.
use super::buffer::{Buffer, container, single};
use super::lit::{materials, primitives};
use super::material::as_written;
use crate::expose::Exposure;
use crate::io::error::FileError;
use crate::io::upright::y_up;
use crate::record::Record;
use crate::scene::{asset::Asset, camera::Camera};
use glam::{DMat3, DMat4, DVec3};
use serde_json::{Value, json};

/// The lengths that readers know, in single precision.
const SMALLEST: f64 = f32::MIN_POSITIVE as f64;
const LARGEST: f64 = f32::MAX as f64;

/// The bytes of a GLB file: one mesh with `POSITION`, `COLOR_0` (exposed, linear) and `_RADIOSITY` (red, green and blue,
/// W/m², as it is), unlit materials, and the scene's cameras.
///
/// Patches with a picture have primitives of their own: `_IRRADIANCE` is the irradiance times the factor of the picture's
/// colours, and `COLOR_0` is its exposed form, which viewers multiply with the picture. The root node turns the scene's up axis
/// to y and its unit to metres. Positions are in single precision, relative to the middle of the mesh.
///
/// # Errors
/// [`FileError::Size`] when the data exceed the format's 4 GiB.
pub fn glb(record: &Record, exposure: Exposure) -> Result<Vec<u8>, FileError> {
    let (middle, radius) = ball(&record.vertices);
    let mut buffer = Buffer::default();
    let mut document = json!({
        "asset": {
            "version": "2.0",
            "generator": concat!("radiosity ", env!("CARGO_PKG_VERSION")),
            "extras": {"exposure": exposure.k()},
        },
        "scene": 0,
        "scenes": [{"nodes": [0]}],
    });
    let mut nodes = vec![json!({"name": "scene", "matrix": upright(&record.asset).to_cols_array()})];
    let primitives = primitives(&mut buffer, record, middle, exposure);
    if !primitives.is_empty() {
        document["meshes"] = json!([{"name": "light", "primitives": primitives}]);
        materials(&mut document, &mut buffer, record);
        document["extensionsUsed"] = json!(["KHR_materials_unlit"]);
        document["accessors"] = buffer.accessors.clone().into();
        document["bufferViews"] = buffer.views.clone().into();
        document["buffers"] = json!([{"byteLength": buffer.bytes.len()}]);
        nodes.push(json!({"name": "light", "mesh": 0, "translation": middle.to_array()}));
    }
    let near = 1e-3 * radius * record.asset.unit;
    let lenses: Vec<Value> = record.cameras.iter().map(|camera| lens(camera, near)).collect();
    if !lenses.is_empty() {
        document["cameras"] = lenses.into();
        nodes.extend(record.cameras.iter().enumerate().map(|(index, camera)| camera_node(index, camera)));
    }
    if nodes.len() > 1 {
        nodes[0]["children"] = (1..nodes.len()).collect();
    }
    document["nodes"] = nodes.into();
    container(&document, buffer.bytes)
}

/// The middle of the box around some points, as readers will have it; and half the box's diagonal.
pub(super) fn ball(points: &[DVec3]) -> (DVec3, f64) {
    let boxes = points.iter().map(|point| (*point, *point));
    let around = boxes.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    let (low, high) = around.unwrap_or((DVec3::ZERO, DVec3::ONE));
    (held(low.midpoint(high)), (high / 2.0 - low / 2.0).length())
}

/// A place as readers will have it: of the digits that single precision needs.
fn held(place: DVec3) -> DVec3 {
    place.map(|coordinate| as_written(single(coordinate)))
}

/// From the file's units and axes to metres with y up; right stays right where the format has a right.
pub(super) fn upright(asset: &Asset) -> DMat4 {
    DMat4::from_mat3(y_up(asset.up) * asset.unit.clamp(SMALLEST, LARGEST))
}

pub(super) fn lens(camera: &Camera, near: f64) -> Value {
    let near = near.clamp(SMALLEST, LARGEST);
    json!({
        "name": camera.name,
        "type": "perspective",
        "perspective": {"yfov": camera.vertical_fov, "aspectRatio": camera.aspect, "znear": near},
    })
}

/// A camera looks along its node's −z with y up.
pub(super) fn camera_node(index: usize, camera: &Camera) -> Value {
    let back = -camera.direction.normalize();
    let right = camera.up.cross(back).normalize();
    let turn = DMat4::from_mat3(DMat3::from_cols(right, back.cross(right), back));
    let matrix = DMat4::from_translation(held(camera.position)) * turn;
    json!({"name": camera.name, "camera": index, "matrix": matrix.to_cols_array()})
}
