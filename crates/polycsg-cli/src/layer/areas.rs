//! The polygons of one feature, as a file gives them.
use geo_traits::{
    CoordTrait, Dimensions, GeometryTrait, GeometryType, LineStringTrait, MultiPolygonTrait, PolygonTrait,
};
use geo_types::{Coord, LineString, MultiPolygon, Polygon};
use polycsg::Region;

/// Polygons, valid or not, every bit of their coordinates as it was read. A ring that was open is closed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Areas {
    pub(crate) polygons: MultiPolygon<f64>,
    /// Whether it is written as a `MultiPolygon`.
    pub(crate) is_multi: bool,
}

/// What a geometry was read as.
#[derive(Debug, Default)]
pub(crate) struct Reading {
    /// None where there is no geometry.
    pub(crate) areas: Option<Areas>,
    /// Whether it had more than x and y, which is left out.
    pub(crate) is_flattened: bool,
}

impl Areas {
    /// A region as one `Polygon`, or as a `MultiPolygon`; none if it is empty.
    pub(crate) fn of(region: &Region) -> Option<Areas> {
        let polygons = MultiPolygon::from(region);
        let is_multi = polygons.0.len() != 1;
        (!region.is_empty()).then_some(Areas { polygons, is_multi })
    }

    /// One `Polygon` as it was read.
    pub(crate) fn polygon(polygon: Polygon<f64>) -> Areas {
        Areas { polygons: MultiPolygon(vec![polygon]), is_multi: false }
    }

    /// A `MultiPolygon` as it was read. Polygons without a vertex are left out.
    pub(crate) fn multi_polygon(polygons: impl IntoIterator<Item = Polygon<f64>>) -> Areas {
        let filled = polygons.into_iter().filter(|polygon| !polygon.exterior().0.is_empty());
        Areas { polygons: filled.collect(), is_multi: true }
    }

    /// The number of vertices.
    pub(crate) fn vertices(&self) -> usize {
        self.polygons.iter().flat_map(rings).map(|ring| ring.0.len()).sum()
    }

    /// The kind of geometry that it is written as.
    pub(crate) fn kind(&self) -> &'static str {
        if self.is_multi { "MultiPolygon" } else { "Polygon" }
    }
}

impl Reading {
    pub(crate) fn flat(areas: Areas) -> Reading {
        Reading { areas: Some(areas), is_flattened: false }
    }

    /// Of a geometry that another crate has parsed.
    pub(crate) fn of(geometry: &impl GeometryTrait<T = f64>) -> Result<Reading, String> {
        let areas = match geometry.as_type() {
            GeometryType::Polygon(polygon) => Areas::polygon(read_polygon(polygon)),
            GeometryType::MultiPolygon(polygons) => {
                Areas::multi_polygon(polygons.polygons().map(|polygon| read_polygon(&polygon)))
            }
            GeometryType::Point(_) => return Err(refused("Point")),
            GeometryType::LineString(_) | GeometryType::Line(_) => return Err(refused("LineString")),
            GeometryType::MultiPoint(_) => return Err(refused("MultiPoint")),
            GeometryType::MultiLineString(_) => return Err(refused("MultiLineString")),
            _ => return Err(refused("GeometryCollection")),
        };
        Ok(Reading { areas: Some(areas), is_flattened: geometry.dim() != Dimensions::Xy })
    }
}

/// All rings, the outer one first.
pub(crate) fn rings(polygon: &Polygon<f64>) -> impl Iterator<Item = &LineString<f64>> {
    std::iter::once(polygon.exterior()).chain(polygon.interiors())
}

/// What is said of a geometry of another kind.
pub(crate) fn refused(kind: &str) -> String {
    let reason =
        if kind == "GeometryCollection" { "give the polygons that it holds" } else { "it has no area" };
    format!("a {kind} is no Polygon or MultiPolygon: {reason}")
}

/// A polygon of rings, the outer one first.
pub(crate) fn polygon_of(mut rings: impl Iterator<Item = LineString<f64>>) -> Polygon<f64> {
    let exterior = rings.next().unwrap_or(LineString(Vec::new()));
    Polygon::new(exterior, rings.collect())
}

fn read_polygon(polygon: &impl PolygonTrait<T = f64>) -> Polygon<f64> {
    let exterior = polygon.exterior().map(|ring| read_ring(&ring));
    polygon_of(exterior.into_iter().chain(polygon.interiors().map(|ring| read_ring(&ring))))
}

fn read_ring(ring: &impl LineStringTrait<T = f64>) -> LineString<f64> {
    ring.coords().map(|point| Coord { x: point.x(), y: point.y() }).collect()
}
