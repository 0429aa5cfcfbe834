//! A polygon of a file as planar polygons: itself, its triangles, or its lobes.
//!
//! ```text
//! 3---2
//!  \ /    a bow tie: one lobe is counter-clockwise, the other clockwise, so that together they have no front:
//!   X     Newell's sum is zero, or what rounding leaves of it
//!  / \
//! 0---1
//! ```
use super::flaws::Flaws;
use super::polygon::{Polygon, points};
use super::split::{newell, split};
use crate::plane::Plane;
use formfactor::{Error, PlanarPolygon};
use glam::DVec3;
use polycsg::{FillRule, Region};

/// Planar polygons, numbered from 1 where they are pieces.
type PlanarPieces = Vec<(Option<usize>, PlanarPolygon)>;

/// The polygon as it is or, where it is not planar or has no front, its pieces; nothing where it has no area. Its vertices may be so far
/// from their places as `rounding` says.
pub(super) fn planar(
    loops: &Polygon,
    rounding: f64,
    name: &str,
    flaws: &mut Flaws,
) -> Result<PlanarPieces, Error> {
    let points: Vec<Vec<DVec3>> = loops.iter().map(|ring| points(ring)).collect();
    let error = match PlanarPolygon::new(&points) {
        Ok(polygon) => return Ok(vec![(None, polygon)]),
        Err(error) => error,
    };
    if let Some(lobes) = lobes(&points, rounding) {
        flaws.cross(names(name, lobes.len()));
        return Ok(numbered(lobes));
    }
    match error {
        Error::NotPlanar { distance, .. } => {
            let triangles = split(loops).into_iter().map(|part| part.map(|corner| corner.point));
            let pieces: Vec<_> = triangles.filter_map(|corners| PlanarPolygon::new([corners]).ok()).collect();
            flaws.bend(names(name, pieces.len()), distance);
            Ok(numbered(pieces))
        }
        Error::ZeroArea | Error::TooSmall | Error::NoLoops | Error::TooFewVertices { .. } => {
            flaws.empty(name);
            Ok(Vec::new())
        }
        other => Err(other),
    }
}

fn numbered(pieces: Vec<PlanarPolygon>) -> PlanarPieces {
    pieces.into_iter().zip(1..).map(|(piece, number)| (Some(number), piece)).collect()
}

/// The names of so many pieces.
fn names(name: &str, count: usize) -> impl Iterator<Item = String> {
    (1..=count).map(move |number| format!("{name}.{number}"))
}

/// The lobes of a polygon that crosses itself and has as much area on its left as on its right, but for rounding. All face the way of
/// the triangle of vertices that are far apart.
fn lobes(points: &[Vec<DVec3>], rounding: f64) -> Option<Vec<PlanarPolygon>> {
    let outline = points.first().filter(|outline| outline.len() > 3)?;
    let ends = outline.iter().zip(outline.iter().cycle().skip(1));
    let negligible = rounding * ends.map(|(a, b)| a.distance(*b)).sum::<f64>();
    if newell(outline).length() / 2.0 > negligible {
        return None;
    }
    let plane = Plane::of(&PlanarPolygon::new([far_apart(outline)]).ok()?);
    let flat = points.iter().map(|ring| ring.iter().map(|point| plane.flatten(*point)).collect::<Vec<_>>());
    let region = Region::from_rings(flat, FillRule::EvenOdd).ok()?;
    let lobes = plane.lift(&region, points.iter().flatten().copied());
    (lobes.iter().map(PlanarPolygon::area).sum::<f64>() > negligible).then_some(lobes)
}

/// Three vertices that span a plane well, in their order along the outline.
fn far_apart(outline: &[DVec3]) -> [DVec3; 3] {
    let farthest = |distance: &dyn Fn(DVec3) -> f64| {
        let all = outline.iter().map(|point| distance(*point)).enumerate();
        all.fold((0, 0.0), |best, one| if one.1 > best.1 { one } else { best }).0
    };
    let start = outline[0];
    let end = farthest(&|point| point.distance_squared(start));
    let apex = farthest(&|point| (point - start).cross(outline[end] - start).length_squared());
    [start, outline[end.min(apex)], outline[end.max(apex)]]
}
