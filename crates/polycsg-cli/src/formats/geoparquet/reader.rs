//! Reads GeoParquet, some rows at a time.
use super::damage::guarded;
use super::geometries::{self, Encoding};
use super::metadata::{Geo, GeometryColumn, MARKS, marked};
use crate::failure::Failure;
use crate::formats::reader::{Each, Source, warn_of_flattened};
use crate::input::Input;
use crate::layer::batch::{Batch, Gathered, Layer, table};
use crate::progress::Progress;
use arrow_array::RecordBatch;
use arrow_schema::Schema;
use parquet::arrow::arrow_reader::{
    ArrowReaderOptions, ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder,
};
use parquet::errors::ParquetError;
use parquet::file::metadata::ParquetMetaData;
use std::sync::Arc;

/// So many bytes of rows, uncompressed, are read at a time, but no more rows than these.
const MOST_BYTES: i64 = 1 << 24;
const MOST_ROWS: i64 = 1024;

/// A file whose columns are known.
pub(crate) struct GeoParquet {
    input: Input,
    rows: ParquetRecordBatchReader,
    progress: Progress,
    layer: Layer,
    encoding: Encoding,
    /// The column of the geometries.
    geometry: usize,
    /// The columns of the attributes.
    attributes: Vec<usize>,
}

impl GeoParquet {
    pub(crate) fn open(input: &Input) -> Result<GeoParquet, Failure> {
        let file = input.file()?;
        let data = |error: String| Failure::data(input.name(), error);
        let damaged = |damage: &str| data(damage.to_owned());
        let builder = guarded(|| ParquetRecordBatchReaderBuilder::try_new_with_options(file, options()));
        let builder = builder.map_err(damaged)?.map_err(|error| failed(input, error))?;
        let (name, column) = primary(builder.metadata()).map_err(data)?;
        let schema = Arc::clone(builder.schema());
        let geometry = schema.index_of(&name).map_err(|error| data(error.to_string()))?;
        let encoding = Encoding::of(&column.encoding, schema.field(geometry).data_type()).map_err(data)?;
        let attributes: Vec<usize> = (0..schema.fields().len())
            .filter(|&i| i != geometry && Some(schema.field(i).name().as_str()) != column.boxes())
            .collect();
        let projected = schema.project(&attributes).map_err(|error| data(error.to_string()))?;
        let marks = value(builder.metadata(), MARKS).unwrap_or("{}");
        let schema = Arc::new(marked(&projected, marks).map_err(data)?);
        let layer = Layer { name: input.name(), schema, crs: column.system() };
        let size = batch_size(builder.metadata());
        let count = u64::try_from(builder.metadata().file_metadata().num_rows()).unwrap_or_default();
        let progress = Progress::of_features(&layer.name, count);
        let rows = guarded(|| builder.with_batch_size(size).build());
        let rows = rows.map_err(damaged)?.map_err(|error| failed(input, error))?;
        Ok(GeoParquet { input: input.clone(), rows, progress, layer, encoding, geometry, attributes })
    }

    fn batch(&self, rows: &RecordBatch, gathered: &mut Gathered) -> Result<Batch, Failure> {
        for reading in geometries::read(rows.column(self.geometry), self.encoding) {
            let number = gathered.next;
            let wrong = |error| Failure::data(&self.layer.name, format!("feature {number}: {error}"));
            gathered.push(reading.map_err(wrong)?);
        }
        let columns = self.attributes.iter().map(|&column| rows.column(column).clone()).collect();
        let attributes = table(Arc::clone(&self.layer.schema), columns, rows.num_rows());
        Ok(gathered.take(attributes.map_err(|error| Failure::data(&self.layer.name, error))?))
    }
}

impl Source for GeoParquet {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn read(mut self: Box<Self>, each: &mut Each<'_>) -> Result<(), Failure> {
        let mut gathered = Gathered::default();
        loop {
            let after = gathered.next;
            let broken =
                |damage: String| Failure::data(&self.layer.name, format!("after feature {after}: {damage}"));
            let found = guarded(|| self.rows.next()).map_err(|damage| broken(damage.to_owned()))?;
            let Some(rows) = found else { break };
            self.input.interrupt.check()?;
            let rows = rows.map_err(|error| broken(error.to_string()))?;
            each(self.batch(&rows, &mut gathered)?)?;
            self.progress.add(rows.num_rows());
        }
        warn_of_flattened(&self.layer, &gathered);
        let empty = RecordBatch::new_empty(Arc::clone(&self.layer.schema));
        if gathered.next == 0 { each(gathered.take(empty)) } else { Ok(()) }
    }
}

/// The value of a key of the file.
fn value<'m>(metadata: &'m ParquetMetaData, key: &str) -> Option<&'m str> {
    let pairs = metadata.file_metadata().key_value_metadata();
    pairs.into_iter().flatten().find(|pair| pair.key == key)?.value.as_deref()
}

/// The name of the column of geometries, and what is said of it.
fn primary(metadata: &ParquetMetaData) -> Result<(String, GeometryColumn), String> {
    let geo = value(metadata, "geo").ok_or("this is no GeoParquet: its metadata lacks the key `geo`")?;
    let mut geo: Geo = serde_json::from_str(geo)
        .map_err(|error| format!("this is no GeoParquet: the key `geo`: {error}"))?;
    let column = geo.columns.remove(&geo.primary_column);
    let column = column.ok_or_else(|| format!("the key `geo` does not describe {:?}", geo.primary_column))?;
    Ok((geo.primary_column, column))
}

/// Types are those of Parquet. What Arrow's writers add to them is not read: the crate that does panics where it is broken.
fn options() -> ArrowReaderOptions {
    ArrowReaderOptions::new().with_skip_arrow_metadata(true)
}

fn batch_size(metadata: &ParquetMetaData) -> usize {
    let groups = metadata.row_groups();
    let bytes: i64 = groups.iter().fold(0, |sum, group| sum.saturating_add(group.total_byte_size()));
    let rows: i64 = groups.iter().fold(0, |sum, group| sum.saturating_add(group.num_rows()));
    let fitting = MOST_BYTES.saturating_mul(rows.max(1)) / bytes.max(1);
    usize::try_from(fitting.clamp(1, MOST_ROWS)).unwrap_or(1)
}

fn failed(input: &Input, error: ParquetError) -> Failure {
    match error {
        _ if input.interrupt.is_set() => Failure::Interrupted,
        error => Failure::data(input.name(), format!("this is no Parquet, or it is damaged: {error}")),
    }
}

/// The schema with a column behind it.
pub(super) fn with_column(schema: &Schema, field: arrow_schema::Field) -> Schema {
    let fields = schema.fields().iter().cloned().chain([Arc::new(field)]);
    Schema::new(fields.collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interrupt::Interrupt;

    /// A width of more bits than indices have makes the library's decoder of runs panic.
    #[test]
    fn any_damaged_byte_is_an_error_or_other_data() {
        let bytes = include_bytes!("../../../tests/data/geopandas.parquet");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("damaged.parquet");
        let (whole, mut refused) = (bytes.len(), 0);
        for place in 0..whole {
            let mut damaged = bytes.to_vec();
            damaged[place] = 255;
            std::fs::write(&path, damaged).unwrap();
            let file = GeoParquet::open(&Input::new(&path, &Interrupt::default()));
            refused += usize::from(file.and_then(|file| Box::new(file).read(&mut |_| Ok(()))).is_err());
        }
        assert!(refused > whole / 8 && refused < whole, "{refused} of {whole}");
    }
}
