//! T-junctions: a vertex of one patch within an edge of another becomes a vertex of that one, too.
//!
//! ```text
//! ┌───────────┐        ┌─────┬─────┐
//! │           │        │           │
//! ├─────┬─────┤   →    ├─────┼─────┤     the edge of the upper patch has the vertex in its middle
//! │     │     │        │     │     │
//! └─────┴─────┘        └─────┴─────┘
//! ```
//!
//! Form factors do not mind them. But neighbours that share their edges are found to be walls of one body, and no seam opens where a writer or
//! a picture rounds.
use super::findings::WIDTH;
use super::weld::{PointKey, key};
use crate::coplanar::SINGLE;
use crate::extent::{BoxTree, Extent};
use crate::plane::{Plane, slack};
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::Patch,
};
use formfactor::PlanarPolygon;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// So many edges are looked at before `stop` is asked.
const BATCH: usize = 4096;

/// A vertex of a patch.
#[derive(Clone, Copy, Debug)]
struct PatchVertex {
    place: DVec3,
    patch: usize,
}

/// What is one with a patch.
#[derive(Debug)]
struct Closeness {
    plane: Plane,
    /// What is no further from its edges lies on them.
    near: f64,
    /// Vertices are welded from no further away.
    reach: f64,
}

impl Closeness {
    fn of(patch: &Patch) -> Closeness {
        let reach = SINGLE * Extent::of(patch).diagonal();
        Closeness { plane: Plane::of(&patch.polygon), near: patch.slack(), reach }
    }
}

/// An edge that patches have, and the vertices of others within it, from its first end on.
#[derive(Debug)]
struct SharedEdge {
    ends: [DVec3; 2],
    /// The least length that an edge keeps.
    least: f64,
    patches: Vec<usize>,
    within: Vec<PatchVertex>,
}

/// By the keys of their ends, the lower one first.
type SharedEdges = BTreeMap<[PointKey; 2], SharedEdge>;

/// Gives edges the vertices of other patches that lie within them, as far as all patches that have an edge stay planar; tells which. Nothing
/// when `stop` says to stop. O(n log n) for n vertices that are spread out.
pub(super) fn join(scene: &mut Scene, stop: &dyn Fn() -> bool) -> Option<Vec<Finding>> {
    let mut edges = edges(scene);
    find(scene, &mut edges, stop)?;
    edges.retain(|_, edge| !edge.within.is_empty());
    let polygons = polygons(scene, &mut edges);
    let findings = findings(scene, &edges);
    polygons.into_iter().for_each(|(patch, polygon)| scene.patches[patch].polygon = polygon);
    Some(findings)
}

fn edges(scene: &Scene) -> SharedEdges {
    let mut edges = SharedEdges::new();
    for (index, patch) in scene.patches.iter().enumerate() {
        for [a, b] in patch.polygon.loops().flat_map(sides) {
            let (at, ends) =
                if key(a) < key(b) { ([key(a), key(b)], [a, b]) } else { ([key(b), key(a)], [b, a]) };
            let edge = || SharedEdge { ends, least: 0.0, patches: Vec::new(), within: Vec::new() };
            edges.entry(at).or_insert_with(edge).patches.push(index);
        }
    }
    edges
}

fn sides(ring: &[DVec3]) -> impl Iterator<Item = [DVec3; 2]> {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| [*a, *b])
}

/// Finds the vertices within edges.
fn find(scene: &Scene, edges: &mut SharedEdges, stop: &dyn Fn() -> bool) -> Option<()> {
    let mut vertices = Vec::new();
    for (patch, Patch { polygon, .. }) in scene.patches.iter().enumerate() {
        vertices.extend(polygon.loops().flatten().map(|&place| PatchVertex { place, patch }));
    }
    let boxes = BoxTree::new(vertices.iter().map(|vertex| Extent { low: vertex.place, high: vertex.place }));
    let all: Vec<Closeness> = scene.patches.iter().map(Closeness::of).collect();
    for (index, edge) in edges.values_mut().enumerate() {
        if index % BATCH == 0 && stop() {
            return None;
        }
        let patches: Vec<&Closeness> = edge.patches.iter().map(|patch| &all[*patch]).collect();
        let near = patches.iter().map(|patch| patch.near).fold(f64::INFINITY, f64::min);
        let found = boxes.along(edge.ends, near).into_iter().map(|vertex| vertices[vertex]);
        let others = found.filter(|vertex| !edge.patches.contains(&vertex.patch));
        // What is nearer to an end than vertices are welded from would not stay apart from it.
        let reach = patches.iter().map(|patch| patch.reach).fold(near, f64::max);
        edge.least = reach.max(WIDTH * slack(&edge.ends));
        edge.within = within(edge, near, others, &patches);
    }
    Some(())
}

