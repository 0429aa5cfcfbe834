//! A scene as a GLB: a node for each patch, its materials, pictures and cameras.
use super::buffer::{Buffer, container};
use super::write::{ball, camera_node, lens, upright};
use crate::io::collada::model::{Material, Model};
use crate::io::error::FileError;
use crate::io::surface::cut;
use crate::scene::{Scene, patch::Patch};
use glam::DVec3;
use serde_json::{Value, json};

/// The bytes of a GLB file of a scene. Read again it has the same patches, but for the rounding of positions to single precision, and turned
/// to y up in metres. Bands that are not red, green and blue become what an observer sees of them.
///
/// # Errors
/// [`FileError::Size`] when the data exceed the format's 4 GiB.
pub fn scene_glb(scene: &Scene) -> Result<Vec<u8>, FileError> {
    let model = Model::of(scene);
    let points: Vec<DVec3> =
        scene.patches.iter().flat_map(|patch| patch.polygon.loops()).flatten().copied().collect();
    let (middle, radius) = ball(&points);
    let mut buffer = Buffer::default();
    let (mut meshes, mut materials, mut images) = (Vec::new(), Vec::new(), Vec::new());
    let mut nodes = vec![json!({"name": "scene", "matrix": upright(&scene.asset).to_cols_array()})];
    for (index, (patch, face)) in scene.patches.iter().zip(&model.faces).enumerate() {
        meshes.push(mesh(&mut buffer, patch, middle, face.material));
        nodes.push(json!({"name": patch.name, "mesh": index, "translation": middle.to_array()}));
    }
    for material in &model.materials {
        materials.push(finish(&mut buffer, material, &model.wavelengths, &mut images));
    }
    let near = 1e-3 * radius * scene.asset.unit;
    nodes.extend(scene.cameras.iter().enumerate().map(|(index, camera)| camera_node(index, camera)));
    nodes[0]["children"] = (1..nodes.len()).collect();
    let textures: Vec<Value> = (0..images.len()).map(|image| json!({"source": image})).collect();
    let mut document = json!({
        "asset": {"version": "2.0", "generator": concat!("radiosity ", env!("CARGO_PKG_VERSION"))},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes, "meshes": meshes, "materials": materials,
        "images": images, "textures": textures,
        "cameras": scene.cameras.iter().map(|camera| lens(camera, near)).collect::<Vec<_>>(),
        "accessors": buffer.accessors, "bufferViews": buffer.views, "buffers": [{"byteLength": buffer.bytes.len()}],
        "extensionsUsed": ["KHR_materials_emissive_strength"],
    });
    leave_out_empty(&mut document);
    container(&document, buffer.bytes)
}

/// The format has no empty lists, and no buffer without bytes.
fn leave_out_empty(document: &mut Value) {
    let Some(map) = document.as_object_mut() else { return };
    if map["accessors"] == json!([]) {
        map.remove("buffers");
    }
    map.retain(|_, value| *value != json!([]));
    if map["nodes"][0]["children"] == json!([]) {
        map["nodes"] = json!([{"name": "scene"}]);
    }
}

fn mesh(buffer: &mut Buffer, patch: &Patch, middle: DVec3, material: usize) -> Value {
    let corners = cut(patch).into_flattened();
    let points = corners.iter().map(|corner| (corner.point - middle).to_array());
    let mut attributes = json!({"POSITION": buffer.rows(points)});
    if patch.texture.is_some() {
        attributes["TEXCOORD_0"] = buffer.rows(corners.iter().map(|corner| corner.place.to_array())).into();
    }
    json!({"primitives": [{"attributes": attributes, "material": material}]})
}

fn finish(buffer: &mut Buffer, material: &Material, wavelengths: &[f64], images: &mut Vec<Value>) -> Value {
    let [reflectance, emission] = material.colours(wavelengths);
    let [red, green, blue] = material.texture.as_ref().map_or(reflectance, |texture| texture.factor);
    let strength = emission.into_iter().fold(0.0, f64::max);
    let mut value = json!({
        "name": material.name,
        "pbrMetallicRoughness": {"baseColorFactor": [red, green, blue, 1.0], "metallicFactor": 0.0},
    });
    if strength > 0.0 {
        value["emissiveFactor"] = json!(emission.map(|band| band / strength));
        value["extensions"] = json!({"KHR_materials_emissive_strength": {"emissiveStrength": strength}});
    }
    if let Some(texture) = &material.texture {
        value["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": images.len()});
        let view = buffer.view(texture.image.bytes.clone());
        images.push(json!({"mimeType": texture.image.mime, "bufferView": view}));
    }
    value
}
