//! A document of GeoJSON in one pass, a feature at a time. (The crate geojson finds the features by the first bracket, which may be a
//! `bbox`'s, and takes no empty collection.)
use crate::failure::Failure;
use crate::layer::crs::Crs;
use crate::layer::crs::Definition;
use serde::de::{
    DeserializeOwned, DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor,
};
use serde_json::{Map, Value, json};
use std::fmt;
use std::io::BufRead;

/// What takes the features, in their order.
type Take<'t, T> = dyn FnMut(T) -> Result<(), Failure> + 't;

/// Reads a FeatureCollection, a Feature or a geometry. Returns what it says of its coordinates; in a collection it must say so
/// before the features.
pub(super) fn read<T: DeserializeOwned>(
    name: &str,
    bytes: impl BufRead,
    take: &mut Take<'_, T>,
) -> Result<Crs, Failure> {
    let mut document = Document { take, features: None, refused: None, crs: Crs::longitude_latitude() };
    let mut json = serde_json::Deserializer::from_reader(bytes);
    let read = document.deserialize(&mut json).and_then(|crs| json.end().map(|()| crs));
    let place = document.features.map_or(String::new(), |number| format!("feature {number}: "));
    match (read, document.refused) {
        (_, Some(failure)) => Err(failure),
        (Ok(crs), None) => Ok(crs),
        (Err(error), None) if error.is_io() => Err(Failure::read(name, error)),
        (Err(error), None) => Err(Failure::data(name, format!("{place}{error}"))),
    }
}

struct Document<'d, 't, T> {
    take: &'d mut Take<'t, T>,
    /// The number of the feature that is read, while one is.
    features: Option<usize>,
    /// Why `take` took no more.
    refused: Option<Failure>,
    crs: Crs,
}

impl<'de, T: DeserializeOwned> DeserializeSeed<'de> for &mut Document<'_, '_, T> {
    type Value = Crs;
    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<Crs, D::Error> {
        json.deserialize_map(self)
    }
}

impl<'de, T: DeserializeOwned> Visitor<'de> for &mut Document<'_, '_, T> {
    type Value = Crs;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a FeatureCollection, a Feature or a geometry")
    }

    fn visit_map<M: MapAccess<'de>>(self, mut members: M) -> Result<Crs, M::Error> {
        let (mut kind, mut has_features, mut others) = (None, false, Map::new());
        while let Some(key) = members.next_key::<String>()? {
            match key.as_str() {
                "type" => kind = Some(members.next_value::<String>()?),
                "features" => {
                    members.next_value_seed(Features(&mut *self))?;
                    has_features = true;
                }
                "crs" => self.crs = stated(members.next_value()?),
                "bbox" => drop(members.next_value::<IgnoredAny>()?),
                _ => drop(others.insert(key, members.next_value()?)),
            }
        }
        match kind.as_deref() {
            Some("FeatureCollection") if has_features => {}
            Some("FeatureCollection") => {
                return Err(M::Error::custom("the collection has no member `features`"));
            }
            Some(kind) => self.alone(kind, others)?,
            None => return Err(M::Error::custom("the member `type` is missing: this is no GeoJSON")),
        }
        Ok(self.crs.clone())
    }
}

impl<T: DeserializeOwned> Document<'_, '_, T> {
    /// One feature, or one geometry, that is no collection's.
    fn alone<E: Error>(&mut self, kind: &str, mut members: Map<String, Value>) -> Result<(), E> {
        members.insert("type".into(), kind.into());
        let feature = if kind == "Feature" {
            Value::Object(members)
        } else {
            json!({ "type": "Feature", "geometry": members, "properties": null })
        };
        self.features = Some(0);
        let feature = serde_json::from_value(feature).map_err(E::custom)?;
        self.take(feature)
    }

    fn take<E: Error>(&mut self, feature: T) -> Result<(), E> {
        (self.take)(feature).map_err(|failure| {
            self.refused = Some(failure);
            E::custom("refused")
        })
    }
}

/// The member `features`.
struct Features<'f, 'd, 't, T>(&'f mut Document<'d, 't, T>);

impl<'de, T: DeserializeOwned> DeserializeSeed<'de> for Features<'_, '_, '_, T> {
    type Value = ();
    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<(), D::Error> {
        json.deserialize_seq(self)
    }
}

impl<'de, T: DeserializeOwned> Visitor<'de> for Features<'_, '_, '_, T> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of features")
    }

    fn visit_seq<S: SeqAccess<'de>>(self, mut features: S) -> Result<(), S::Error> {
        self.0.features = Some(0);
        while let Some(feature) = features.next_element()? {
            self.0.take(feature)?;
            self.0.features = self.0.features.map(|number| number + 1);
        }
        self.0.features = None;
        Ok(())
    }
}

/// The member `crs` of GeoJSON as it was before RFC 7946.
fn stated(member: Value) -> Crs {
    let name = member["properties"]["name"].as_str().unwrap_or_default();
    // "urn:ogc:def:crs:EPSG::31983" and "EPSG:31983"
    let parts: Vec<&str> = name.trim_start_matches("urn:ogc:def:crs:").split(':').collect();
    let code = match parts[..] {
        [authority, code] | [authority, _, code] => Some((authority.to_owned(), code.to_owned())),
        _ => None,
    };
    Crs { code, definition: Some(Definition::Json(member)) }
}
