//! Values of columns as JSON.
use crate::layer::columns::is_json;
use arrow_array::{Array, RecordBatch, StringArray, cast::AsArray};
use arrow_json::writer::{Encoder, EncoderOptions, NullableEncoder, make_encoder};
use arrow_schema::{ArrowError, FieldRef};

/// A column that writes its values as JSON: texts that are JSON as they are, what JSON lacks as a string.
pub(crate) struct JsonColumn<'b> {
    pub(crate) field: &'b FieldRef,
    encoder: NullableEncoder<'b>,
}

/// The columns of a batch, in their order.
pub(crate) fn json_columns<'b>(
    attributes: &'b RecordBatch,
    fields: &'b [FieldRef],
    options: &'b EncoderOptions,
) -> Result<Vec<JsonColumn<'b>>, ArrowError> {
    let arrays = attributes.columns().iter().map(AsRef::as_ref);
    fields.iter().zip(arrays).map(|(field, array)| JsonColumn::new(field, array, options)).collect()
}

impl<'b> JsonColumn<'b> {
    pub(crate) fn new(
        field: &'b FieldRef,
        array: &'b dyn Array,
        options: &'b EncoderOptions,
    ) -> Result<JsonColumn<'b>, ArrowError> {
        let encoder = if is_json(field) {
            NullableEncoder::new(Box::new(Verbatim(array.as_string())), array.nulls().cloned())
        } else {
            make_encoder(field, array, options)?
        };
        Ok(JsonColumn { field, encoder })
    }

    pub(crate) fn is_null(&self, row: usize) -> bool {
        self.encoder.is_null(row)
    }

    /// Adds the value of a row.
    pub(crate) fn write(&mut self, row: usize, out: &mut Vec<u8>) {
        if self.is_null(row) {
            out.extend(b"null");
        } else {
            self.encoder.encode(row, out);
        }
    }
}

/// Texts as they are.
struct Verbatim<'b>(&'b StringArray);

impl Encoder for Verbatim<'_> {
    fn encode(&mut self, row: usize, out: &mut Vec<u8>) {
        out.extend(self.0.value(row).as_bytes());
    }
}
