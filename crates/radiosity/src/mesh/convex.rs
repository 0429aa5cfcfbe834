//! A patch in convex parts.
use super::{frame::Frame, refusal::MeshRefusal};
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};
use polycsg::{FillRule, Region};
use std::collections::BTreeMap;

/// Parts of less than this share of the whole are what rounding left.
const SLIVER: f64 = 1e-12;

/// The sine of a turn that is none.
const STRAIGHT: f64 = 1e-9;

/// A corner in the frame and in space.
pub(crate) type PlacedCorner = (DVec2, DVec3);

/// The convex parts of a polygon, counter-clockwise. It is cut through its reflex corners, along the axes of its frame, those nearest to
/// its middle first. Its holes may run either way.
pub(crate) fn convex_parts(
    polygon: &PlanarPolygon,
    frame: &Frame,
) -> Result<Vec<Vec<PlacedCorner>>, MeshRefusal> {
    let rings: Vec<Vec<DVec2>> =
        polygon.loops().map(|points| points.iter().map(|p| frame.flatten(*p)).collect()).collect();
    let mut places: BTreeMap<[u64; 2], DVec3> = BTreeMap::new();
    for (flat, place) in rings.iter().flatten().zip(polygon.loops().flatten()) {
        places.insert(key(*flat), *place);
    }
    let least = SLIVER * rings.iter().map(|ring| area(ring).abs()).fold(0.0, f64::max);
    // Only of holes that run against their outline is it known which corners are reflex.
    let mut open = if rings.len() > 1 { rings_of(&region(&rings)?) } else { vec![rings] };
    let mut parts = Vec::new();
    while let Some(rings) = open.pop() {
        match cut(&rings, least)? {
            Some(halves) => open.extend(halves),
            None => parts.extend(rings.into_iter().filter(|ring| area(ring) > least)),
        }
    }
    let place = |flat: DVec2| (flat, places.get(&key(flat)).copied().unwrap_or_else(|| frame.lift(flat)));
    Ok(parts.into_iter().map(|ring| straight(ring).into_iter().map(place).collect()).collect())
}

/// A convex ring without the vertices within its sides.
fn straight(ring: Vec<DVec2>) -> Vec<DVec2> {
    let count = ring.len();
    let turns = |k: &usize| {
        let [a, b, c] = [k + count - 1, *k, k + 1].map(|k| ring[k % count]);
        let [before, after] = [b - a, c - b];
        before.perp_dot(after).abs() > STRAIGHT * before.length() * after.length()
    };
    (0..count).filter(turns).map(|k| ring[k]).collect()
}

fn key(flat: DVec2) -> [u64; 2] {
    flat.to_array().map(|coordinate| (coordinate + 0.0).to_bits())
}

fn area(ring: &[DVec2]) -> f64 {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() / 2.0
}

/// What is not convex, cut in two along the first line that leaves more than rounding on both sides; `None` where there is none.
fn cut(rings: &[Vec<DVec2>], least: f64) -> Result<Option<Vec<Vec<Vec<DVec2>>>>, MeshRefusal> {
    for line in lines(rings) {
        let mut halves = halves(rings, line)?;
        halves.retain(|rings| rings.iter().map(|ring| area(ring)).sum::<f64>() > least);
        if halves.len() > 1 {
            return Ok(Some(halves));
        }
    }
    Ok(None)
}

/// Where to cut what is not convex: points and directions, those nearest to the middle first.
fn lines(rings: &[Vec<DVec2>]) -> Vec<[DVec2; 2]> {
    let count = rings.iter().map(Vec::len).sum::<usize>() as f64;
    let middle = rings.iter().flatten().sum::<DVec2>() / count;
    let corners = rings.iter().flat_map(|ring| {
        let count = ring.len();
        (0..count).map(move |k| [ring[(k + count - 1) % count], ring[k], ring[(k + 1) % count]])
    });
    let reflex = corners.filter(|corner| is_reflex(*corner)).map(|[_, b, _]| b);
    let mut lines: Vec<[DVec2; 2]> =
        reflex.flat_map(|corner| [DVec2::X, DVec2::Y].map(|way| [corner, way])).collect();
    let far = |[corner, way]: &[DVec2; 2]| way.perp_dot(middle - *corner).abs();
    lines.sort_by(|a, b| far(a).total_cmp(&far(b)));
    lines
}

/// Whether a polygon turns right at a corner by more than rounding can make it: what is less does no harm.
fn is_reflex([a, b, c]: [DVec2; 3]) -> bool {
    let [before, after] = [b - a, c - b];
    before.perp_dot(after) < -STRAIGHT * before.length() * after.length()
}

/// The parts on both sides of a line along an axis.
fn halves(rings: &[Vec<DVec2>], [point, way]: [DVec2; 2]) -> Result<Vec<Vec<Vec<DVec2>>>, MeshRefusal> {
    let whole = region(rings)?;
    let far = 4.0 * rings.iter().flatten().map(|p| p.distance(point)).fold(0.0, f64::max);
    let mut parts = Vec::new();
    for side in [way.perp(), -way.perp()] {
        let corners =
            [point - way * far, point + way * far, point + (way + side) * far, point + (side - way) * far];
        parts.extend(rings_of(&whole.intersection(&region(&[corners.to_vec()])?)));
    }
    Ok(parts)
}

/// What is inside an odd number of rings.
fn region(rings: &[Vec<DVec2>]) -> Result<Region, MeshRefusal> {
    Region::from_rings(rings, FillRule::EvenOdd)
        .map_err(|error| MeshRefusal(format!("it cannot be cut in convex parts ({error})")))
}

/// The rings of each polygon of a region: the outline counter-clockwise, then its holes clockwise.
fn rings_of(region: &Region) -> Vec<Vec<Vec<DVec2>>> {
    let rings = |polygon: polycsg::Polygon<'_>| {
        std::iter::once(polygon.outer()).chain(polygon.holes()).map(<[DVec2]>::to_vec).collect()
    };
    region.polygons().map(rings).collect()
}
