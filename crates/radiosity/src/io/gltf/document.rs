//! The document: parsed, checked by the `gltf` crate, and before that by us where the crate would panic.
use super::container::chunks;
use super::prepare::prepare;
use crate::io::error::{Fault, FileError};
use crate::scene::finding::Finding;
use gltf::json::{Root, validation::Validate};
use serde::Deserialize;
use serde_json::Value;

/// A document and the bytes of its binary chunk.
pub(super) struct GltfFile {
    pub(super) document: gltf::Document,
    pub(super) blob: Option<Vec<u8>>,
}

/// The document's text as values, and the bytes of the binary chunk.
pub(super) type Prepared = (Value, Option<Vec<u8>>);

/// The file; notes what is left out of it.
pub(super) fn prepared(name: &str, bytes: &[u8], warnings: &mut Vec<Finding>) -> Result<Prepared, FileError> {
    let (text, binary) = chunks(name, bytes)?;
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text).trim_ascii_start();
    if !text.starts_with(b"{") {
        let reason = "it begins neither with glTF nor with {";
        return Err(FileError::Garbled { file: name.into(), wanted: "glTF 2.0", reason });
    }
    let mut document: Value = serde_json::from_slice(text).map_err(|error| unreadable(name, error))?;
    prepare(name, &mut document, warnings)?;
    Ok((document, binary.map(<[u8]>::to_vec)))
}

/// The document as the `gltf` crate has it.
pub(super) fn check(name: &str, (document, blob): Prepared) -> Result<GltfFile, FileError> {
    let root = Root::deserialize(&document).map_err(|error| unreadable(name, error))?;
    check_root(&root).map_err(|(part, fault)| FileError::Part { file: name.into(), part, fault })?;
    // What must be there was seen to; the rest is in the way of what can be read.
    let root = Root { extensions_required: Vec::new(), ..root };
    let faults = faults(&root);
    match faults.first() {
        Some((path, fault)) => {
            let (part, value) = found(&document, path);
            let value = value.filter(|value| !value.is_object() && !value.is_array());
            let value = value.map(|value| format!(" {value}").chars().take(60).collect::<String>());
            let reason = format!("{fault}{} ({} such in all)", value.unwrap_or_default(), faults.len());
            Err(FileError::Part { file: name.into(), part, fault: Fault::Invalid(reason) })
        }
        None => Ok(GltfFile { document: gltf::Document::from_json_without_validation(root), blob }),
    }
}

fn unreadable(name: &str, error: serde_json::Error) -> FileError {
    FileError::Gltf { file: name.into(), source: Box::new(gltf::Error::Deserialize(error)) }
}

/// What the crate finds wrong, with the paths: others may be many, and mostly follow from the first. An accessor without a view is none: all
/// its numbers are 0.
fn faults(root: &Root) -> Vec<(String, gltf::json::validation::Error)> {
    let mut all = Vec::new();
    root.validate(root, gltf::json::Path::new, &mut |path, fault| {
        let path = path().to_string();
        let is_bare = |path: &str| {
            path.starts_with("accessors[") && path.split_once('.').is_some_and(|(_, key)| key == "bufferView")
        };
        if !(fault == gltf::json::validation::Error::Missing && is_bare(&path)) {
            all.push((path, fault));
        }
    });
    all
}

/// The path of the crate with the keys of the file, and the value there: `extensions.khrLightsPunctual.lights[0]` of the crate is
/// `extensions.KHR_lights_punctual.lights[0]` in it.
fn found<'d>(document: &'d Value, path: &str) -> (String, Option<&'d Value>) {
    let (mut keys, mut here) = (Vec::new(), Some(document));
    for step in path.split('.') {
        let (key, indices) = step.split_at(step.find('[').unwrap_or(step.len()));
        let plain = |key: &str| key.replace('_', "").to_lowercase();
        let member = here.and_then(Value::as_object);
        let member = member.and_then(|map| map.iter().find(|(name, _)| plain(name) == plain(key)));
        keys.push(format!("{}{indices}", member.map_or(key, |(name, _)| name.as_str())));
        here = indices
            .split(['[', ']'])
            .filter_map(|index| index.parse::<usize>().ok())
            .fold(member.map(|(_, value)| value), |list, index| list.and_then(|list| list.get(index)));
    }
    (keys.join("."), here)
}

/// What the crate takes for granted: the version, that attributes name accessors, and that images have a source.
fn check_root(root: &Root) -> Result<(), (String, Fault)> {
    if !root.asset.version.starts_with("2.") {
        let found = root.asset.version.chars().take(40).collect();
        return Err(("asset".into(), Fault::Word { found, wanted: "version 2.0" }));
    }
    let len = root.accessors.len();
    for (mesh, primitive) in
        root.meshes.iter().enumerate().flat_map(|(mesh, value)| {
            value.primitives.iter().enumerate().map(move |primitive| (mesh, primitive))
        })
    {
        let outside = primitive.1.attributes.values().map(|index| index.value()).find(|index| *index >= len);
        if let Some(index) = outside {
            return Err((format!("mesh {mesh}, primitive {}", primitive.0), Fault::Index { index, len }));
        }
    }
    let bare = |image: &gltf::json::Image| {
        image.uri.is_none() && (image.buffer_view.is_none() || image.mime_type.is_none())
    };
    match root.images.iter().position(bare) {
        Some(image) => {
            Err((format!("image {image}"), Fault::Missing("it names none, or not their kind".into())))
        }
        None => Ok(()),
    }
}
