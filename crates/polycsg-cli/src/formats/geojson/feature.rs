//! Features of GeoJSON as polygons.
use crate::layer::areas::{Areas, Reading, polygon_of, refused};
use geo_types::{Coord, LineString, Polygon};
use geojson::{Geometry, GeometryValue, Position};

/// What a geometry of GeoJSON is read as.
pub(super) fn read(geometry: Option<Geometry>) -> Result<Reading, String> {
    let Some(geometry) = geometry else { return Ok(Reading::default()) };
    let mut is_flattened = false;
    let areas = match geometry.value {
        GeometryValue::Polygon { coordinates } => Areas::polygon(polygon(coordinates, &mut is_flattened)?),
        GeometryValue::MultiPolygon { coordinates } => {
            let polygons = coordinates.into_iter().map(|rings| polygon(rings, &mut is_flattened));
            Areas::multi_polygon(polygons.collect::<Result<Vec<_>, String>>()?)
        }
        other => return Err(refused(other.type_name())),
    };
    Ok(Reading { areas: Some(areas), is_flattened })
}

fn polygon(rings: Vec<Vec<Position>>, is_flattened: &mut bool) -> Result<Polygon<f64>, String> {
    let rings: Result<Vec<LineString<f64>>, String> =
        rings.iter().map(|ring| line(ring, is_flattened)).collect();
    Ok(polygon_of(rings?.into_iter()))
}

fn line(ring: &[Position], is_flattened: &mut bool) -> Result<LineString<f64>, String> {
    let point = |position: &Position| match *position.as_slice() {
        [x, y] => Ok(Coord { x, y }),
        [x, y, ..] => {
            *is_flattened = true;
            Ok(Coord { x, y })
        }
        _ => Err("a position has fewer than two numbers".to_owned()),
    };
    ring.iter().map(point).collect()
}

/// Polygons as GeoJSON writes them.
pub(super) fn written(areas: &Areas) -> GeometryValue {
    let mut polygons = areas.polygons.iter().map(|polygon| {
        let rings = crate::layer::areas::rings(polygon).filter(|ring| !ring.0.is_empty());
        rings.map(|ring| ring.0.iter().map(|point| Position::from([point.x, point.y])).collect()).collect()
    });
    if areas.is_multi {
        GeometryValue::MultiPolygon { coordinates: polygons.collect() }
    } else {
        GeometryValue::Polygon { coordinates: polygons.next().unwrap_or_default() }
    }
}