/// The vertices within an edge, in their order: as near to it as rounding, away from its ends, and in the planes of its patches.
fn within(
    &SharedEdge { ends, least, .. }: &SharedEdge,
    near: f64,
    vertices: impl Iterator<Item = PatchVertex>,
    patches: &[&Closeness],
) -> Vec<PatchVertex> {
    let [a, b] = ends;
    let share = |place: DVec3| (place - a).dot(b - a) / (b - a).length_squared();
    let is_within = |&PatchVertex { place, .. }: &PatchVertex| {
        let share = share(place);
        (0.0..=1.0).contains(&share)
            && place.distance(a + share * (b - a)) <= near
            && ends.iter().all(|end| place.distance(*end) > least)
            && patches.iter().all(|patch| patch.plane.height(place).abs() <= slack(&ends))
    };
    let mut found: Vec<PatchVertex> = vertices.filter(is_within).collect();
    found.sort_by(|p, q| share(p.place).total_cmp(&share(q.place)));
    found
}

/// The polygons of the patches whose edges have vertices within. An edge of a patch that does not stay planar gets none.
fn polygons(scene: &Scene, edges: &mut SharedEdges) -> BTreeMap<usize, PlanarPolygon> {
    loop {
        let patches: BTreeSet<usize> = edges.values().flat_map(|edge| &edge.patches).copied().collect();
        let joined = |patch: usize| (patch, joined(&scene.patches[patch], edges));
        let (polygons, bent): (Vec<_>, Vec<_>) =
            patches.into_iter().map(joined).partition(|(_, polygon)| polygon.is_some());
        if bent.is_empty() {
            return polygons.into_iter().filter_map(|(patch, polygon)| Some((patch, polygon?))).collect();
        }
        let bent: HashSet<usize> = bent.into_iter().map(|(patch, _)| patch).collect();
        edges.retain(|_, edge| !edge.patches.iter().any(|patch| bent.contains(patch)));
    }
}

/// The polygon of a patch with the vertices within its edges; `None` where it would not be planar.
fn joined(patch: &Patch, edges: &SharedEdges) -> Option<PlanarPolygon> {
    let side = |[a, b]: [DVec3; 2]| {
        let is_along = key(a) < key(b);
        let edge = edges.get(&if is_along { [key(a), key(b)] } else { [key(b), key(a)] });
        let mut places = edge.map_or_else(Vec::new, apart);
        if !is_along {
            places.reverse();
        }
        std::iter::once(a).chain(places)
    };
    let rings = patch.polygon.loops().map(|ring| sides(ring).flat_map(side).collect::<Vec<_>>());
    PlanarPolygon::new(rings).ok()
}

/// The places of the vertices within an edge, without those that are too near to the one before.
fn apart(edge: &SharedEdge) -> Vec<DVec3> {
    let mut places: Vec<DVec3> = Vec::with_capacity(edge.within.len());
    for &PatchVertex { place, .. } in &edge.within {
        if places.last().is_none_or(|before| place.distance(*before) > edge.least) {
            places.push(place);
        }
    }
    places
}

/// One for each two patches of which the vertices of the first lie within edges of the second.
fn findings(scene: &Scene, edges: &SharedEdges) -> Vec<Finding> {
    let mut pairs: BTreeMap<[usize; 2], (usize, DVec3)> = BTreeMap::new();
    for edge in edges.values() {
        for (vertex, patch) in
            edge.within.iter().flat_map(|vertex| edge.patches.iter().map(move |patch| (vertex, patch)))
        {
            pairs.entry([vertex.patch, *patch]).or_insert((0, vertex.place)).0 += 1;
        }
    }
    let what = |count: usize, place: DVec3| match count {
        1 => format!("a vertex of the first lies within an edge of the second, at {place}"),
        _ => format!("{count} vertices of the first lie within edges of the second, one at {place}"),
    };
    let finding = |([first, second], (count, place)): ([usize; 2], (usize, DVec3))| Finding {
        kind: Kind::TJunction,
        patches: [first, second].map(|patch| scene.patches[patch].name.clone()).into(),
        what: what(count, place),
        repair: "add the vertex to that edge; or let reading or inspect --repair do it".into(),
        places: Vec::new(),
    };
    pairs.into_iter().map(finding).collect()
}
