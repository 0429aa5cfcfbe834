//! Polygons that close open edges.
use crate::error::Error;
use crate::scene::cap::{Bits, bits};
use crate::shapes::polygon::PlanarPolygon;
use glam::DVec3;
use std::collections::BTreeMap;

/// What lacks more lids is not closed: sets of lids are the bits of a number.
const MOST: usize = 64;

/// Nor is what has more open edges: ways are followed in the square of their number.
const MOST_EDGES: usize = 4096;

/// Lids that run along edges as these run: a polygon for each closed way that lies in a plane, triangles for others. Ways that are straight
/// lines, as where a vertex ends on an edge, need none. `None` where they are too many, or too small to tell.
pub(super) fn lids(open: &[[DVec3; 2]]) -> Option<Vec<PlanarPolygon>> {
    let mut lids = Vec::new();
    for way in ways(open)? {
        match flat(&way) {
            Some(lid) => lids.push(lid),
            None => fan(&way, &mut lids)?,
        }
        if lids.len() > MOST {
            return None;
        }
    }
    Some(lids)
}

/// The closed ways that directed edges make, each through a vertex once.
fn ways(open: &[[DVec3; 2]]) -> Option<Vec<Vec<DVec3>>> {
    if open.len() > MOST_EDGES {
        return None;
    }
    let mut onward: BTreeMap<Bits, Vec<DVec3>> = BTreeMap::new();
    open.iter().for_each(|[a, b]| onward.entry(bits(*a)).or_default().push(*b));
    let mut found = Vec::new();
    while let Some((start, _)) = onward.first_key_value() {
        let mut way = vec![DVec3::from_array(start.map(f64::from_bits))];
        // As many edges leave each vertex as come there: only at the start there is none left.
        while let Some(next) = way.last().and_then(|last| step(&mut onward, *last)) {
            match way.iter().position(|p| *p == next) {
                Some(at) => {
                    found.push(way[at..].to_vec());
                    way.truncate(at + 1);
                }
                None => way.push(next),
            }
        }
    }
    Some(found)
}

/// Where an edge leads that starts at a vertex and was not taken yet.
fn step(onward: &mut BTreeMap<Bits, Vec<DVec3>>, from: DVec3) -> Option<DVec3> {
    let ends = onward.get_mut(&bits(from))?;
    let end = ends.pop();
    if ends.is_empty() {
        onward.remove(&bits(from));
    }
    end
}

/// The polygon in a closed way, if it has one plane and does not cross itself.
fn flat(way: &[DVec3]) -> Option<PlanarPolygon> {
    let polygon = PlanarPolygon::new([way]).ok()?;
    (polygon.deviation() == 0.0 && polygon.convex_pieces().next().is_some()).then_some(polygon)
}

/// Triangles between the first vertex of a way and the others.
fn fan(way: &[DVec3], lids: &mut Vec<PlanarPolygon>) -> Option<()> {
    for pair in way.get(1..)?.windows(2) {
        match PlanarPolygon::new([[way[0], pair[0], pair[1]]]) {
            Ok(triangle) => lids.push(triangle),
            Err(Error::ZeroArea) => {}
            Err(_) => return None,
        }
        if lids.len() > MOST {
            return None;
        }
    }
    Some(())
}
