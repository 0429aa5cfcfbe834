//! glTF 2.0 binary: the lit mesh for any viewer.
use super::super::Error;
use crate::expose::Exposure;
use crate::{Asset, Camera, Mesh, Scene};
use glam::{DMat3, DMat4, DVec3};
use serde_json::{Value, json};

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The bytes of a GLB file: one mesh with `POSITION`, `COLOR_0` (exposed, linear) and `_RADIOSITY` (W/m², as it is), an
/// unlit material, and the scene's cameras.
///
/// `radiosity` is red, green and blue at every vertex of the mesh. The root node turns the scene's up axis to y and its
/// unit to metres. Positions are single precision, relative to the middle of the mesh.
///
/// # Errors
/// [`Error::Size`] when the data do not fit into the format's 4 GiB.
///
/// # Panics
/// When `radiosity` is shorter than the mesh's vertices.
pub fn glb(scene: &Scene, mesh: &Mesh, radiosity: &[[f64; 3]], exposure: Exposure) -> Result<Vec<u8>, Error> {
    let (middle, radius) = ball(mesh);
    let mut buffer = Buffer::default();
    let mut document = json!({
        "asset": {"version": "2.0", "generator": concat!("radiosity ", env!("CARGO_PKG_VERSION"))},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
    });
    let mut nodes = vec![json!({"name": "scene", "matrix": upright(&scene.asset).to_cols_array()})];
    if !mesh.elements.is_empty() {
        document["meshes"] = json!([lit_mesh(&mut buffer, mesh, middle, radiosity, exposure)]);
        document["materials"] = json!([{"name": "radiosity", "extensions": {"KHR_materials_unlit": {}}}]);
        document["extensionsUsed"] = json!(["KHR_materials_unlit"]);
        document["accessors"] = buffer.accessors.clone().into();
        document["bufferViews"] = buffer.views.clone().into();
        document["buffers"] = json!([{"byteLength": buffer.bytes.len()}]);
        nodes.push(json!({"name": "light", "mesh": 0, "translation": middle.to_array()}));
    }
    let lenses: Vec<Value> =
        scene.cameras.iter().map(|camera| lens(camera, 1e-3 * radius * scene.asset.unit)).collect();
    if !lenses.is_empty() {
        document["cameras"] = lenses.into();
        nodes.extend(scene.cameras.iter().enumerate().map(|(index, camera)| camera_node(index, camera)));
    }
    if nodes.len() > 1 {
        nodes[0]["children"] = (1..nodes.len()).collect();
    }
    document["nodes"] = nodes.into();
    container(&document, buffer.bytes)
}

/// The middle of the box around the mesh, and half the box's diagonal.
fn ball(mesh: &Mesh) -> (DVec3, f64) {
    let points = mesh.vertices.iter().map(|point| (*point, *point));
    let around = points.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    let (low, high) = around.unwrap_or((DVec3::ZERO, DVec3::ONE));
    (low.midpoint(high), (high - low).length() / 2.0)
}

/// From the file's units and axes to metres with y up; right stays right where the format has a right.
fn upright(asset: &Asset) -> DMat4 {
    let turn = if asset.up.z > 0.0 {
        DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y)
    } else if asset.up.x > 0.0 {
        DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z)
    } else {
        DMat3::IDENTITY
    };
    DMat4::from_mat3(turn * asset.unit)
}

fn lit_mesh(
    buffer: &mut Buffer,
    mesh: &Mesh,
    middle: DVec3,
    radiosity: &[[f64; 3]],
    exposure: Exposure,
) -> Value {
    let positions = buffer.vectors(mesh.vertices.iter().map(|point| (*point - middle).to_array()));
    let lit = &radiosity[..mesh.vertices.len()];
    let colours = buffer.vectors(lit.iter().map(|colour| exposure.intensity(*colour)));
    let raw = buffer.vectors(lit.iter().copied());
    let indices = buffer.indices(mesh.elements.iter().flat_map(|element| element.corners));
    let attributes = json!({"POSITION": positions, "COLOR_0": colours, "_RADIOSITY": raw});
    json!({"name": "light", "primitives": [{"attributes": attributes, "indices": indices, "material": 0}]})
}

