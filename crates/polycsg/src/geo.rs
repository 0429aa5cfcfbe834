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

/// Reads the rings of a polygon, the first by a number, without the repeated last points.
fn read(polygon: &Polygon<f64>, first: usize) -> Result<Rings, Error> {
    let mut rings = Rings::default();
    for (ring, line) in (first..).zip(std::iter::once(polygon.exterior()).chain(polygon.interiors())) {
        let points = match &line.0[..] {
            [start, points @ .., end] if start == end => &line.0[..=points.len()],
            points => points,
        };
        rings.read_ring(ring, points.iter().map(|c| DVec2::new(c.x, c.y)))?;
    }
    Ok(rings)
}

/// The polygon's rings as they are, even-odd: whatever their directions, a hole cuts. An error names the ring as counted from the
/// exterior, 0. Edges are counted through all rings; the repeated last point of a ring starts none.
///
/// ```
/// use geo_types::polygon;
/// use polycsg::Csg;
/// let square = polygon![(x: 0.0, y: 0.0), (x: 4.0, y: 0.0), (x: 4.0, y: 4.0), (x: 0.0, y: 4.0)];
/// let triangle = polygon![(x: 2.0, y: 2.0), (x: 6.0, y: 2.0), (x: 2.0, y: 6.0)];
/// let rest = Csg::try_from(&square)? - Csg::try_from(&triangle)?;
/// assert_eq!(rest.evaluate().area(), 12.0);
/// # Ok::<(), polycsg::Error>(())
/// ```
impl TryFrom<&Polygon<f64>> for Csg<'_> {
    type Error = Error;
    fn try_from(polygon: &Polygon<f64>) -> Result<Self, Error> {
        Ok(Csg::of_rings(read(polygon, 0)?, FillRule::EvenOdd))
    }
}

/// The union of the polygons, which may overlap. Each is an operand; an error counts rings through all of them.
impl TryFrom<&MultiPolygon<f64>> for Csg<'_> {
    type Error = Error;
    fn try_from(polygons: &MultiPolygon<f64>) -> Result<Self, Error> {
        let mut next = 0;
        let operands: Result<Vec<_>, Error> = polygons
            .iter()
            .map(|polygon| {
                let first = next;
                next += 1 + polygon.interiors().len();
                Ok(Csg::of_rings(read(polygon, first)?, FillRule::EvenOdd))
            })
            .collect();
        Ok(Csg::union(operands?))
    }
}

/// As the same polygon read as a [`Csg`].
impl TryFrom<&Polygon<f64>> for Region {
    type Error = Error;
    fn try_from(polygon: &Polygon<f64>) -> Result<Region, Error> {
        Ok(Csg::try_from(polygon)?.evaluate())
    }
}

/// As the same polygons read as a [`Csg`].
impl TryFrom<&MultiPolygon<f64>> for Region {
    type Error = Error;
    fn try_from(polygons: &MultiPolygon<f64>) -> Result<Region, Error> {
        Ok(Csg::try_from(polygons)?.evaluate())
    }
}
