//! Readers and writers of files: `lines` reads and writes WKT and WKB, a folder each of the other formats.
pub(crate) mod flatgeobuf;
pub(crate) mod geojson;
pub(crate) mod geoparquet;
pub(crate) mod lines;
pub(crate) mod reader;
pub(crate) mod values;
pub(crate) mod wkb;
pub(crate) mod writer;

use crate::failure::Failure;
use crate::input::Input;
use crate::output::Output;
use reader::Source;
use std::path::Path;
use writer::Writer;

/// What a file is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// A FeatureCollection, a Feature or a geometry
    Geojson,
    /// Well-known text, a geometry a line
    Wkt,
    /// Well-known binary in hexadecimal digits, a geometry a line
    Wkb,
    /// FlatGeobuf
    Flatgeobuf,
    /// GeoParquet
    Geoparquet,
}

/// By the end of the file's name.
const ENDS: [(&str, Format); 7] = [
    ("geojson", Format::Geojson),
    ("json", Format::Geojson),
    ("wkt", Format::Wkt),
    ("wkb", Format::Wkb),
    ("fgb", Format::Flatgeobuf),
    ("parquet", Format::Geoparquet),
    ("geoparquet", Format::Geoparquet),
];

impl Format {
    /// The format of a file's name.
    pub(crate) fn of(path: &Path) -> Option<Format> {
        let end = path.extension()?.to_str()?.to_lowercase();
        ENDS.iter().find(|(known, _)| *known == end).map(|(_, format)| *format)
    }

    /// The format that a name has, unless an option says another one.
    pub(crate) fn named(path: &Path, said: Option<Format>, option: &str) -> Result<Format, Failure> {
        said.or_else(|| Format::of(path)).ok_or_else(|| {
            let ends: Vec<String> = ENDS.iter().map(|(end, _)| format!(".{end}")).collect();
            let name = path.display();
            Failure::Usage(format!("{name}: unknown format; name it {} or give {option}", ends.join(", ")))
        })
    }

    fn is_text(self) -> bool {
        matches!(self, Format::Geojson | Format::Wkt | Format::Wkb)
    }
}

/// Opens a layer and reads what stands before its features.
pub(crate) fn open(input: &Input, format: Format) -> Result<Box<dyn Source>, Failure> {
    Ok(match format {
        Format::Geojson => Box::new(geojson::reader::GeoJson::open(input)?),
        Format::Wkt => Box::new(lines::Lines::open(input, lines::Text::Wkt)?),
        Format::Wkb => Box::new(lines::Lines::open(input, lines::Text::Wkb)?),
        Format::Flatgeobuf => Box::new(flatgeobuf::reader::FlatGeobuf::open(input)?),
        Format::Geoparquet => Box::new(geoparquet::reader::GeoParquet::open(input)?),
    })
}

/// Begins a layer.
pub(crate) fn create(
    output: Output,
    format: Format,
    layer: &crate::layer::batch::Layer,
) -> Result<Writer, Failure> {
    if output.is_terminal() && !format.is_text() {
        return Err(Failure::Usage("binary data is not for a terminal; give -o FILE".into()));
    }
    Ok(match format {
        Format::Geojson => Writer::new(geojson::writer::GeoJsonSink::new(output, layer)),
        Format::Wkt => Writer::new(lines::LinesSink::new(output, layer, lines::Text::Wkt)),
        Format::Wkb => Writer::new(lines::LinesSink::new(output, layer, lines::Text::Wkb)),
        Format::Flatgeobuf => Writer::new(flatgeobuf::writer::FlatGeobufSink::new(output, layer)?),
        Format::Geoparquet => Writer::new(geoparquet::writer::GeoParquetSink::new(output, layer)?),
    })
}
