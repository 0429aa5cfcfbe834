//! What form factors from area to area need of the polygons, found once: their convex pieces, and the convex occluders among
//! them.
use super::cap::Cap;
use super::coplanar::planes;
use super::inside::{Solid, Within};
use super::occluder::{Face, Occluder, Ridge, ball};
use super::plates::{plates, supports};
use super::shell::{Adjacency, shells};
use super::slab::Slab;
use super::tree::Tree;
use crate::shapes::cell::{Cell, Nodes, fan};
use crate::shapes::extent::Extent;
use crate::shapes::loops::leaf;
use crate::shapes::pieces::pieces;
use crate::shapes::polygon::PlanarPolygon;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// A polygon as a source and as a target.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    /// A point of its plane, and its unit normal.
    pub(crate) face: Face,
    pub(crate) middle: DVec3,
    pub(crate) radius: f64,
    pub(crate) area: f64,
    /// The number of its plane.
    pub(crate) plane: usize,
    /// The convex solid that it is a face of.
    pub(crate) body: Option<usize>,
    /// Convex pieces, counter-clockwise seen from the front.
    pub(crate) pieces: Vec<Vec<DVec3>>,
    /// The boundary, with the surface to the left.
    pub(crate) edges: Vec<[DVec3; 2]>,
    pub(crate) cells: Vec<Cell>,
    /// Halves of the sides of its cells, the fourth root of the sum of both ways' fourth powers: the largest.
    pub(crate) side: f64,
    /// Whether some cell is a triangle.
    pub(crate) is_triangular: bool,
    /// Four nodes of each cell.
    pub(crate) nodes: Vec<Nodes>,
    /// The hollow solids that it looks into.
    pub(crate) hollows: Vec<Hollow>,
    /// The solids whose faces count for it one by one, as it is in them.
    pub(crate) inside: Vec<usize>,
}

/// A convex solid that is an occluder though it is hollow, as what lies in the plane of one of its sides looks into it.
#[derive(Clone, Debug)]
pub(crate) struct Hollow {
    /// The number of the solid, and of the side.
    pub(crate) solid: usize,
    pub(crate) side: usize,
    /// The side, counter-clockwise seen from inside.
    pub(crate) outline: Vec<DVec3>,
}

impl Hollow {
    /// The sides of the side, one after the other.
    pub(crate) fn edges(&self) -> impl Iterator<Item = [DVec3; 2]> + '_ {
        let next = self.outline.iter().cycle().skip(1);
        self.outline.iter().zip(next).map(|(a, b)| [*a, *b])
    }

    pub(crate) fn perimeter(&self) -> f64 {
        self.edges().map(|[a, b]| a.distance(b)).sum()
    }
}

/// What may stand in between.
#[derive(Clone, Debug)]
pub(crate) struct Hider {
    pub(crate) shape: Occluder,
    pub(crate) of: Origin,
    /// The solid that it is a face of, if it hides only what has to do with what is in there.
    pub(crate) wall_of: Option<usize>,
}

impl Hider {
    /// Whether it counts between two surfaces: a solid, or its faces where one of the two is inside.
    pub(crate) fn counts(&self, one: &Surface, other: &Surface) -> bool {
        let is_in = |solid: usize| one.inside.contains(&solid) || other.inside.contains(&solid);
        match (self.wall_of, self.of) {
            (Some(solid), _) => is_in(solid),
            (None, Origin::Body(solid)) => !is_in(solid),
            (None, Origin::Plane(_)) => true,
        }
    }
}

/// What an occluder is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    /// A convex solid.
    Body(usize),
    /// Polygons in a plane.
    Plane(usize),
}

/// All polygons as surfaces, and all occluders.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surfaces {
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) hiders: Vec<Hider>,
    /// The boxes around the occluders.
    pub(crate) tree: Tree,
}

