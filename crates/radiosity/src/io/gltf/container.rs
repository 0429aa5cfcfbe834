//! The binary container: a header, the document, one binary chunk. Every length is checked; the `gltf` crate's own reader
//! trusts the header's.
use crate::io::error::{Fault, FileError};

/// The document's text and the binary chunk of a `.glb` file; of anything else, the whole as the document.
pub(super) fn chunks<'b>(name: &str, bytes: &'b [u8]) -> Result<(&'b [u8], Option<&'b [u8]>), FileError> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    let fault = |part: &str, fault| FileError::Part { file: name.into(), part: part.into(), fault };
    match word(bytes, 4) {
        Some(2) => {}
        Some(1) => {
            let repair = "export the scene as glTF 2.0";
            return Err(FileError::Unread { file: name.into(), feature: "glTF 1.0".into(), repair });
        }
        version => {
            let found = version.unwrap_or_default().to_string();
            return Err(fault("header", Fault::Word { found, wanted: "container version 2" }));
        }
    }
    let (kind, document, rest) = chunk(&bytes[8..], 4).ok_or_else(|| short(name, "document", bytes.len()))?;
    if kind != b"JSON" {
        let found = String::from_utf8_lossy(kind).into_owned();
        return Err(fault("first chunk", Fault::Word { found, wanted: "JSON" }));
    }
    if rest.is_empty() {
        return Ok((document, None));
    }
    let (_, binary, _) = chunk(rest, 0).ok_or_else(|| short(name, "binary chunk", rest.len()))?;
    Ok((document, Some(binary)))
}

fn short(name: &str, part: &str, found: usize) -> FileError {
    FileError::Part { file: name.into(), part: part.into(), fault: Fault::Short { found } }
}

/// A chunk's kind, its bytes, and what follows it; `skipped` bytes stand before it.
fn chunk(bytes: &[u8], skipped: usize) -> Option<(&[u8], &[u8], &[u8])> {
    let bytes = bytes.get(skipped..)?;
    let length = usize::try_from(word(bytes, 0)?).ok()?;
    let kind = bytes.get(4..8)?;
    let end = length.checked_add(8)?;
    Some((kind, bytes.get(8..end)?, &bytes[end..]))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}