fn lens(camera: &Camera, near: f64) -> Value {
    let near = if near > 0.0 { near } else { 1e-3 };
    json!({
        "name": camera.name,
        "type": "perspective",
        "perspective": {"yfov": camera.vertical_fov, "aspectRatio": camera.aspect, "znear": near},
    })
}

/// A camera looks along its node's −z with y up.
fn camera_node(index: usize, camera: &Camera) -> Value {
    let back = -camera.direction.normalize();
    let right = camera.up.cross(back).normalize();
    let turn = DMat4::from_mat3(DMat3::from_cols(right, back.cross(right), back));
    let matrix = DMat4::from_translation(camera.position) * turn;
    json!({"name": camera.name, "camera": index, "matrix": matrix.to_cols_array()})
}

/// The binary chunk with its views and accessors, one of each per attribute.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Adds vectors of three; returns the accessor. Its bounds are those of the rounded values.
    fn vectors(&mut self, rows: impl Iterator<Item = [f64; 3]>) -> usize {
        let rows: Vec<[f32; 3]> = rows.map(|row| row.map(single)).collect();
        let bound = |pick: fn(f32, f32) -> f32| {
            let all = rows.iter().copied();
            all.reduce(|a, b| std::array::from_fn(|axis| pick(a[axis], b[axis]))).unwrap_or_default()
        };
        let accessor = json!({
            "bufferView": self.views.len(), "componentType": FLOAT, "count": rows.len(), "type": "VEC3",
            "min": bound(f32::min), "max": bound(f32::max),
        });
        self.add(rows.iter().flatten().flat_map(|number| number.to_le_bytes()), ARRAY_BUFFER, accessor)
    }

    fn indices(&mut self, indices: impl Iterator<Item = usize>) -> usize {
        #[allow(
            clippy::cast_possible_truncation,
            reason = "more vertices do not fit into the container, which is checked"
        )]
        let indices: Vec<u32> = indices.map(|index| index as u32).collect();
        let accessor = json!({
            "bufferView": self.views.len(), "componentType": UNSIGNED_INT, "count": indices.len(), "type": "SCALAR",
        });
        self.add(indices.iter().flat_map(|index| index.to_le_bytes()), ELEMENT_ARRAY_BUFFER, accessor)
    }

    fn add(&mut self, bytes: impl Iterator<Item = u8>, target: u32, accessor: Value) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        let length = self.bytes.len() - offset;
        self.views.push(json!({"buffer": 0, "byteOffset": offset, "byteLength": length, "target": target}));
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

/// Rounds to single precision; glTF knows no infinity.
#[allow(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
fn single(number: f64) -> f32 {
    (number as f32).clamp(f32::MIN, f32::MAX)
}

/// Header, JSON chunk, binary chunk, each padded to four bytes.
fn container(document: &Value, mut binary: Vec<u8>) -> Result<Vec<u8>, Error> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let chunks = [(b"JSON", text), (b"BIN\0", binary)];
    let chunks = chunks.iter().filter(|(_, bytes)| !bytes.is_empty());
    let total = 12 + chunks.clone().map(|(_, bytes)| 8 + bytes.len()).sum::<usize>();
    let mut file = b"glTF".to_vec();
    file.extend(2_u32.to_le_bytes());
    file.extend(length(total)?);
    for (name, bytes) in chunks {
        file.extend(length(bytes.len())?);
        file.extend(*name);
        file.extend(bytes);
    }
    Ok(file)
}

fn length(bytes: usize) -> Result<[u8; 4], Error> {
    u32::try_from(bytes).map(u32::to_le_bytes).map_err(|_| Error::Size { bytes })
}
