//! Reads GeoJSON.
use super::collection;
use super::feature;
use super::schema::{Columns, InOrder, filled};
use crate::failure::Failure;
use crate::formats::reader::{Each, Source, warn_of_flattened};
use crate::input::{Input, warn};
use crate::layer::batch::{Batch, Gathered, Layer};
use geojson::{Feature, JsonObject};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs::File;

/// A document whose columns are known.
pub(crate) struct GeoJson {
    input: Input,
    file: File,
    layer: Layer,
}

/// A feature as the first pass sees it.
#[derive(Deserialize)]
struct Glance {
    properties: Option<InOrder>,
    id: Option<Value>,
    #[serde(flatten)]
    others: BTreeMap<String, IgnoredAny>,
}

impl GeoJson {
    /// Reads all but the geometries, to know the columns.
    pub(crate) fn open(input: &Input) -> Result<GeoJson, Failure> {
        let (file, name) = (input.file()?, input.name());
        let (mut columns, mut lost, mut number) = (Columns::default(), None, 0_usize);
        let mut see = |glance: Glance| {
            columns.see(&glance.properties.unwrap_or_default(), glance.id.as_ref());
            let known = ["type", "geometry", "bbox"];
            let other = glance.others.into_keys().find(|key| !known.contains(&key.as_str()));
            lost = lost.take().or(other.map(|key| (number, key)));
            number += 1;
            input.interrupt.check()
        };
        let crs = collection::read(&name, input.stream_of(&file)?, &mut see)?;
        if let Some((feature, member)) = lost {
            warn(format!(
                "{name}: feature {feature}: its member {member:?} is left out, as all but id, geometry and properties are"
            ));
        }
        let layer = Layer { name, schema: columns.schema(), crs };
        Ok(GeoJson { input: input.clone(), file, layer })
    }
}

impl Source for GeoJson {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn read(self: Box<Self>, each: &mut Each<'_>) -> Result<(), Failure> {
        let GeoJson { input, file, layer } = *self;
        let (mut gathered, mut rows) = (Gathered::default(), Vec::new());
        let mut take = |feature: Feature| {
            let id = feature.id.map(|id| serde_json::to_value(id).unwrap_or_default());
            let reading = feature::read(feature.geometry).map_err(|error| {
                let id = id.as_ref().map_or(String::new(), |id| format!(" (id {id})"));
                Failure::data(&layer.name, format!("feature {}{id}: {error}", gathered.next))
            })?;
            gathered.push(reading);
            rows.push((feature.properties.unwrap_or_default(), id));
            if gathered.is_full() { each(batch(&layer, &mut gathered, &mut rows)?) } else { Ok(()) }
        };
        collection::read(&layer.name, input.stream_of(&file)?, &mut take)?;
        warn_of_flattened(&layer, &gathered);
        each(batch(&layer, &mut gathered, &mut rows)?)
    }
}

fn batch(
    layer: &Layer,
    gathered: &mut Gathered,
    rows: &mut Vec<(JsonObject, Option<Value>)>,
) -> Result<Batch, Failure> {
    let attributes = filled(&layer.schema, rows).map_err(|error| Failure::data(&layer.name, error))?;
    rows.clear();
    Ok(gathered.take(attributes))
}
