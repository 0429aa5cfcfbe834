//! The document before the `gltf` crate checks it: what a file only leaves out is added, what is not read is noted or refused by name.
//!
//! The crate refuses files whole for what no light depends on: a camera that does not exist, bounds that are not stated, a primitive
//! without positions.
use crate::io::error::FileError;
use crate::scene::finding::Finding;
use serde_json::{Value, json};

/// Extensions that are read, that change no light, or whose use is noted where it is met.
const READ: [&str; 11] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
    "FB_ngon_encoding",
    "EXT_texture_webp",
    "MSFT_texture_dds",
];
/// As many of a file's extensions are named.
const MOST_NAMED: usize = 64;

/// Refuses what is not read by name, notes what is left out, and adds what is only missing.
pub(super) fn prepare(
    name: &str,
    document: &mut Value,
    warnings: &mut Vec<Finding>,
) -> Result<(), FileError> {
    refuse(name, document)?;
    note_extensions(name, document, warnings);
    note_metals(name, document, warnings);
    add_bounds(document);
    leave_out_primitives(name, document, warnings);
    leave_out_cameras(name, document, warnings);
    leave_out_textures(name, document, warnings);
    add_scene(document);
    Ok(())
}

/// Another version, compressed geometry, and what the file itself says no reader may pass over.
fn refuse(name: &str, document: &Value) -> Result<(), FileError> {
    let unread = |feature: String, repair| Err(FileError::Unread { file: name.into(), feature, repair });
    if document["asset"]["version"].as_str().is_some_and(|version| version.starts_with("1."))
        || document["nodes"].is_object()
    {
        return unread("glTF 1.0".into(), "export the scene as glTF 2.0");
    }
    let least = &document["asset"]["minVersion"];
    if let Some(version) = least.as_str().filter(|version| !is_read(version)) {
        let version: String = version.chars().take(20).collect();
        return unread(
            format!("glTF {version}, the least (minVersion) that the file needs,"),
            "export it as glTF 2.0",
        );
    }
    if is_draco(document) {
        return unread("Draco compression (KHR_draco_mesh_compression)".into(), "export without compression");
    }
    let mut required = names(document, "extensionsRequired");
    let other = required.find(|extension| !is_of_materials(extension) && !READ.contains(extension));
    match other {
        Some("EXT_meshopt_compression" | "KHR_meshopt_compression") => {
            unread("meshopt compression (EXT_meshopt_compression)".into(), "export without compression")
        }
        Some(other) => {
            let feature = format!(
                "the extension {}, which the file requires,",
                other.chars().take(60).collect::<String>()
            );
            unread(feature, "export without it")
        }
        None => Ok(()),
    }
}

/// Whether readers of 2.0 read what needs a version.
fn is_read(version: &str) -> bool {
    let (major, minor) = version.split_once('.').unwrap_or((version, "0"));
    match (major.parse::<u32>(), minor.parse::<u32>()) {
        (Ok(major), Ok(minor)) => (major, minor) <= (2, 0),
        _ => false,
    }
}

fn names<'d>(document: &'d Value, list: &str) -> impl Iterator<Item = &'d str> {
    document[list].as_array().into_iter().flatten().filter_map(Value::as_str)
}

/// What a surface looks like beside its colour: the geometry can be read without.
fn is_of_materials(extension: &str) -> bool {
    extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_")
}

/// Whether geometry is there in compressed form only.
fn is_draco(document: &Value) -> bool {
    let is_packed = |primitive: &Value| {
        let packed = !primitive["extensions"]["KHR_draco_mesh_compression"].is_null();
        let accessor =
            primitive["attributes"]["POSITION"].as_u64().and_then(|index| usize::try_from(index).ok());
        packed && accessor.is_none_or(|index| document["accessors"][index]["bufferView"].is_null())
    };
    names(document, "extensionsRequired").any(|extension| extension == "KHR_draco_mesh_compression")
        || primitives(document).any(is_packed)
}

/// The elements of a list of the document, where there is one.
fn elements<'d>(document: &'d mut Value, list: &str) -> impl Iterator<Item = &'d mut Value> {
    document.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten()
}

fn primitives(document: &Value) -> impl Iterator<Item = &Value> {
    let meshes = document["meshes"].as_array().into_iter().flatten();
    meshes.filter_map(|mesh| mesh["primitives"].as_array()).flatten()
}

fn note_extensions(name: &str, document: &Value, warnings: &mut Vec<Finding>) {
    let others = names(document, "extensionsUsed").filter(|extension| !READ.contains(extension));
    for extension in others.take(MOST_NAMED) {
        let what = format!("the extension {} is left out", extension.chars().take(60).collect::<String>());
        Finding::note(warnings, name, &what, "bake it into what it changes");
    }
    if document["animations"].as_array().is_some_and(|all| !all.is_empty()) {
        let what = "animations are left out; everything stands where its node is";
        Finding::note(warnings, name, what, "export the moment that you want");
    }
}

