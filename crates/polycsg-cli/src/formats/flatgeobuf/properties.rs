//! Properties of FlatGeobuf: which types columns have, and the values of one feature.
use crate::layer::columns::{date_time_field, is_date_time, is_json, json_field};
use arrow_array::builder::{
    ArrayBuilder, BinaryBuilder, BooleanBuilder, Float32Builder, Float64Builder, Int8Builder, Int16Builder,
    Int32Builder, Int64Builder, StringBuilder, UInt8Builder, UInt16Builder, UInt32Builder, UInt64Builder,
    make_builder,
};
use arrow_array::{ArrayRef, RecordBatch};
use arrow_schema::{ArrowError, DataType, Field, SchemaRef};
use flatgeobuf::ColumnType;
use std::sync::Arc;

/// The field of a column.
pub(super) fn field(name: &str, column: ColumnType) -> Result<Field, String> {
    let data_type = match column {
        ColumnType::Byte => DataType::Int8,
        ColumnType::UByte => DataType::UInt8,
        ColumnType::Bool => DataType::Boolean,
        ColumnType::Short => DataType::Int16,
        ColumnType::UShort => DataType::UInt16,
        ColumnType::Int => DataType::Int32,
        ColumnType::UInt => DataType::UInt32,
        ColumnType::Long => DataType::Int64,
        ColumnType::ULong => DataType::UInt64,
        ColumnType::Float => DataType::Float32,
        ColumnType::Double => DataType::Float64,
        ColumnType::String => DataType::Utf8,
        ColumnType::Binary => DataType::Binary,
        ColumnType::Json => return Ok(json_field(name)),
        ColumnType::DateTime => return Ok(date_time_field(name)),
        other => return Err(format!("column {name:?} has the unknown type {}", other.0)),
    };
    Ok(Field::new(name, data_type, true))
}

/// The column type of a field; what FlatGeobuf lacks is text as JSON writes it.
pub(super) fn column_type(field: &Field) -> ColumnType {
    match field.data_type() {
        DataType::Int8 => ColumnType::Byte,
        DataType::UInt8 => ColumnType::UByte,
        DataType::Boolean => ColumnType::Bool,
        DataType::Int16 => ColumnType::Short,
        DataType::UInt16 => ColumnType::UShort,
        DataType::Int32 => ColumnType::Int,
        DataType::UInt32 => ColumnType::UInt,
        DataType::Int64 => ColumnType::Long,
        DataType::UInt64 => ColumnType::ULong,
        DataType::Float32 => ColumnType::Float,
        DataType::Float64 => ColumnType::Double,
        DataType::Binary => ColumnType::Binary,
        DataType::Timestamp(..) | DataType::Date32 | DataType::Date64 => ColumnType::DateTime,
        DataType::Utf8 if is_json(field) => ColumnType::Json,
        DataType::Utf8 if is_date_time(field) => ColumnType::DateTime,
        other if other.is_nested() => ColumnType::Json,
        _ => ColumnType::String,
    }
}

/// Columns in the making.
pub(super) struct Table {
    schema: SchemaRef,
    columns: Vec<Box<dyn ArrayBuilder>>,
    rows: usize,
}

/// The bytes that are left of a feature's properties.
struct Rest<'a>(&'a [u8]);

impl Rest<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let (found, rest) = self.0.split_first_chunk().ok_or("its properties end too early")?;
        self.0 = rest;
        Ok(*found)
    }

    fn counted(&mut self) -> Result<&[u8], String> {
        let length = u32::from_le_bytes(self.take()?) as usize;
        let (found, rest) = self.0.split_at_checked(length).ok_or("its properties end too early")?;
        self.0 = rest;
        Ok(found)
    }
}

impl Table {
    pub(super) fn new(schema: &SchemaRef) -> Table {
        let columns = schema.fields().iter().map(|field| make_builder(field.data_type(), 0)).collect();
        Table { schema: Arc::clone(schema), columns, rows: 0 }
    }

    /// Adds a row. Columns that a feature leaves out are null.
    pub(super) fn push(&mut self, properties: &[u8]) -> Result<(), String> {
        let mut rest = Rest(properties);
        while !rest.0.is_empty() {
            let number = usize::from(u16::from_le_bytes(rest.take()?));
            let column =
                self.columns.get_mut(number).ok_or_else(|| format!("there is no column {number}"))?;
            if column.len() > self.rows {
                return Err(format!("column {number} has two values"));
            }
            let field = self.schema.field(number);
            value(field.data_type(), column.as_mut(), &mut rest)
                .map_err(|error| format!("column {:?}: {error}", field.name()))?;
        }
        self.rows += 1;
        for (column, field) in self.columns.iter_mut().zip(self.schema.fields()) {
            if column.len() < self.rows {
                null(field.data_type(), column.as_mut());
            }
        }
        Ok(())
    }

    pub(super) fn take(&mut self) -> Result<RecordBatch, ArrowError> {
        let columns: Vec<ArrayRef> = self.columns.iter_mut().map(|column| column.finish()).collect();
        crate::layer::batch::table(Arc::clone(&self.schema), columns, std::mem::take(&mut self.rows))
    }
}

/// Calls `$of!` with the builder of a type of numbers and the type itself.
macro_rules! with_number {
    ($data_type:expr, $of:ident, $other:expr) => {
        match $data_type {
            DataType::Int8 => $of!(Int8Builder, i8),
            DataType::UInt8 => $of!(UInt8Builder, u8),
            DataType::Int16 => $of!(Int16Builder, i16),
            DataType::UInt16 => $of!(UInt16Builder, u16),
            DataType::Int32 => $of!(Int32Builder, i32),
            DataType::UInt32 => $of!(UInt32Builder, u32),
            DataType::Int64 => $of!(Int64Builder, i64),
            DataType::UInt64 => $of!(UInt64Builder, u64),
            DataType::Float32 => $of!(Float32Builder, f32),
            DataType::Float64 => $of!(Float64Builder, f64),
            _ => $other,
        }
    };
}

fn builder<B: ArrayBuilder>(column: &mut dyn ArrayBuilder) -> &mut B {
    column.as_any_mut().downcast_mut().expect("made of the field's type")
}

fn value(data_type: &DataType, column: &mut dyn ArrayBuilder, rest: &mut Rest<'_>) -> Result<(), String> {
    macro_rules! number {
        ($builder:ty, $type:ty) => {
            builder::<$builder>(column).append_value(<$type>::from_le_bytes(rest.take()?))
        };
    }
    with_number!(
        data_type,
        number,
        match data_type {
            DataType::Boolean => builder::<BooleanBuilder>(column).append_value(rest.take::<1>()? != [0]),
            DataType::Binary => builder::<BinaryBuilder>(column).append_value(rest.counted()?),
            _ => {
                let text = std::str::from_utf8(rest.counted()?).map_err(|error| error.to_string())?;
                builder::<StringBuilder>(column).append_value(text);
            }
        }
    );
    Ok(())
}

fn null(data_type: &DataType, column: &mut dyn ArrayBuilder) {
    macro_rules! number {
        ($builder:ty, $type:ty) => {
            builder::<$builder>(column).append_null()
        };
    }
    with_number!(
        data_type,
        number,
        match data_type {
            DataType::Boolean => builder::<BooleanBuilder>(column).append_null(),
            DataType::Binary => builder::<BinaryBuilder>(column).append_null(),
            _ => builder::<StringBuilder>(column).append_null(),
        }
    );
}
