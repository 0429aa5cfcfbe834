//! Writes FlatGeobuf with its index, the features in the order of a Hilbert curve. They wait in a temporary file until all are there.
use super::properties::column_type;
use crate::failure::Failure;
use crate::formats::values::JsonColumn;
use crate::formats::writer::Sink;
use crate::input::warn;
use crate::layer::areas::{Areas, rings};
use crate::layer::batch::{Batch, Layer};
use crate::layer::crs::{Crs, Definition};
use crate::output::Output;
use arrow_array::types::{
    Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type, UInt32Type,
    UInt64Type,
};
use arrow_array::{Array, cast::AsArray};
use arrow_json::writer::EncoderOptions;
use arrow_schema::{FieldRef, SchemaRef};
use flatgeobuf::geozero::{
    ColumnValue, GeomProcessor, GeozeroGeometry, PropertyProcessor, error::Result as ZeroResult,
};
use flatgeobuf::{ColumnType, FgbCrs, FgbWriter, FgbWriterOptions, GeometryType};
use geo_types::Polygon;
use std::io::{BufWriter, Write};

/// A file in the making.
pub(crate) struct FlatGeobufSink {
    output: Output,
    writer: FgbWriter<'static>,
    schema: SchemaRef,
}

impl FlatGeobufSink {
    pub(crate) fn new(output: Output, layer: &Layer) -> Result<FlatGeobufSink, Failure> {
        let options = FgbWriterOptions {
            detect_type: false,
            promote_to_multi: false,
            crs: crs(&layer.crs),
            ..FgbWriterOptions::default()
        };
        let created = FgbWriter::create_with_options("", GeometryType::Unknown, options);
        let mut writer = created.map_err(|error| Failure::write(output.name(), error))?;
        for field in layer.schema.fields() {
            writer.add_column(field.name(), column_type(field), |_, _| {});
        }
        Ok(FlatGeobufSink { output, writer, schema: layer.schema.clone() })
    }

    fn put(&mut self, batch: &Batch) -> Result<(), String> {
        let options = EncoderOptions::default();
        let columns: Result<Vec<_>, String> = self
            .schema
            .fields()
            .iter()
            .zip(batch.attributes.columns())
            .map(|(field, array)| Column::new(field, array.as_ref(), &options))
            .collect();
        let mut columns = columns?;
        for (row, areas) in batch.areas.iter().enumerate() {
            let mut refused = Ok(());
            let added = self.writer.add_feature_geom(Written(areas.as_ref()), |feature| {
                let values = columns.iter_mut().enumerate().filter(|(_, column)| !column.array.is_null(row));
                refused = values.into_iter().try_for_each(|(number, column)| {
                    column.with_value(row, |value| feature.property(number, "", value).map(|_| ()))
                });
            });
            added.and(refused).map_err(|error| error.to_string())?;
        }
        Ok(())
    }
}

impl Sink for FlatGeobufSink {
    fn write(&mut self, batch: &Batch) -> Result<(), Failure> {
        self.put(batch).map_err(|error| Failure::write(self.output.name(), error))
    }

    fn finish(self: Box<Self>) -> Result<Output, Failure> {
        let name = self.output.name();
        let mut output = BufWriter::new(self.output);
        self.writer.write(&mut output).map_err(|error| Failure::write(&name, error))?;
        let flushed =
            output.flush().and_then(|()| output.into_inner().map_err(std::io::IntoInnerError::into_error));
        flushed.map_err(|error| Failure::write(&name, error))
    }
}

/// What the header says of the coordinates.
fn crs(crs: &Crs) -> FgbCrs<'_> {
    let wkt = match &crs.definition {
        Some(Definition::Wkt(text)) => Some(text.as_str()),
        _ => None,
    };
    if crs.is_longitude_latitude() {
        return FgbCrs { org: Some("EPSG"), code: 4326, wkt, ..FgbCrs::default() };
    }
    let Some((authority, code)) = &crs.code else {
        if matches!(crs.definition, Some(Definition::Json(_))) {
            warn(
                "FlatGeobuf names the system of coordinates by a code, which this one lacks: it is left out",
            );
        }
        return FgbCrs { wkt, ..FgbCrs::default() };
    };
    match code.parse() {
        Ok(code) => FgbCrs { org: Some(authority), code, wkt, ..FgbCrs::default() },
        Err(_) => FgbCrs { org: Some(authority), code_string: Some(code), wkt, ..FgbCrs::default() },
    }
}

