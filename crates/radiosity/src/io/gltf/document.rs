//! The document: parsed, checked by the `gltf` crate, and before that by us where the crate would panic.
use super::container::chunks;
use crate::io::error::{Fault, FileError};
use gltf::json::Root;

/// A document and the bytes of its binary chunk.
pub(super) struct GltfFile {
    pub(super) document: gltf::Document,
    pub(super) blob: Option<Vec<u8>>,
}

pub(super) fn parse(name: &str, bytes: &[u8]) -> Result<GltfFile, FileError> {
    let refused = |source| FileError::Gltf { file: name.into(), source: Box::new(source) };
    let (text, binary) = chunks(name, bytes)?;
    let root = Root::from_slice(text).map_err(|error| refused(gltf::Error::Deserialize(error)))?;
    check(&root).map_err(|(part, fault)| FileError::Part { file: name.into(), part, fault })?;
    Ok(GltfFile {
        document: gltf::Document::from_json(root).map_err(refused)?,
        blob: binary.map(<[u8]>::to_vec),
    })
}

/// What the crate takes for granted: the version, that attributes name accessors, and that images have a source.
fn check(root: &Root) -> Result<(), (String, Fault)> {
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
