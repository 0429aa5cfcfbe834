//! The binary chunk, and the container around it and the document.
use crate::io::error::FileError;
use serde_json::{Value, json};

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The binary chunk with its views and accessors, one of each per attribute.
#[derive(Default)]
pub(super) struct Buffer {
    pub(super) bytes: Vec<u8>,
    pub(super) views: Vec<Value>,
    pub(super) accessors: Vec<Value>,
}

impl Buffer {
    /// Adds rows of two or three numbers; returns the accessor. Its bounds are those of the rounded values.
    pub(super) fn rows<const N: usize>(&mut self, rows: impl Iterator<Item = [f64; N]>) -> usize {
        let rows: Vec<[f32; N]> = rows.map(|row| row.map(single)).collect();
        let bound = |pick: fn(f32, f32) -> f32| {
            let all = rows.iter().copied();
            let bound = all.reduce(|a, b| std::array::from_fn(|axis| pick(a[axis], b[axis])));
            bound.unwrap_or([0.0; N]).to_vec()
        };
        let accessor = json!({
            "bufferView": self.views.len(), "componentType": FLOAT, "count": rows.len(), "type": format!("VEC{N}"),
            "min": bound(f32::min), "max": bound(f32::max),
        });
        self.add(rows.iter().flatten().flat_map(|number| number.to_le_bytes()), ARRAY_BUFFER, accessor)
    }

    /// Adds indices; returns the accessor.
    pub(super) fn indices(&mut self, indices: impl Iterator<Item = usize>) -> usize {
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

    /// Adds bytes that no accessor reads; returns the view. What follows is aligned to four bytes.
    pub(super) fn view(&mut self, bytes: Vec<u8>) -> usize {
        let (offset, length) = (self.bytes.len(), bytes.len());
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(json!({"buffer": 0, "byteOffset": offset, "byteLength": length}));
        self.views.len() - 1
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
pub(super) fn single(number: f64) -> f32 {
    (number as f32).clamp(f32::MIN, f32::MAX)
}

/// Header, JSON chunk, binary chunk, each padded to four bytes.
pub(super) fn container(document: &Value, mut binary: Vec<u8>) -> Result<Vec<u8>, FileError> {
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

fn length(bytes: usize) -> Result<[u8; 4], FileError> {
    u32::try_from(bytes).map(u32::to_le_bytes).map_err(|_| FileError::Size { bytes })
}