/// A column of a batch.
struct Column<'b> {
    array: &'b dyn Array,
    kind: ColumnType,
    /// For values that FlatGeobuf writes as text.
    json: JsonColumn<'b>,
    text: Vec<u8>,
}

impl<'b> Column<'b> {
    fn new(field: &'b FieldRef, array: &'b dyn Array, options: &'b EncoderOptions) -> Result<Self, String> {
        let json = JsonColumn::new(field, array, options).map_err(|error| error.to_string())?;
        Ok(Column { array, kind: column_type(field), json, text: Vec::new() })
    }

    fn with_value(
        &mut self,
        row: usize,
        take: impl FnOnce(&ColumnValue<'_>) -> ZeroResult<()>,
    ) -> ZeroResult<()> {
        let array = self.array;
        macro_rules! number {
            ($type:ty) => {
                array.as_primitive::<$type>().value(row)
            };
        }
        let value = match self.kind {
            ColumnType::Bool => ColumnValue::Bool(array.as_boolean().value(row)),
            ColumnType::Byte => ColumnValue::Byte(number!(Int8Type)),
            ColumnType::UByte => ColumnValue::UByte(number!(UInt8Type)),
            ColumnType::Short => ColumnValue::Short(number!(Int16Type)),
            ColumnType::UShort => ColumnValue::UShort(number!(UInt16Type)),
            ColumnType::Int => ColumnValue::Int(number!(Int32Type)),
            ColumnType::UInt => ColumnValue::UInt(number!(UInt32Type)),
            ColumnType::Long => ColumnValue::Long(number!(Int64Type)),
            ColumnType::ULong => ColumnValue::ULong(number!(UInt64Type)),
            ColumnType::Float => ColumnValue::Float(number!(Float32Type)),
            ColumnType::Double => ColumnValue::Double(number!(Float64Type)),
            ColumnType::Binary => ColumnValue::Binary(array.as_binary::<i32>().value(row)),
            kind => return take(&worded(kind, &self.words(row))),
        };
        take(&value)
    }

    /// The value as text: a string without its quotes, anything else as JSON.
    fn words(&mut self, row: usize) -> String {
        if let Some(texts) = self.array.as_string_opt::<i32>() {
            return texts.value(row).to_owned();
        }
        self.text.clear();
        self.json.write(row, &mut self.text);
        let json = String::from_utf8_lossy(&self.text);
        serde_json::from_str::<String>(&json).unwrap_or_else(|_| json.into_owned())
    }
}

fn worded(kind: ColumnType, text: &str) -> ColumnValue<'_> {
    match kind {
        ColumnType::Json => ColumnValue::Json(text),
        ColumnType::DateTime => ColumnValue::DateTime(text),
        _ => ColumnValue::String(text),
    }
}

/// Polygons as geozero visits them; what has no geometry is an empty one, as FlatGeobuf has no other.
struct Written<'a>(Option<&'a Areas>);

impl GeozeroGeometry for Written<'_> {
    fn process_geom<P: GeomProcessor>(&self, to: &mut P) -> ZeroResult<()> {
        match self.0 {
            Some(areas) if areas.is_multi => {
                to.multipolygon_begin(areas.polygons.0.len(), 0)?;
                areas
                    .polygons
                    .iter()
                    .enumerate()
                    .try_for_each(|(i, polygon)| visit(polygon, false, i, to))?;
                to.multipolygon_end(0)
            }
            Some(areas) => areas.polygons.iter().try_for_each(|polygon| visit(polygon, true, 0, to)),
            None => to.polygon_begin(true, 0, 0).and_then(|()| to.polygon_end(true, 0)),
        }
    }
}

fn visit(
    polygon: &Polygon<f64>,
    is_whole: bool,
    number: usize,
    to: &mut impl GeomProcessor,
) -> ZeroResult<()> {
    to.polygon_begin(is_whole, 1 + polygon.interiors().len(), number)?;
    for (i, ring) in rings(polygon).enumerate() {
        to.linestring_begin(false, ring.0.len(), i)?;
        ring.0.iter().enumerate().try_for_each(|(i, point)| to.xy(point.x, point.y, i))?;
        to.linestring_end(false, i)?;
    }
    to.polygon_end(is_whole, number)
}
