//! The columns that properties fill, and their types.
use crate::layer::batch::table;
use crate::layer::columns::{id_field, is_id, is_json, json_field};
use arrow_array::{
    Array, ArrayRef, BooleanArray, Float64Array, Int64Array, RecordBatch, StringArray, UInt64Array,
};
use arrow_schema::{ArrowError, DataType, Field, Schema, SchemaRef};
use geojson::JsonObject;
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The integers up to here are doubles, too.
const EXACT: u64 = 1 << 53;

/// What the values of a column have been so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Seen {
    truth: bool,
    number: bool,
    /// Beyond those of `i64`.
    large: bool,
    negative: bool,
    /// An integer that is no double.
    inexact: bool,
    fraction: bool,
    text: bool,
    structure: bool,
}

impl Seen {
    fn see(&mut self, value: &Value) {
        match value {
            Value::Null => {}
            Value::Bool(_) => self.truth = true,
            Value::String(_) => self.text = true,
            Value::Array(_) | Value::Object(_) => self.structure = true,
            Value::Number(number) => {
                self.number = true;
                self.fraction |= number.is_f64();
                self.large |= number.is_u64() && !number.is_i64();
                self.negative |= number.as_i64().is_some_and(|n| n < 0);
                let size = number.as_i64().map(i64::unsigned_abs).or(number.as_u64());
                self.inexact |= size.is_some_and(|n| n > EXACT);
            }
        }
    }

    /// The type of the column; none where its values are of several kinds and stay JSON.
    fn data_type(self) -> Option<DataType> {
        match (self.truth, self.number, self.text, self.structure) {
            (false, false, _, false) => Some(DataType::Utf8),
            (true, false, false, false) => Some(DataType::Boolean),
            (false, true, false, false) => match self {
                Seen { fraction: true, inexact: false, .. } => Some(DataType::Float64),
                Seen { fraction: true, .. } | Seen { large: true, negative: true, .. } => None,
                Seen { large: true, .. } => Some(DataType::UInt64),
                _ => Some(DataType::Int64),
            },
            _ => None,
        }
    }

    fn field(self, name: &str) -> Field {
        match self.data_type() {
            Some(data_type) => Field::new(name, data_type, true),
            None => json_field(name),
        }
    }
}

/// Properties in the order in which they are written, which an object of serde_json does not keep.
#[derive(Debug, Default)]
pub(super) struct InOrder(Vec<(String, Value)>);

impl<'de> Deserialize<'de> for InOrder {
    fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
        json.deserialize_map(InOrder::default())
    }
}

impl<'de> Visitor<'de> for InOrder {
    type Value = InOrder;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("an object of properties")
    }

    fn visit_map<M: MapAccess<'de>>(mut self, mut members: M) -> Result<InOrder, M::Error> {
        while let Some(member) = members.next_entry()? {
            self.0.push(member);
        }
        Ok(self)
    }
}

/// The columns of a document in the making, in the order in which they appear.
#[derive(Debug, Default)]
pub(super) struct Columns {
    place: BTreeMap<String, usize>,
    seen: Vec<(String, Seen)>,
    ids: Option<Seen>,
}

impl Columns {
    pub(super) fn see(&mut self, properties: &InOrder, id: Option<&Value>) {
        for (name, value) in &properties.0 {
            let next = self.seen.len();
            let place = *self.place.entry(name.clone()).or_insert(next);
            if place == next {
                self.seen.push((name.clone(), Seen::default()));
            }
            self.seen[place].1.see(value);
        }
        if let Some(id) = id {
            self.ids.get_or_insert_default().see(id);
        }
    }

    pub(super) fn schema(&self) -> SchemaRef {
        let mut fields: Vec<Field> = self.seen.iter().map(|(name, seen)| seen.field(name)).collect();
        if let Some(ids) = self.ids {
            fields.push(id_field(ids.field("id"), &fields));
        }
        Arc::new(Schema::new(fields))
    }
}

/// The properties and ids of some features as columns of a schema that was made of them.
pub(super) fn filled(
    schema: &SchemaRef,
    rows: &[(JsonObject, Option<Value>)],
) -> Result<RecordBatch, ArrowError> {
    let column = |field: &Arc<Field>| -> ArrayRef {
        let values = rows
            .iter()
            .map(|(properties, id)| if is_id(field) { id.as_ref() } else { properties.get(field.name()) });
        array(field, values.map(|value| value.filter(|value| !value.is_null())))
    };
    table(Arc::clone(schema), schema.fields().iter().map(column).collect(), rows.len())
}

fn array<'v>(field: &Field, values: impl Iterator<Item = Option<&'v Value>>) -> Arc<dyn Array> {
    match field.data_type() {
        _ if is_json(field) => {
            Arc::new(values.map(|value| value.map(Value::to_string)).collect::<StringArray>())
        }
        DataType::Boolean => Arc::new(values.map(|value| value?.as_bool()).collect::<BooleanArray>()),
        DataType::Int64 => Arc::new(values.map(|value| value?.as_i64()).collect::<Int64Array>()),
        DataType::UInt64 => Arc::new(values.map(|value| value?.as_u64()).collect::<UInt64Array>()),
        DataType::Float64 => Arc::new(values.map(|value| value?.as_f64()).collect::<Float64Array>()),
        _ => Arc::new(values.map(|value| Some(plain(value?))).collect::<StringArray>()),
    }
}

/// A text as it is, and an id of another kind than the rest as JSON writes it.
fn plain(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}
