//! Writes GeoParquet 1.1.
use super::metadata::{Geo, GeometryColumn, MARKS, marks, stated};
use super::reader::with_column;
use crate::failure::Failure;
use crate::formats::wkb;
use crate::formats::writer::Sink;
use crate::layer::areas::Areas;
use crate::layer::batch::{Batch, Layer, table};
use crate::layer::columns::free;
use crate::output::Output;
use arrow_array::builder::BinaryBuilder;
use arrow_array::{ArrayRef, BinaryArray};
use arrow_schema::{DataType, Field, SchemaRef};
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, ZstdLevel};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A group of rows is written out when it takes so many bytes.
const GROUP: usize = 1 << 25;

/// A file in the making.
pub(crate) struct GeoParquetSink {
    name: String,
    writer: ArrowWriter<Output>,
    schema: SchemaRef,
    crs: Option<Value>,
    kinds: BTreeSet<&'static str>,
    /// The least and the greatest coordinates so far.
    bounds: Option<[f64; 4]>,
}

impl GeoParquetSink {
    pub(crate) fn new(output: Output, layer: &Layer) -> Result<GeoParquetSink, Failure> {
        let taken = layer.schema.fields().iter().map(|field| field.name().as_str()).collect();
        let geometry = Field::new(free("geometry", "_", &taken), DataType::Binary, true);
        let schema = Arc::new(with_column(&layer.schema, geometry));
        let properties =
            WriterProperties::builder().set_compression(Compression::ZSTD(ZstdLevel::default())).build();
        let name = output.name();
        let writer = ArrowWriter::try_new(output, Arc::clone(&schema), Some(properties))
            .map_err(|error| Failure::write(&name, error))?;
        let crs = stated(&layer.crs);
        Ok(GeoParquetSink { name, writer, schema, crs, kinds: BTreeSet::new(), bounds: None })
    }

    fn put(&mut self, batch: &Batch) -> Result<(), Box<dyn std::error::Error>> {
        let mut columns = batch.attributes.columns().to_vec();
        columns.push(geometries(&batch.areas)?);
        self.writer.write(&table(Arc::clone(&self.schema), columns, batch.areas.len())?)?;
        if self.writer.in_progress_size() > GROUP || self.writer.memory_size() > 2 * GROUP {
            self.writer.flush()?;
        }
        for areas in batch.areas.iter().flatten() {
            self.kinds.insert(areas.kind());
            self.bounds = bounds(areas, self.bounds);
        }
        Ok(())
    }

    /// The value of the key `geo`.
    fn geo(&self) -> Geo {
        let name = self.schema.field(self.schema.fields().len() - 1).name().clone();
        let column = GeometryColumn {
            encoding: "WKB".into(),
            geometry_types: self.kinds.iter().map(|&kind| kind.to_owned()).collect(),
            crs: self.crs.clone(),
            bbox: self.bounds.map_or(vec![], Vec::from),
            covering: Value::Null,
        };
        Geo {
            version: "1.1.0".into(),
            primary_column: name.clone(),
            columns: BTreeMap::from([(name, column)]),
        }
    }
}

impl Sink for GeoParquetSink {
    fn write(&mut self, batch: &Batch) -> Result<(), Failure> {
        self.put(batch).map_err(|error| Failure::write(&self.name, error))
    }

    fn finish(mut self: Box<Self>) -> Result<Output, Failure> {
        let geo = serde_json::to_string(&self.geo()).map_err(|error| Failure::write(&self.name, error))?;
        self.writer.append_key_value_metadata(KeyValue::new("geo".into(), geo));
        self.writer.append_key_value_metadata(KeyValue::new(MARKS.into(), marks(&self.schema).to_string()));
        self.writer.into_inner().map_err(|error| Failure::write(&self.name, error))
    }
}

fn geometries(areas: &[Option<Areas>]) -> Result<ArrayRef, String> {
    let mut column = BinaryBuilder::with_capacity(areas.len(), 0);
    for areas in areas {
        column.append_option(areas.as_ref().map(wkb::written).transpose()?);
    }
    let column: BinaryArray = column.finish();
    Ok(Arc::new(column))
}

fn bounds(areas: &Areas, before: Option<[f64; 4]>) -> Option<[f64; 4]> {
    let points = areas.polygons.iter().flat_map(|polygon| &polygon.exterior().0);
    points.fold(before, |bounds, p| {
        let [left, low, right, high] = bounds.unwrap_or([p.x, p.y, p.x, p.y]);
        Some([left.min(p.x), low.min(p.y), right.max(p.x), high.max(p.y)])
    })
}
