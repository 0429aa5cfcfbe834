//! Arrays read into features.
use super::encoding::Encoding;
use super::features::Features;
use crate::error::Error;
use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef};
use arrow_schema::{DataType, Field};
use datafusion_common::{DataFusionError, Result, internal_err};
use geo_traits::{
    CoordTrait, GeometryTrait, GeometryType, LineStringTrait, MultiPolygonTrait, PointTrait, PolygonTrait,
};
use geoarrow_array::GeoArrowArrayAccessor;
use geoarrow_array::array::{MultiPolygonArray, PointArray, PolygonArray};
use geoarrow_schema::GeoArrowType;
use polycsg::DVec2;
use wkb::reader::Wkb;

/// The features of an array, in its encoding.
pub(crate) fn features(array: &ArrayRef, encoding: &Encoding, field: &Field) -> Result<Features> {
    match encoding {
        Encoding::Wkb(_) => match array.data_type() {
            DataType::Binary => Ok(of_wkb(array.as_binary::<i32>().iter())?),
            DataType::LargeBinary => Ok(of_wkb(array.as_binary::<i64>().iter())?),
            DataType::BinaryView => Ok(of_wkb(array.as_binary_view().iter())?),
            DataType::Null => Ok(of_wkb((0..array.len()).map(|_| None))?),
            other => internal_err!("{other} was planned as WKB"),
        },
        Encoding::Native(kind) => of_native(array, kind, field),
    }
}

fn of_wkb<'a>(rows: impl Iterator<Item = Option<&'a [u8]>>) -> Result<Features, Error> {
    let (mut features, mut before) = (Features::default(), None);
    for (row, bytes) in rows.enumerate() {
        match bytes {
            None => features.push_null(),
            Some(bytes) if before == Some(bytes) => features.repeat(),
            Some(bytes) => push_wkb(&mut features, bytes).map_err(|why| Error::row(row, why))?,
        }
        before = bytes;
    }
    Ok(features)
}

fn push_wkb(features: &mut Features, bytes: &[u8]) -> Result<(), String> {
    let geometry = Wkb::try_new(bytes).map_err(|error| format!("the WKB is broken: {error}"))?;
    let surplus = bytes.len() - geometry.buf().len();
    if surplus > 0 {
        return Err(format!("the WKB is broken: {surplus} bytes stand behind its end"));
    }
    match geometry.as_type() {
        GeometryType::Polygon(polygon) => push_polygon(features, polygon),
        GeometryType::MultiPolygon(parts) => {
            parts.polygons().try_for_each(|part| check_part(bytes, part.buf()))?;
            push_multipolygon(features, parts);
        }
        GeometryType::Point(point) => features.push_point(finite(point)?),
        _ => {
            return Err(format!(
                "a Polygon, a MultiPolygon or a Point is needed, not a {:?}",
                geometry.geometry_type()
            ));
        }
    }
    Ok(())
}

/// The reader takes the parts' order of bytes and dimension from the whole: another one would be misread.
fn check_part(whole: &[u8], part: &[u8]) -> Result<(), String> {
    let word = |bytes: &[u8]| {
        let word = [bytes[1], bytes[2], bytes[3], bytes[4]];
        if bytes[0] == 0 { u32::from_be_bytes(word) } else { u32::from_le_bytes(word) }
    };
    if whole[0] != part[0] {
        return Err("the WKB's order of bytes changes within it; write it in one order".into());
    }
    // The bit 29 tells that the number of a coordinate system follows, which a part may lack.
    if (word(whole) & !(1 << 29)).wrapping_sub(3) != word(part) & !(1 << 29) {
        return Err("a part of the MultiPolygon is no Polygon of its dimension".into());
    }
    Ok(())
}

fn push_polygon(features: &mut Features, polygon: &impl PolygonTrait<T = f64>) {
    let first = features.ring_count();
    push_rings(features, polygon);
    features.push_area(first);
}

fn push_multipolygon(features: &mut Features, parts: &impl MultiPolygonTrait<T = f64>) {
    let first = features.ring_count();
    parts.polygons().for_each(|part| push_rings(features, &part));
    features.push_area(first);
}

fn push_rings(features: &mut Features, polygon: &impl PolygonTrait<T = f64>) {
    for (number, ring) in polygon.exterior().into_iter().chain(polygon.interiors()).enumerate() {
        features.push_ring(number == 0, ring.coords().map(|coordinate| vector(&coordinate)));
    }
}

fn vector(coordinate: &impl CoordTrait<T = f64>) -> DVec2 {
    DVec2::new(coordinate.x(), coordinate.y())
}

/// A point; none, if it is empty, which WKB says by NaN.
fn finite(point: &impl PointTrait<T = f64>) -> Result<Option<DVec2>, String> {
    match point.coord().map(|coordinate| vector(&coordinate)) {
        Some(point) if point.x.is_nan() && point.y.is_nan() => Ok(None),
        Some(point) if !point.is_finite() => {
            Err(format!("the point ({point}) is not finite; give finite numbers"))
        }
        point => Ok(point),
    }
}

fn of_native(array: &ArrayRef, kind: &GeoArrowType, field: &Field) -> Result<Features> {
    let mut features = Features::default();
    let array = array.as_ref();
    match kind {
        GeoArrowType::Polygon(_) => {
            let array = PolygonArray::try_from((array, field)).map_err(unreadable)?;
            each(&array, &mut features, |features, polygon| {
                push_polygon(features, &polygon);
                Ok(())
            })?;
        }
        GeoArrowType::MultiPolygon(_) => {
            let array = MultiPolygonArray::try_from((array, field)).map_err(unreadable)?;
            each(&array, &mut features, |features, parts| {
                push_multipolygon(features, &parts);
                Ok(())
            })?;
        }
        GeoArrowType::Point(_) => {
            let array = PointArray::try_from((array, field)).map_err(unreadable)?;
            each(&array, &mut features, |features, point| {
                features.push_point(finite(&point)?);
                Ok(())
            })?;
        }
        other => return internal_err!("{other:?} was planned as polygons or points"),
    }
    Ok(features)
}

/// Reads each row of an array that is not NULL.
fn each<'a, A: GeoArrowArrayAccessor<'a>>(
    array: &'a A,
    features: &mut Features,
    push: impl Fn(&mut Features, A::Item) -> Result<(), String>,
) -> Result<()> {
    for row in 0..array.len() {
        match array.get(row).map_err(unreadable)? {
            None => features.push_null(),
            Some(item) => {
                push(features, item).map_err(|why| Error::row(row, why))?;
                features.share_if_equal();
            }
        }
    }
    Ok(())
}

fn unreadable(error: impl std::error::Error + Send + Sync + 'static) -> DataFusionError {
    DataFusionError::External(Box::new(error))
}
