//! Writes GeoJSON, a feature a line.
use super::feature;
use crate::failure::Failure;
use crate::formats::values::{JsonColumn, json_columns};
use crate::formats::writer::Sink;
use crate::input::warn;
use crate::layer::areas::Areas;
use crate::layer::batch::{Batch, Layer};
use crate::layer::columns::is_id;
use crate::layer::crs::{Crs, Definition};
use crate::output::Output;
use arrow_json::writer::EncoderOptions;
use serde_json::{Value, json};
use std::io::{self, BufWriter, Write};

/// A collection in the making.
pub(crate) struct GeoJsonSink {
    output: BufWriter<Output>,
    name: String,
    crs: Option<Value>,
    count: usize,
}

impl GeoJsonSink {
    pub(crate) fn new(output: Output, layer: &Layer) -> GeoJsonSink {
        let name = output.name();
        GeoJsonSink { output: BufWriter::new(output), name, crs: member(&layer.crs), count: 0 }
    }

    fn begin(&mut self) -> io::Result<()> {
        self.output.write_all(b"{\"type\":\"FeatureCollection\",")?;
        if let Some(crs) = &self.crs {
            write!(self.output, "\"crs\":{crs},")?;
        }
        self.output.write_all(b"\"features\":[")
    }

    fn put(&mut self, batch: &Batch) -> io::Result<()> {
        let (options, schema) =
            (EncoderOptions::default().with_explicit_nulls(true), batch.attributes.schema());
        let mut columns =
            json_columns(&batch.attributes, schema.fields(), &options).map_err(io::Error::other)?;
        let mut line = Vec::new();
        for (row, areas) in batch.areas.iter().enumerate() {
            if self.count == 0 {
                self.begin()?;
            }
            line.clear();
            line.extend(if self.count == 0 { &b"\n"[..] } else { &b",\n"[..] });
            feature(&mut line, &mut columns, row, areas.as_ref())?;
            self.output.write_all(&line)?;
            self.count += 1;
        }
        Ok(())
    }
}

impl Sink for GeoJsonSink {
    fn write(&mut self, batch: &Batch) -> Result<(), Failure> {
        self.put(batch).map_err(|error| Failure::write(&self.name, error))
    }

    fn finish(mut self: Box<Self>) -> Result<Output, Failure> {
        let begun = if self.count == 0 { self.begin() } else { Ok(()) };
        let ended = begun.and_then(|()| self.output.write_all(b"\n]}\n"));
        let GeoJsonSink { output, name, .. } = *self;
        let output = ended.and_then(|()| output.into_inner().map_err(io::IntoInnerError::into_error));
        output.map_err(|error| Failure::write(name, error))
    }
}

fn feature(
    line: &mut Vec<u8>,
    columns: &mut [JsonColumn<'_>],
    row: usize,
    areas: Option<&Areas>,
) -> io::Result<()> {
    line.extend(b"{\"type\":\"Feature\",");
    for id in columns.iter_mut().filter(|column| is_id(column.field) && !column.is_null(row)) {
        line.extend(b"\"id\":");
        id.write(row, line);
        line.push(b',');
    }
    line.extend(b"\"properties\":{");
    for (i, column) in columns.iter_mut().filter(|column| !is_id(column.field)).enumerate() {
        line.extend(if i == 0 { &b""[..] } else { &b","[..] });
        serde_json::to_writer(&mut *line, column.field.name())?;
        line.push(b':');
        column.write(row, line);
    }
    line.extend(b"},\"geometry\":");
    serde_json::to_writer(&mut *line, &areas.map(feature::written))?;
    line.push(b'}');
    Ok(())
}

/// The member `crs`, which GeoJSON has no longer, where the coordinates are other than those that it means.
fn member(crs: &Crs) -> Option<Value> {
    match (&crs.definition, &crs.code) {
        (Some(Definition::Json(json)), _) if json["type"] == "name" => Some(json.clone()),
        _ if crs.is_longitude_latitude() => None,
        (_, Some((authority, code))) => {
            warn(format!(
                "GeoJSON means longitude and latitude; {} stands in its old member crs",
                crs.name()
            ));
            let name = format!("urn:ogc:def:crs:{authority}::{code}");
            Some(json!({ "type": "name", "properties": { "name": name } }))
        }
        (Some(_), None) => {
            warn("GeoJSON has no place for the system of the coordinates, which has no code: it is left out");
            None
        }
        (None, None) => None,
    }
}
