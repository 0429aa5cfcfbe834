//! A file that holds what it names, so that it can stand in another folder.
use super::buffer::container;
use super::container::chunks;
use crate::image_file;
use crate::io::error::FileError;
use base64::{Engine, engine::general_purpose::STANDARD};
use serde_json::Value;
use std::path::Path;

/// The file with its buffers and pictures in it; what cannot be read stays where it is. `None` where it names no file.
pub(super) fn embedded(name: &str, file: &[u8], folder: Option<&Path>) -> Result<Option<Vec<u8>>, FileError> {
    let (text, binary) = chunks(name, file)?;
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let Ok(mut document) = serde_json::from_slice::<Value>(text) else { return Ok(None) };
    let mut is_changed = false;
    for list in ["buffers", "images"] {
        for named in document.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten() {
            if let Some(address) = named["uri"].as_str().and_then(|address| data(address, folder)) {
                named["uri"] = address.into();
                is_changed = true;
            }
        }
    }
    Ok(match (is_changed, file.starts_with(b"glTF")) {
        (false, _) => None,
        (true, true) => Some(container(&document, binary.unwrap_or_default().to_vec())?),
        (true, false) => Some(document.to_string().into_bytes()),
    })
}

/// The contents of a file as an address.
fn data(address: &str, folder: Option<&Path>) -> Option<String> {
    let bytes = image_file::beside(address, folder)?;
    let kind = match bytes.as_slice() {
        [0x89, b'P', b'N', b'G', ..] => "image/png",
        [0xff, 0xd8, ..] => "image/jpeg",
        _ => "application/octet-stream",
    };
    Some(format!("data:{kind};base64,{}", STANDARD.encode(bytes)))
}
