//! Numbers out of buffers: every range is checked, since a file may claim anything.
use super::document::GltfFile;
use crate::image_file;
use crate::io::error::{Fault, FileError};
use gltf::accessor::sparse::IndexType;
use gltf::accessor::{DataType, Dimensions};
use std::path::Path;

/// The contents of the buffers, by index.
pub(super) struct Buffers<'f> {
    file: &'f str,
    all: Vec<Vec<u8>>,
}

impl<'f> Buffers<'f> {
    /// The binary chunk, `data:` addresses, and files beside the scene's.
    pub(super) fn load(file: &'f str, gltf: &GltfFile, folder: Option<&Path>) -> Result<Self, FileError> {
        let load = |buffer: gltf::Buffer<'_>| {
            let part = format!("buffer {}", buffer.index());
            let fault = |fault| FileError::Part { file: file.into(), part: part.clone(), fault };
            let bytes = match buffer.source() {
                gltf::buffer::Source::Bin => gltf.blob.clone().ok_or("the file has no binary chunk".into()),
                gltf::buffer::Source::Uri(address) => image_file::bytes(address, folder),
            };
            let bytes = bytes.map_err(|reason| fault(Fault::Missing(reason)))?;
            if bytes.len() < buffer.length() {
                return Err(fault(Fault::Count { found: bytes.len(), wanted: buffer.length() }));
            }
            Ok(bytes)
        };
        Ok(Self { file, all: gltf.document.buffers().map(load).collect::<Result<_, _>>()? })
    }

    /// How many bytes there are in all.
    fn size(&self) -> usize {
        self.all.iter().map(Vec::len).sum()
    }

    /// The bytes of a view.
    pub(super) fn view(&self, view: &gltf::buffer::View<'_>) -> Result<&[u8], FileError> {
        let bytes = self.all.get(view.buffer().index()).map_or(&[][..], Vec::as_slice);
        let end = view.offset().checked_add(view.length());
        let range = end.and_then(|end| bytes.get(view.offset()..end));
        range.ok_or_else(|| {
            let wanted = view.offset().saturating_add(view.length());
            self.fault(format!("buffer view {}", view.index()), Fault::Count { found: bytes.len(), wanted })
        })
    }

    /// The rows of an accessor of `N` numbers each, sparse ones filled in; whole numbers are scaled to 0 to 1 where the
    /// accessor says so.
    pub(super) fn rows<const N: usize>(
        &self,
        accessor: &gltf::Accessor<'_>,
        wanted: Dimensions,
    ) -> Result<Vec<[f64; N]>, FileError> {
        let fault = |fault| self.fault(format!("accessor {}", accessor.index()), fault);
        if accessor.dimensions() != wanted {
            return Err(fault(Fault::Kind("components")));
        }
        let scale = if accessor.normalized() { scale(accessor.data_type()) } else { 1.0 };
        let (kind, count) = (accessor.data_type(), accessor.count());
        let mut rows = match accessor.view() {
            Some(view) => self.strided::<N>(&view, accessor.offset(), kind, count)?,
            // Zeros cost a file nothing: it may claim as many rows as it has bytes.
            None if count <= self.size() => vec![[0.0; N]; count],
            None => return Err(fault(Fault::TooMany { what: "rows without data", limit: self.size() })),
        };
        if let Some(sparse) = accessor.sparse() {
            let places = sparse.indices();
            let kind = match places.index_type() {
                IndexType::U8 => DataType::U8,
                IndexType::U16 => DataType::U16,
                IndexType::U32 => DataType::U32,
            };
            let at = self.strided::<1>(&places.view(), places.offset(), kind, sparse.count())?;
            let values = sparse.values();
            let new =
                self.strided::<N>(&values.view(), values.offset(), accessor.data_type(), sparse.count())?;
            for (place, row) in at.into_iter().map(whole).zip(new) {
                *rows.get_mut(place).ok_or_else(|| fault(Fault::Index { index: place, len: count }))? = row;
            }
        }
        rows.iter_mut().flatten().for_each(|number| *number *= scale);
        match rows.iter().flatten().find(|number| !number.is_finite()) {
            Some(number) => Err(fault(Fault::Number(number.to_string()))),
            None => Ok(rows),
        }
    }

    /// The whole numbers of an accessor.
    pub(super) fn wholes(&self, accessor: &gltf::Accessor<'_>) -> Result<Vec<usize>, FileError> {
        Ok(self.rows::<1>(accessor, Dimensions::Scalar)?.into_iter().map(whole).collect())
    }

    fn strided<const N: usize>(
        &self,
        view: &gltf::buffer::View<'_>,
        offset: usize,
        kind: DataType,
        count: usize,
    ) -> Result<Vec<[f64; N]>, FileError> {
        let bytes = self.view(view)?;
        let width = N * kind.size();
        let stride = view.stride().unwrap_or(width).max(1);
        let wanted =
            (count.saturating_sub(1)).saturating_mul(stride).saturating_add(offset).saturating_add(width);
        if count > 0 && wanted > bytes.len() {
            let part = format!("buffer view {}", view.index());
            return Err(self.fault(part, Fault::Count { found: bytes.len(), wanted }));
        }
        let row = |index: usize| {
            let start = offset + index * stride;
            std::array::from_fn(|column| {
                let at = start + column * kind.size();
                number(&bytes[at..at + kind.size()], kind)
            })
        };
        Ok((0..count).map(row).collect())
    }

    fn fault(&self, part: String, fault: Fault) -> FileError {
        FileError::Part { file: self.file.into(), part, fault }
    }
}

/// A number of the stated kind, little-endian.
fn number(bytes: &[u8], kind: DataType) -> f64 {
    let byte = |at: usize| bytes.get(at).copied().unwrap_or_default();
    match kind {
        DataType::I8 => f64::from(i8::from_le_bytes([byte(0)])),
        DataType::U8 => f64::from(byte(0)),
        DataType::I16 => f64::from(i16::from_le_bytes([byte(0), byte(1)])),
        DataType::U16 => f64::from(u16::from_le_bytes([byte(0), byte(1)])),
        DataType::U32 => f64::from(u32::from_le_bytes([byte(0), byte(1), byte(2), byte(3)])),
        DataType::F32 => f64::from(f32::from_le_bytes([byte(0), byte(1), byte(2), byte(3)])),
    }
}

/// What a normalised whole number is multiplied by.
fn scale(kind: DataType) -> f64 {
    match kind {
        DataType::I8 => 1.0 / f64::from(i8::MAX),
        DataType::U8 => 1.0 / f64::from(u8::MAX),
        DataType::I16 => 1.0 / f64::from(i16::MAX),
        DataType::U16 => 1.0 / f64::from(u16::MAX),
        DataType::U32 => 1.0 / f64::from(u32::MAX),
        DataType::F32 => 1.0,
    }
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index of 32 bits, or clamped")]
fn whole([number]: [f64; 1]) -> usize {
    number as usize
}
