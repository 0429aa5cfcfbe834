//! Regions to and from any format of serde.
//!
//! A region is a sequence of polygons, a polygon a sequence of rings, the outer one first, a ring a sequence of `[x, y]`
//! without repeating the first: GeoJSON's coordinates of a MultiPolygon, but for the closing points. The depth of a polygon
//! follows from the rest.

use crate::region::{Invalid, Polygon, Region, rings::Rings};
use glam::DVec2;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

struct RingPoints<'r>(&'r [DVec2]);

impl Serialize for RingPoints<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(DVec2::to_array))
    }
}

/// The outer ring, then the holes.
impl Serialize for Polygon<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let rings: Vec<RingPoints<'_>> =
            std::iter::once(self.outer()).chain(self.holes()).map(RingPoints).collect();
        rings.serialize(serializer)
    }
}

/// A sequence of polygons, outermost first: `[[[[x, y], …], hole, …], …]`.
impl Serialize for Region {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let polygons: Vec<Polygon<'_>> = self.polygons().collect();
        polygons.serialize(serializer)
    }
}

/// Reads only what [`Serialize`] writes. An error names the coordinate that is not finite, names the edges that meet, or
/// says that the rings are not in their canonical direction, nesting or order. [`Region::from_rings`] reads any rings.
///
/// JSON keeps every bit when `serde_json` is built with its feature `float_roundtrip`.
impl<'de> Deserialize<'de> for Region {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Region, D::Error> {
        let polygons = Vec::<Vec<Vec<[f64; 2]>>>::deserialize(deserializer)?;
        let rings = Rings::read(polygons.iter().flatten()).map_err(de::Error::custom)?;
        let given = Region::as_given(rings);
        // The rings of a region bound it by their direction: read so, they yield it, or they are none.
        let region = given.evaluated_again();
        if region.has_rings_of(&given, polygons.iter().map(Vec::len)) {
            return Ok(region);
        }
        let invalid = given.validate().err().unwrap_or(Invalid::Structure);
        Err(de::Error::custom(format_args!("{invalid}; Region::from_rings reads any rings")))
    }
}
