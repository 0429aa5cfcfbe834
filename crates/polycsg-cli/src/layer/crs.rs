//! The system of a layer's coordinates, as far as a file states it.
use crate::failure::Failure;
use serde_json::Value;

/// What a file says of its coordinates. Nothing here transforms them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Crs {
    /// An authority and its code, such as `EPSG:31983`.
    pub(crate) code: Option<(String, String)>,
    /// The definition in the words of its format.
    pub(crate) definition: Option<Definition>,
}

/// A definition in the words of a format.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Definition {
    /// Well-known text, as in FlatGeobuf.
    Wkt(String),
    /// PROJJSON, as in GeoParquet, or the member `crs` of older GeoJSON.
    Json(Value),
}

impl Crs {
    /// Longitude and latitude on WGS 84, which GeoJSON and GeoParquet mean where they say nothing.
    pub(crate) fn longitude_latitude() -> Crs {
        Crs { code: Some(("OGC".into(), "CRS84".into())), definition: None }
    }

    /// Whether it is longitude and latitude on WGS 84. All formats here store the longitude first, whatever EPSG says.
    pub(crate) fn is_longitude_latitude(&self) -> bool {
        let is = |(authority, code): &(String, String)| {
            (authority.eq_ignore_ascii_case("EPSG") && code == "4326") || code.eq_ignore_ascii_case("CRS84")
        };
        self.code.as_ref().is_some_and(is)
    }

    pub(crate) fn is_known(&self) -> bool {
        self.code.is_some() || self.definition.is_some()
    }

    /// For messages.
    pub(crate) fn name(&self) -> String {
        match (&self.code, &self.definition) {
            (Some((authority, code)), _) => format!("{authority}:{code}"),
            (None, Some(Definition::Wkt(text))) => text.chars().take(60).collect(),
            (None, Some(Definition::Json(json))) => json["name"].as_str().unwrap_or("without a code").into(),
            (None, None) => "unknown".into(),
        }
    }
}

/// Refuses two layers of which both state the system of their coordinates, and not the same one.
pub(crate) fn must_agree(a: (&str, &Crs), b: (&str, &Crs)) -> Result<(), Failure> {
    let same = match (&a.1.code, &b.1.code) {
        (Some(one), Some(other)) => {
            one.0.eq_ignore_ascii_case(&other.0) && one.1 == other.1
                || a.1.is_longitude_latitude() && b.1.is_longitude_latitude()
        }
        _ => a.1.definition == b.1.definition,
    };
    if same || !a.1.is_known() || !b.1.is_known() {
        return Ok(());
    }
    let [one, other] = [a, b].map(|(file, crs)| format!("{file} is in {}", crs.name()));
    Err(Failure::Data(format!("the coordinates differ: {one}, {other}; transform one of them first")))
}
