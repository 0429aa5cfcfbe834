//! Geometries of FlatGeobuf, every offset checked.
use crate::layer::areas::{Areas, Reading, polygon_of, refused};
use flatgeobuf::{Feature, Geometry, GeometryType};
use geo_types::{Coord, LineString, Polygon};

/// What a feature is read as; the header names the kind of all, or each geometry its own.
pub(super) fn read(feature: &Feature<'_>, of_all: GeometryType) -> Result<Reading, String> {
    let Some(geometry) = feature.geometry() else { return Ok(Reading::default()) };
    let kind = if of_all == GeometryType::Unknown { geometry.type_() } else { of_all };
    let is_empty =
        geometry.xy().is_none_or(|xy| xy.is_empty()) && geometry.parts().is_none_or(|parts| parts.is_empty());
    let areas = match kind {
        _ if is_empty => return Ok(Reading::default()),
        GeometryType::Polygon => Areas::polygon(polygon(&geometry)?),
        GeometryType::MultiPolygon => {
            let parts = geometry.parts().ok_or("a MultiPolygon has no parts")?;
            let polygons: Result<Vec<_>, String> = parts.iter().map(|part| polygon(&part)).collect();
            Areas::multi_polygon(polygons?)
        }
        other => return Err(refused(other.variant_name().unwrap_or("geometry of an unknown kind"))),
    };
    // The format writes no geometry as one without a vertex, however many parts that is made of.
    Ok(if areas.vertices() == 0 { Reading::default() } else { Reading::flat(areas) })
}

fn polygon(geometry: &Geometry<'_>) -> Result<Polygon<f64>, String> {
    let Some(xy) = geometry.xy() else { return Ok(polygon_of(std::iter::empty())) };
    let count = xy.len() / 2;
    let only = [u32::try_from(count).unwrap_or(u32::MAX)];
    let ends: Vec<u32> = match geometry.ends() {
        Some(ends) if !ends.is_empty() => ends.iter().collect(),
        _ => only.to_vec(),
    };
    let mut start = 0;
    let mut rings = Vec::with_capacity(ends.len());
    for end in ends.into_iter().map(|end| end as usize) {
        if end < start || end > count {
            return Err(format!("a ring ends with vertex {end} of {count}"));
        }
        let ring: LineString<f64> =
            (start..end).map(|point| Coord { x: xy.get(2 * point), y: xy.get(2 * point + 1) }).collect();
        rings.push(ring);
        start = end;
    }
    Ok(polygon_of(rings.into_iter()))
}