impl Surfaces {
    /// Takes O(n log n) for n vertices where few planes have all polygons on one side, plus the unions of coplanar polygons.
    pub(crate) fn of(polygons: &[PlanarPolygon], adjacency: &Adjacency, tree: &Tree) -> Self {
        let slabs: Vec<Slab> = polygons.iter().map(Slab::of).collect();
        let planes = planes(polygons, &slabs);
        let caps = caps(polygons, adjacency, &slabs);
        let solids = solids(polygons, &caps, tree);
        let mut solid_of = vec![None; polygons.len()];
        for (number, (solid, _)) in solids.iter().enumerate() {
            solid.faces.iter().for_each(|face| solid_of[*face] = Some(number));
        }
        let surface =
            |(polygon, (plane, solid)): (_, (&usize, &Option<usize>))| Surface::new(polygon, *plane, *solid);
        let mut surfaces: Vec<Surface> =
            polygons.iter().zip(planes.iter().zip(&solid_of)).map(surface).collect();
        for (number, (solid, within)) in solids.iter().enumerate() {
            let sides: Vec<&PlanarPolygon> = solid.sides(polygons).collect();
            for (id, side) in &within.inward {
                let outline = sides[*side].points().iter().rev().copied().collect();
                surfaces[*id].hollows.push(Hollow { solid: number, side: *side, outline });
            }
            within.insiders.iter().for_each(|id| surfaces[*id].inside.push(number));
        }
        let hider = |(number, (solid, _)): (usize, &(Solid, Within))| Hider {
            shape: of_solid(polygons, &planes, *solid),
            of: Origin::Body(number),
            wall_of: None,
        };
        let mut hiders: Vec<Hider> = solids.iter().enumerate().map(hider).collect();
        let by_plane = |ids: &mut dyn Iterator<Item = usize>| {
            let mut in_plane: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
            ids.for_each(|id| in_plane.entry(planes[id]).or_default().push(id));
            in_plane
        };
        let plates = |(plane, ids): (usize, Vec<usize>), wall_of: Option<usize>| {
            let hider = move |shape| Hider { shape, of: Origin::Plane(plane), wall_of };
            plates(polygons, &ids).into_iter().map(hider)
        };
        let points: Vec<DVec3> = polygons.iter().flat_map(PlanarPolygon::points).copied().collect();
        let mut free = by_plane(&mut (0..polygons.len()).filter(|id| solid_of[*id].is_none()));
        free.retain(|plane, _| !supports(&polygons[*plane], &points));
        hiders.extend(free.into_iter().flat_map(|plane| plates(plane, None)));
        for (number, (solid, _)) in
            solids.iter().enumerate().filter(|(_, (_, within))| !within.insiders.is_empty())
        {
            let walls = by_plane(&mut solid.faces.iter().copied());
            hiders.extend(walls.into_iter().flat_map(|plane| plates(plane, Some(number))));
        }
        let extents: Vec<Extent> = hiders.iter().map(|hider| Extent::around(&hider.shape.corners)).collect();
        Self { surfaces, hiders, tree: Tree::around(&extents) }
    }
}

impl Surface {
    pub(crate) fn new(polygon: &PlanarPolygon, plane: usize, body: Option<usize>) -> Self {
        let points = polygon.points();
        let (middle, radius) = ball(points);
        let pieces = pieces(polygon);
        let area = pieces.iter().map(|piece| area(piece)).sum();
        let cells: Vec<Cell> = pieces.iter().flat_map(|piece| fan(piece)).collect();
        let nodes = cells.iter().map(Nodes::of).collect();
        let side = cells.iter().map(half_side).fold(0.0, f64::max);
        let is_triangular = cells.iter().any(|cell| cell[2] == cell[3]);
        Self {
            side,
            is_triangular,
            face: [points[0], polygon.normal()],
            middle,
            radius,
            area,
            plane,
            body,
            edges: edges(polygon),
            pieces,
            cells,
            nodes,
            hollows: Vec::new(),
            inside: Vec::new(),
        }
    }

    /// A part of it, whose front is on the same side.
    pub(crate) fn part(&self, polygon: &PlanarPolygon) -> Self {
        let (hollows, inside) = (self.hollows.clone(), self.inside.clone());
        Self { face: self.face, hollows, inside, ..Self::new(polygon, self.plane, self.body) }
    }

    /// Whether it is a part of an occluder, or lies in its plane: then the occluder hides nothing of it.
    pub(crate) fn is_of(&self, owner: Origin) -> bool {
        match owner {
            Origin::Body(body) => self.body == Some(body),
            Origin::Plane(plane) => self.plane == plane,
        }
    }
}

