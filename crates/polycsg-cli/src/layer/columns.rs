//! Columns: which of them are ids or JSON, and the columns of two layers side by side.
use super::batch::{Batch, Layer, table};
use arrow_array::{Array, RecordBatch, UInt32Array, cast::AsArray, new_null_array, types::Int64Type};
use arrow_schema::{ArrowError, DataType, Field, FieldRef, Schema, SchemaRef};
use arrow_select::take::take;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Marks the column of GeoJSON's ids, which stand beside the properties.
const ID: (&str, &str) = ("polycsg:role", "id");
/// Arrow's own mark of text that is JSON.
const JSON: (&str, &str) = ("ARROW:extension:name", "arrow.json");
/// Marks text that is a FlatGeobuf `DateTime`.
const DATE_TIME: (&str, &str) = ("polycsg:role", "date-time");

fn marked(field: Field, (key, value): (&str, &str)) -> Field {
    let mut metadata = field.metadata().clone();
    metadata.insert(key.to_owned(), value.to_owned());
    field.with_metadata(metadata)
}

fn is_marked(field: &Field, (key, value): (&str, &str)) -> bool {
    field.metadata().get(key).is_some_and(|found| found == value)
}

/// Makes a column the one of ids, under a name that no other column has.
pub(crate) fn id_field(field: Field, others: &[Field]) -> Field {
    let taken: BTreeSet<&str> = others.iter().map(|field| field.name().as_str()).collect();
    let name = free(field.name(), "_", &taken);
    marked(field.with_name(name), ID)
}

/// A column of JSON texts.
pub(crate) fn json_field(name: &str) -> Field {
    marked(Field::new(name, DataType::Utf8, true), JSON)
}

/// A column of dates or times as ISO 8601 writes them.
pub(crate) fn date_time_field(name: &str) -> Field {
    marked(Field::new(name, DataType::Utf8, true), DATE_TIME)
}

pub(crate) fn is_id(field: &Field) -> bool {
    is_marked(field, ID)
}

pub(crate) fn is_json(field: &Field) -> bool {
    is_marked(field, JSON) && *field.data_type() == DataType::Utf8
}

pub(crate) fn is_date_time(field: &Field) -> bool {
    is_marked(field, DATE_TIME)
}

/// The id of a feature, as messages write it.
pub(crate) fn id(schema: &Schema, attributes: &RecordBatch, row: usize) -> Option<String> {
    let place = schema.fields().iter().position(|field| is_id(field))?;
    let column = attributes.column(place);
    match column.data_type() {
        _ if column.is_null(row) => None,
        DataType::Utf8 if is_json(schema.field(place)) => {
            Some(column.as_string::<i32>().value(row).to_owned())
        }
        DataType::Utf8 => Some(format!("{:?}", column.as_string::<i32>().value(row))),
        DataType::Int64 => Some(column.as_primitive::<Int64Type>().value(row).to_string()),
        _ => None,
    }
}

/// How messages name a feature: by its number and, where its layer has one, its id.
pub(crate) fn named(layer: &Layer, batch: &Batch, row: usize) -> String {
    let number = batch.first + row;
    match id(&layer.schema, &batch.attributes, row) {
        Some(id) => format!("feature {number} (id {id})"),
        None => format!("feature {number}"),
    }
}

/// A name with as many suffixes as make it differ from those taken.
pub(crate) fn free(name: &str, suffix: &str, taken: &BTreeSet<&str>) -> String {
    let mut name = name.to_owned();
    while taken.contains(name.as_str()) {
        name += suffix;
    }
    name
}

/// The columns of two layers side by side. Where both have a name, the first one's gets `_1` and the second one's `_2`, once more
/// where that is taken, too. Ids become columns like others, as several features may have parts of one.
pub(crate) fn joined(a: &Schema, b: &Schema) -> SchemaRef {
    let names = |schema: &Schema| schema.fields().iter().map(|f| f.name().clone()).collect::<BTreeSet<_>>();
    let [names_a, names_b] = [names(a), names(b)];
    let mut taken: BTreeSet<String> = names_a.symmetric_difference(&names_b).cloned().collect();
    let mut fields = Vec::new();
    for (schema, others, suffix) in [(a, &names_b, "_1"), (b, &names_a, "_2")] {
        for field in schema.fields() {
            let mut name = field.name().clone();
            if others.contains(&name) {
                name = free(&(name + suffix), suffix, &taken.iter().map(String::as_str).collect());
                taken.insert(name.clone());
            }
            fields.push(ordinary(field).with_name(name).with_nullable(true));
        }
    }
    Arc::new(Schema::new(fields))
}

/// Without the mark of an id.
pub(crate) fn ordinary(field: &FieldRef) -> Field {
    let field = Field::clone(field);
    let mut metadata = field.metadata().clone();
    if is_id(&field) {
        metadata.remove(ID.0);
    }
    field.with_metadata(metadata)
}

/// Rows of two tables side by side, with nulls where a side has none.
pub(crate) fn side_by_side(
    schema: &SchemaRef,
    a: (&RecordBatch, &UInt32Array),
    b: (&RecordBatch, &UInt32Array),
) -> Result<RecordBatch, ArrowError> {
    let mut columns = Vec::new();
    for (side, rows) in [a, b] {
        for column in side.columns() {
            let is_missing = rows.null_count() == rows.len();
            columns.push(if is_missing {
                new_null_array(column.data_type(), rows.len())
            } else {
                take(column, rows, None)?
            });
        }
    }
    table(Arc::clone(schema), columns, a.1.len())
}

/// Some rows of a table, in their order.
pub(crate) fn rows(from: &RecordBatch, rows: &UInt32Array) -> Result<RecordBatch, ArrowError> {
    let columns: Result<Vec<_>, _> = from.columns().iter().map(|column| take(column, rows, None)).collect();
    table(from.schema(), columns?, rows.len())
}
