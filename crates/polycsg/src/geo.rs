//! Conversions from and to `geo-types`.

use crate::error::Error;
use crate::expression::csg::{Csg, FillRule};
use crate::region::{self, Region, rings::Rings};
use geo_types::{Coord, LineString, MultiPolygon, Polygon};
use glam::DVec2;

fn line_string(ring: &[DVec2]) -> LineString<f64> {
    // geo-types repeats the first point.
    ring.iter().chain(ring.first()).map(|p| Coord { x: p.x, y: p.y }).collect()
}

impl From<region::Polygon<'_>> for Polygon<f64> {
    fn from(polygon: region::Polygon<'_>) -> Self {
        Polygon::new(line_string(polygon.outer()), polygon.holes().map(line_string).collect())
    }
}

impl From<&Region> for MultiPolygon<f64> {
    fn from(region: &Region) -> Self {
        MultiPolygon(region.polygons().map(Polygon::from).collect())
    }
}

/// The points of a line string; the repeated last one does no harm.
fn points(line: &LineString<f64>) -> Vec<DVec2> {
    line.coords().map(|c| DVec2::new(c.x, c.y)).collect()
}

/// The rings of a polygon, even-odd: whatever their directions, a hole cuts.
fn rings(polygon: &Polygon<f64>) -> Vec<Vec<DVec2>> {
    std::iter::once(polygon.exterior()).chain(polygon.interiors()).map(points).collect()
}

/// An error names the ring as counted from the exterior, 0.
impl TryFrom<&Polygon<f64>> for Region {
    type Error = Error;
    fn try_from(polygon: &Polygon<f64>) -> Result<Region, Error> {
        Region::from_rings(rings(polygon), FillRule::EvenOdd)
    }
}

/// The union of the polygons, which may overlap; an error counts rings through all of them.
impl TryFrom<&MultiPolygon<f64>> for Region {
    type Error = Error;
    fn try_from(polygons: &MultiPolygon<f64>) -> Result<Region, Error> {
        let all: Vec<Vec<Vec<DVec2>>> = polygons.iter().map(rings).collect();
        Rings::read(all.iter().flatten())?;
        let operands: Result<Vec<Csg<'_>>, Error> =
            all.iter().map(|rings| Csg::from_rings(rings, FillRule::EvenOdd)).collect();
        Ok(Csg::union(operands?).evaluate())
    }
}