/// Metals. A surface that says nothing about it is metal, and exporters leave the number out that means so.
fn note_metals(name: &str, document: &Value, warnings: &mut Vec<Finding>) {
    let is_metal = |material: &Value| {
        let surface = &material["pbrMetallicRoughness"];
        let is_lit = material["extensions"]["KHR_materials_unlit"].is_null();
        surface.is_object() && is_lit && surface["metallicFactor"].as_f64().unwrap_or(1.0) > 0.0
    };
    let materials = document["materials"].as_array().into_iter().flatten().enumerate();
    for (index, _) in materials.filter(|(_, material)| is_metal(material)) {
        let (place, what) =
            (format!("{name}: material {index}"), "shine is left out; surfaces reflect diffusely");
        Finding::note(warnings, place, what, "check that the light is what you mean");
    }
}

/// Bounds of positions: nothing here reads them.
fn add_bounds(document: &mut Value) {
    let positions: Vec<usize> = primitives(document)
        .filter_map(|primitive| usize::try_from(primitive["attributes"]["POSITION"].as_u64()?).ok())
        .collect();
    for index in positions {
        let Some(accessor) = elements(document, "accessors").nth(index).and_then(Value::as_object_mut) else {
            continue;
        };
        for bound in ["min", "max"] {
            accessor.entry(bound).or_insert(json!([0, 0, 0]));
        }
    }
}

fn leave_out_primitives(name: &str, document: &mut Value, warnings: &mut Vec<Finding>) {
    for (mesh, value) in elements(document, "meshes").enumerate() {
        let Some(primitives) = value.get_mut("primitives").and_then(Value::as_array_mut) else { continue };
        let has_positions = |primitive: &Value| {
            !primitive["attributes"].is_object() || !primitive["attributes"]["POSITION"].is_null()
        };
        if !primitives.iter().all(has_positions) {
            let what = "primitives without positions are left out";
            Finding::note(warnings, format!("{name}: mesh {mesh}"), what, "add positions, or remove them");
            primitives.retain(has_positions);
        }
    }
}

/// Nobody's light depends on a camera.
fn leave_out_cameras(name: &str, document: &mut Value, warnings: &mut Vec<Finding>) {
    let is_whole = |camera: &Value| match camera["type"].as_str() {
        Some("perspective") => camera["perspective"]["yfov"].is_number(),
        Some("orthographic") => {
            ["xmag", "ymag", "znear", "zfar"].iter().all(|key| camera["orthographic"][key].is_number())
        }
        _ => false,
    };
    let mut whole = Vec::new();
    for camera in elements(document, "cameras") {
        whole.push(is_whole(camera));
        if !is_whole(camera) {
            *camera = json!({"type": "perspective", "perspective": {"yfov": 1.0, "znear": 1.0}});
        }
        if let Some(lens) = camera.get_mut("perspective").and_then(Value::as_object_mut) {
            lens.entry("znear").or_insert(json!(0.01));
        }
    }
    for (index, node) in elements(document, "nodes").enumerate() {
        let camera = node["camera"].as_u64().and_then(|camera| usize::try_from(camera).ok());
        let is_there = camera.is_none_or(|camera| whole.get(camera).copied().unwrap_or(false));
        if let (false, Some(node)) = (is_there, node.as_object_mut()) {
            let what = "a camera that is not in the file is left out";
            Finding::note(warnings, format!("{name}: node {index}"), what, "add it, or give --camera");
            node.remove("camera");
        }
    }
}

/// Textures whose picture is in a format of an extension have no source.
fn leave_out_textures(name: &str, document: &mut Value, warnings: &mut Vec<Finding>) {
    let has_source = |texture: &Value| texture["source"].is_u64();
    let textures = document["textures"].as_array().cloned().unwrap_or_default();
    if textures.iter().all(has_source) {
        return;
    }
    for (index, material) in elements(document, "materials").enumerate() {
        let surface = material.get_mut("pbrMetallicRoughness").and_then(Value::as_object_mut);
        let Some(surface) = surface else { continue };
        let texture = surface.get("baseColorTexture").and_then(|info| info["index"].as_u64());
        let texture =
            texture.and_then(|texture| usize::try_from(texture).ok()).and_then(|index| textures.get(index));
        if texture.is_some_and(|texture| !has_source(texture)) {
            let what = "a texture is neither PNG nor JPEG; its factor alone is taken";
            Finding::note(warnings, format!("{name}: material {index}"), what, "export its picture as PNG");
            surface.remove("baseColorTexture");
        }
    }
}

/// A file without a scene means all its nodes.
fn add_scene(document: &mut Value) {
    if document["scenes"].as_array().is_some_and(|scenes| !scenes.is_empty()) {
        return;
    }
    let Some(nodes) = document["nodes"].as_array() else { return };
    let children: Vec<u64> = nodes
        .iter()
        .filter_map(|node| node["children"].as_array())
        .flatten()
        .filter_map(Value::as_u64)
        .collect();
    let mut is_root = vec![true; nodes.len()];
    for child in children {
        if let Some(root) = usize::try_from(child).ok().and_then(|child| is_root.get_mut(child)) {
            *root = false;
        }
    }
    let roots: Vec<usize> = (0..is_root.len()).filter(|&node| is_root[node]).collect();
    document["scenes"] = json!([{"nodes": roots}]);
    document["scene"] = json!(0);
}
