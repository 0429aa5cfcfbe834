//! Well-known binary. The crate wkb reads it; what it does not look at is checked here.
use crate::layer::areas::{Areas, Reading};
use ::wkb::reader::Wkb;
use ::wkb::writer::{WriteOptions, write_multi_polygon, write_polygon};
use geo_traits::{GeometryTrait, GeometryType, MultiPolygonTrait};

/// What the bytes of one geometry say: ISO's and PostGIS's dialects.
pub(crate) fn read(bytes: &[u8]) -> Result<Reading, String> {
    let geometry = Wkb::try_new(bytes).map_err(|error| format!("this is no WKB: {error}"))?;
    let rest = bytes.len() - geometry.buf().len();
    if rest > 0 {
        return Err(format!("this is no WKB: {rest} bytes too many"));
    }
    if let GeometryType::MultiPolygon(polygons) = geometry.as_type() {
        polygons.polygons().try_for_each(|part| is_polygon_of(bytes, part.buf()))?;
    }
    Reading::of(&geometry)
}

/// The crate reads the parts of a MultiPolygon in its order of bytes and of its dimension: others would be misread.
fn is_polygon_of(whole: &[u8], part: &[u8]) -> Result<(), String> {
    let [whole, part] = [head(whole)?, head(part)?];
    if whole.0 != part.0 {
        return Err("the parts of a MultiPolygon are in another order of bytes; write it in one".into());
    }
    if whole.1.wrapping_sub(3) != part.1 {
        return Err("this is no WKB: a part of a MultiPolygon is no Polygon of its dimension".into());
    }
    Ok(())
}

/// The order of bytes and the kind, without the bit that tells that the number of a coordinate system follows, which a part may lack.
fn head(bytes: &[u8]) -> Result<(u8, u32), String> {
    let [order, kind @ ..] = *bytes.first_chunk::<5>().ok_or("this is no WKB: a part is missing")?;
    let kind = if order == 0 { u32::from_be_bytes(kind) } else { u32::from_le_bytes(kind) };
    Ok((order, kind & !(1 << 29)))
}

/// As ISO writes it, the least significant byte first.
pub(crate) fn written(areas: &Areas) -> Result<Vec<u8>, String> {
    let (mut bytes, options) = (Vec::new(), WriteOptions::default());
    match &areas.polygons.0[..] {
        [polygon] if !areas.is_multi => write_polygon(&mut bytes, polygon, &options),
        _ => write_multi_polygon(&mut bytes, &areas.polygons, &options),
    }
    .map_err(|error| error.to_string())?;
    Ok(bytes)
}
