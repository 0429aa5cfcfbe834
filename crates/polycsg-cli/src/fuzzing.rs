//! The readers, for fuzz targets: bytes in, and what must hold checked.
use crate::failure::Failure;
use crate::formats::{self, Format};
use crate::input::Input;
use crate::interrupt::Interrupt;
use crate::layer::areas::Areas;
use crate::layer::batch::{Batch, Layer};
use crate::output::Output;
use std::path::Path;

/// A reader to feed.
#[derive(Clone, Copy, Debug)]
pub enum Reader {
    /// A document of GeoJSON.
    GeoJson,
    /// Lines of WKT.
    Wkt,
    /// Lines of WKB.
    Wkb,
    /// A FlatGeobuf file.
    FlatGeobuf,
    /// A GeoParquet file.
    GeoParquet,
}

impl Reader {
    fn format(self) -> Format {
        match self {
            Reader::GeoJson => Format::Geojson,
            Reader::Wkt => Format::Wkt,
            Reader::Wkb => Format::Wkb,
            Reader::FlatGeobuf => Format::Flatgeobuf,
            Reader::GeoParquet => Format::Geoparquet,
        }
    }

    /// Reads any bytes: features, or an error that names the file. Features of finite coordinates are the same when they are written
    /// and read. Returns how many of these there are.
    ///
    /// # Panics
    /// If any of this does not hold.
    pub fn survives(self, bytes: &[u8]) -> usize {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("fuzz.bin");
        std::fs::write(&path, bytes).expect("a temporary file");
        match read(&path, self.format()) {
            // Every command refuses them.
            Ok((_, batches)) if !are_finite(&batches) => 0,
            Ok((layer, batches)) => {
                let written = folder.path().join("written.bin");
                write(&written, self.format(), &layer, &batches);
                let (_, again) = read(&written, self.format()).expect("what is written can be read");
                assert_eq!(shapes(&again, self), shapes(&batches, self), "other geometries");
                if !matches!(self, Reader::FlatGeobuf) {
                    assert_eq!(cells(&again), cells(&batches), "other attributes");
                }
                batches.iter().map(|batch| batch.areas.len()).sum()
            }
            Err(Failure::Data(message)) => {
                assert!(message.contains("fuzz.bin"), "which file? {message}");
                0
            }
            Err(other) => panic!("not the data's fault: {other:?}"),
        }
    }
}

fn read(path: &Path, format: Format) -> Result<(Layer, Vec<Batch>), Failure> {
    let source = formats::open(&Input::new(path, &Interrupt::default()), format)?;
    let (layer, mut batches) = (source.layer().clone(), Vec::new());
    source.read(&mut |batch| {
        batches.push(batch);
        Ok(())
    })?;
    Ok((layer, batches))
}

fn write(path: &Path, format: Format, layer: &Layer, batches: &[Batch]) {
    let output = Output::open(path, &Interrupt::default()).expect("a file");
    let mut writer = formats::create(output, format, layer).expect("a writer");
    batches.iter().for_each(|batch| writer.write(batch).expect("what is read can be written"));
    writer.finish().expect("a file");
}

fn are_finite(batches: &[Batch]) -> bool {
    let polygons =
        batches.iter().flat_map(|batch| batch.areas.iter().flatten()).flat_map(|areas| &areas.polygons.0);
    let mut points = polygons.flat_map(crate::layer::areas::rings).flat_map(|ring| &ring.0);
    points.all(|point| point.x.is_finite() && point.y.is_finite())
}

/// All geometries, bit for bit; of FlatGeobuf, which has its own order and no null, as a sorted list of those that are there.
fn shapes(batches: &[Batch], reader: Reader) -> Vec<String> {
    let all = batches.iter().flat_map(|batch| &batch.areas);
    match reader {
        Reader::FlatGeobuf => {
            let mut filled: Vec<String> = all.flatten().map(words).collect();
            filled.sort();
            filled
        }
        _ => all.map(|areas| areas.as_ref().map_or(String::new(), words)).collect(),
    }
}

/// The bits tell -0.0 from 0.0.
fn words(areas: &Areas) -> String {
    let bits = |polygon| {
        let rings = crate::layer::areas::rings(polygon);
        rings
            .map(|ring| ring.0.iter().map(|p| [p.x.to_bits(), p.y.to_bits()]).collect::<Vec<_>>())
            .collect::<Vec<_>>()
    };
    format!("{:?}", areas.polygons.iter().map(bits).collect::<Vec<_>>())
}

fn cells(batches: &[Batch]) -> Vec<String> {
    let rows = |batch: &Batch| {
        let columns = batch.attributes.columns().to_vec();
        (0..batch.areas.len())
            .map(move |row| format!("{:?}", columns.iter().map(|c| c.slice(row, 1)).collect::<Vec<_>>()))
            .collect::<Vec<_>>()
    };
    batches.iter().flat_map(rows).collect()
}

/// A GeoParquet file with these rows as WKB, and any text as what it says of them.
///
/// # Panics
/// If it cannot be written.
#[must_use]
pub fn parquet_of(rows: &[&[u8]], geo: Option<&str>) -> Vec<u8> {
    use arrow_array::{ArrayRef, BinaryArray, RecordBatch};
    let column: ArrayRef = std::sync::Arc::new(BinaryArray::from_iter_values(rows));
    let table = RecordBatch::try_from_iter([("geometry", column)]).expect("one column");
    let mut file = Vec::new();
    let mut writer = parquet::arrow::ArrowWriter::try_new(&mut file, table.schema(), None).expect("a writer");
    writer.write(&table).expect("written");
    let said = r#"{"version":"1.1.0","primary_column":"geometry","columns":{"geometry":{"encoding":"WKB"}}}"#;
    let geo = geo.unwrap_or(said).to_owned();
    writer.append_key_value_metadata(parquet::file::metadata::KeyValue::new("geo".into(), geo));
    writer.close().expect("written");
    file
}
