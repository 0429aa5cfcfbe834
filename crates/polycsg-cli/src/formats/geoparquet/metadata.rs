//! What GeoParquet says in the key `geo` of a file's metadata, and what this program says of columns.
use crate::layer::crs::{Crs, Definition};
use arrow_schema::{Field, Schema};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, HashMap};

/// The key for what columns are marked as, which Parquet's types do not tell.
pub(super) const MARKS: &str = "polycsg:columns";

/// The marks of all columns that have some, as JSON.
pub(super) fn marks(schema: &Schema) -> Value {
    let marked = schema.fields().iter().filter(|field| !field.metadata().is_empty());
    marked.map(|field| (field.name().clone(), json!(field.metadata()))).collect::<Map<_, _>>().into()
}

/// A schema with the marks that were written beside it. Those of columns that are not there are passed over.
pub(super) fn marked(schema: &Schema, marks: &str) -> Result<Schema, String> {
    let marks: BTreeMap<String, HashMap<String, String>> =
        serde_json::from_str(marks).map_err(|error| format!("the key `{MARKS}`: {error}"))?;
    let mark = |field: &Field| match marks.get(field.name()) {
        Some(marks) => field.clone().with_metadata(marks.clone()),
        None => field.clone(),
    };
    Ok(Schema::new(schema.fields().iter().map(|field| mark(field)).collect::<Vec<_>>()))
}

/// The key's value.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct Geo {
    #[serde(default)]
    pub(super) version: String,
    pub(super) primary_column: String,
    pub(super) columns: BTreeMap<String, GeometryColumn>,
}

/// What it says of a column of geometries.
#[derive(Debug, Default, Deserialize, Serialize)]
pub(super) struct GeometryColumn {
    pub(super) encoding: String,
    #[serde(default)]
    pub(super) geometry_types: Vec<String>,
    /// Longitude and latitude where it is missing, unknown where it is null.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub(super) crs: Option<Value>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) bbox: Vec<f64>,
    /// Columns that repeat what the geometries say.
    #[serde(default, skip_serializing_if = "Value::is_null")]
    pub(super) covering: Value,
}

fn present<'de, D: serde::Deserializer<'de>>(json: D) -> Result<Option<Value>, D::Error> {
    Value::deserialize(json).map(Some)
}

impl GeometryColumn {
    /// The column whose boxes would no longer be those of the geometries.
    pub(super) fn boxes(&self) -> Option<&str> {
        self.covering["bbox"]["xmin"][0].as_str()
    }

    pub(super) fn system(&self) -> Crs {
        let Some(json) = &self.crs else { return Crs::longitude_latitude() };
        let text = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let id = &json["id"];
        let code = id.is_object().then(|| (text(&id["authority"]), text(&id["code"])));
        Crs { code, definition: (!json.is_null()).then(|| Definition::Json(json.clone())) }
    }
}

/// What is written of the coordinates: PROJJSON as it was read, nothing for longitude and latitude, null for what has no PROJJSON.
pub(super) fn stated(crs: &Crs) -> Option<Value> {
    match &crs.definition {
        Some(Definition::Json(json)) if json["type"] != "name" => Some(json.clone()),
        _ if crs.is_longitude_latitude() => None,
        _ => {
            if crs.code.is_some() || crs.definition.is_some() {
                let name = crs.name();
                crate::input::warn(format!(
                    "GeoParquet takes PROJJSON for the coordinates' system {name}, which the input lacks: it is left out"
                ));
            }
            Some(Value::Null)
        }
    }
}