fn half_side([a, b, c, d]: &Cell) -> f64 {
    let ways = [a.distance(*b).max(c.distance(*d)), b.distance(*c).max(d.distance(*a))];
    ways.map(|way| (way / 2.0).powi(4)).iter().sum::<f64>().sqrt().sqrt()
}

/// The edges of a polygon's rings, outer ones counter-clockwise and holes clockwise.
fn edges(polygon: &PlanarPolygon) -> Vec<[DVec3; 2]> {
    if polygon.is_convex() {
        return polygon.edges().map(<[_; 2]>::from).collect();
    }
    let region = leaf(&polygon.flat_loops()).evaluate();
    let pairs = |ring: &[DVec2]| {
        let raised: Vec<DVec3> = ring.iter().map(|p| polygon.raise(*p)).collect();
        let next = raised.iter().copied().cycle().skip(1);
        raised.iter().copied().zip(next).map(<[_; 2]>::from).collect::<Vec<_>>()
    };
    region.rings().flat_map(pairs).collect()
}

/// The area of a convex polygon in space.
pub(crate) fn area(corners: &[DVec3]) -> f64 {
    let spokes = corners[1..].windows(2).map(|pair| (pair[0] - corners[0]).cross(pair[1] - corners[0]));
    spokes.sum::<DVec3>().length() / 2.0
}

/// Closed bodies, then other caps. The two sides of a sheet close around nothing: they are no solid.
fn caps(polygons: &[PlanarPolygon], adjacency: &Adjacency, slabs: &[Slab]) -> Vec<Cap> {
    let is_sheet = |faces: &[usize]| faces.iter().all(|face| slabs[faces[0]].has(&polygons[*face]));
    let shells = shells(polygons, adjacency, |id, point| slabs[id].side_of(point)).into_iter();
    let solid = |faces: Vec<usize>| if is_sheet(&faces) { None } else { Cap::of(polygons, faces, adjacency) };
    let mut caps: Vec<Cap> = shells.filter_map(solid).collect();
    caps.sort_by_key(|cap| !cap.lids.is_empty());
    caps
}

/// Those that hide from others what they would if they were full, and what is inside of each.
fn solids<'c>(polygons: &[PlanarPolygon], caps: &'c [Cap], tree: &Tree) -> Vec<(Solid<'c>, Within)> {
    let solids = caps.iter().map(|cap| Solid { faces: &cap.faces, lids: &cap.lids, holes: &cap.holes });
    solids.filter_map(|solid| Some((solid, solid.inside(polygons, tree)?))).collect()
}

/// A convex solid: the edges between faces in different planes.
fn of_solid(polygons: &[PlanarPolygon], planes: &[usize], solid: Solid) -> Occluder {
    let bits = |p: DVec3| p.to_array().map(f64::to_bits);
    let own = solid.faces.iter().map(|id| planes[*id]).chain(planes.len()..);
    // Holes add no edges.
    let closed = solid.faces.len() + solid.lids.len();
    let sides: Vec<(usize, &PlanarPolygon)> = own.zip(solid.sides(polygons)).take(closed).collect();
    let mut numbers: Vec<usize> = sides.iter().map(|side| side.0).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let number = |plane: usize| numbers.binary_search(&plane).unwrap_or(0);
    let edges =
        || sides.iter().flat_map(|(plane, side)| side.edges().map(move |edge| (number(*plane), edge)));
    let left: BTreeMap<_, usize> = edges().map(|(own, (a, b))| ([bits(a), bits(b)], own)).collect();
    let ridges = edges().filter_map(|(own, (a, b))| {
        let other = *left.get(&[bits(b), bits(a)])?;
        (own < other).then_some(Ridge { ends: [a, b], sides: [own, other] })
    });
    let mut faces: Vec<Face> = vec![[DVec3::ZERO; 2]; numbers.len()];
    sides.iter().for_each(|(plane, side)| faces[number(*plane)] = [side.points()[0], side.normal()]);
    let deviation = sides.iter().map(|(_, side)| side.deviation()).fold(0.0, f64::max);
    Occluder::body(ridges.collect(), faces, deviation)
}
