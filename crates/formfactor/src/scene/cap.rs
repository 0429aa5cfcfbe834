//! Caps: polygons that a few more convex faces would close around a convex solid, as walls and a roof on the ground, or
//! the four walls of a column.
//!
//! ```text
//!      _______
//!     /|     /|      A line meets the solid's boundary twice. So what passes through the solid is blocked by the cap, or passes
//!    /_|____/ |      through two lids. Where one of them only closes the cap and the others are closed off by what else is
//!    | :    | |      there, that cannot be: from outside a cap hides what the closed solid hides.
//!    | :....|_|
//!    |/  lid|/
//! ```
use super::shell::Adjacency;
use super::slab::Slab;
use crate::numeric::predicates::{Plane, turn_in_plane};
use crate::shapes::holes::{holes, outline};
use crate::shapes::polygon::PlanarPolygon;
use glam::{DVec2, DVec3};
use std::{
    cmp::Ordering,
    collections::{BTreeMap, BTreeSet},
};

/// The polygons of a cap, and the faces that it lacks, their fronts outward: none of a closed body.
#[derive(Clone, Debug)]
pub(super) struct Cap {
    pub(super) faces: Vec<usize>,
    pub(super) lids: Vec<PlanarPolygon>,
    /// The holes of its faces, which are lids too.
    pub(super) holes: Vec<PlanarPolygon>,
}

impl Cap {
    /// The cap that a convex shell is, if a few faces of the convex hull of its corners close it.
    pub(super) fn of(polygons: &[PlanarPolygon], faces: Vec<usize>, adjacency: &Adjacency) -> Option<Self> {
        let lids = lids(polygons, &faces, adjacency)?;
        let holes = faces.iter().filter_map(|face| holes(&polygons[*face])).flatten().collect();
        Some(Self { faces, lids, holes })
    }
}

/// Solids of more corners are not looked for: wrapping takes their square.
const MOST_CORNERS: usize = 128;

/// Nor such as lack more faces.
const MOST_LIDS: usize = 16;

/// A corner's bits.
pub(super) type Bits = [u64; 3];

pub(super) fn bits(p: DVec3) -> Bits {
    p.to_array().map(f64::to_bits)
}

/// The faces that convex faces lack to close around the convex hull of their corners, if they are faces of it. `adjacency` has what is
/// across each edge.
fn lids(polygons: &[PlanarPolygon], faces: &[usize], adjacency: &Adjacency) -> Option<Vec<PlanarPolygon>> {
    let mut corners: Vec<DVec3> =
        faces.iter().flat_map(|face| outline(&polygons[*face])).map(|(a, _)| a).collect();
    corners.sort_by_key(|p| bits(*p));
    corners.dedup();
    if corners.len() > MOST_CORNERS {
        return None;
    }
    let edges = faces.iter().flat_map(|face| outline(&polygons[*face]).zip(&adjacency.0[*face]));
    let open = edges.filter(|(_, across)| across.is_none_or(|other| !faces.contains(&other)));
    // A lid's edges run the other way.
    let mut open: BTreeMap<[Bits; 2], [DVec3; 2]> =
        open.map(|((a, b), _)| ([bits(b), bits(a)], [b, a])).collect();
    let mut lids = Vec::new();
    while let Some((_, edge)) = open.pop_first() {
        let lid = wrap(edge, &corners)?;
        for (a, b) in outline(&lid).filter(|(a, b)| [*a, *b] != edge) {
            if open.remove(&[bits(a), bits(b)]).is_none() {
                open.insert([bits(b), bits(a)], [b, a]);
            }
        }
        lids.push(lid);
        if lids.len() > MOST_LIDS {
            return None;
        }
    }
    is_closed(faces.iter().map(|face| &polygons[*face]).chain(&lids)).then_some(lids)
}

/// Whether each edge runs once each way.
fn is_closed<'p>(sides: impl Iterator<Item = &'p PlanarPolygon>) -> bool {
    let edges: Vec<[Bits; 2]> = sides.flat_map(outline).map(|(a, b)| [bits(a), bits(b)]).collect();
    let known: BTreeSet<&[Bits; 2]> = edges.iter().collect();
    known.len() == edges.len() && edges.iter().all(|[a, b]| known.contains(&[*b, *a]))
}

/// The face of the convex hull of corners that an edge of it belongs to, counter-clockwise seen from outside.
fn wrap([from, to]: [DVec3; 2], corners: &[DVec3]) -> Option<PlanarPolygon> {
    let mut planes = corners.iter().filter_map(|corner| Plane::through([from, to, *corner]));
    let first = planes.next()?;
    let outer =
        planes.fold(
            first,
            |best, plane| {
                if best.side_of(plane.corners[2]) == Ordering::Greater { plane } else { best }
            },
        );
    let slab = |corner: DVec3| PlanarPolygon::new([[from, to, corner]]).ok().map(|face| Slab::of(&face));
    let rough = slab(outer.corners[2])?;
    // Of corners that are on it but for roundings the farthest from the edge says best how the plane lies.
    let breadth = |p: &DVec3| (*p - from).cross(to - from).length_squared();
    let level = corners.iter().filter(|p| rough.side_of(**p).is_eq());
    let slab = slab(*level.max_by(|a, b| breadth(a).total_cmp(&breadth(b)))?)?;
    let mut on = Vec::new();
    for corner in corners {
        match slab.side_of(*corner) {
            Ordering::Greater => return None,
            Ordering::Equal => on.push(*corner),
            Ordering::Less => (),
        }
    }
    let is_solid = on.len() < corners.len();
    let face = PlanarPolygon::new([hull(&on, &outer)?]).ok()?;
    (is_solid && face.is_convex()).then_some(face)
}

/// The convex hull of points of a plane, without those within its sides, counter-clockwise seen from where its normal points to.
fn hull(points: &[DVec3], plane: &Plane) -> Option<Vec<DVec3>> {
    let normal = plane.rounded();
    let dropped = normal.abs().max_position();
    let [u, v] = [(dropped + 1) % 3, (dropped + 2) % 3];
    let flat = |p: &DVec3| DVec2::new(p[u], p[v]);
    let mut points = points.to_vec();
    points.sort_by(|a, b| flat(a).to_array().partial_cmp(&flat(b).to_array()).unwrap_or(Ordering::Equal));
    let mut ring = half_hull(points.iter(), flat);
    ring.extend(half_hull(points.iter().rev(), flat));
    if normal[dropped] < 0.0 {
        ring.reverse();
    }
    (ring.len() > 2).then_some(ring)
}

/// The right-hand side of a hull, from the first of its points on, without the last. [Andrew 1979]
fn half_hull<'p>(points: impl Iterator<Item = &'p DVec3>, flat: impl Fn(&DVec3) -> DVec2) -> Vec<DVec3> {
    let mut side: Vec<DVec3> = Vec::new();
    for point in points {
        while let [.., a, b] = &side[..] {
            if turn_in_plane(flat(a), flat(b), flat(point)) == Ordering::Greater {
                break;
            }
            side.pop();
        }
        side.push(*point);
    }
    side.pop();
    side
}
