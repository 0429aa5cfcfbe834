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
        polygons.polygons().try_for_each(|part| is_polygon(part.buf(), bytes[0]))?;
    }
    Reading::of(&geometry)
}

/// The parts of a MultiPolygon must be polygons in its order of bytes, else they were misread.
fn is_polygon(part: &[u8], order: u8) -> Result<(), String> {
    let [first, word @ ..] = *part.first_chunk::<5>().ok_or("this is no WKB: a part is missing")?;
    if first != order {
        return Err("the parts of a MultiPolygon are in another order of bytes; write it in one".into());
    }
    let word = if order == 0 { u32::from_be_bytes(word) } else { u32::from_le_bytes(word) };
    if (word & 0x0fff_ffff) % 1000 != 3 {
        return Err("this is no WKB: a part of a MultiPolygon is no Polygon".into());
    }
    Ok(())
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
