//! Polygons that are connected by edges, and the edges where they are open.
use crate::scene::cap::{Bits, bits};
use crate::shapes::polygon::PlanarPolygon;
use glam::DVec3;

/// Polygons that are connected by edges.
#[derive(Debug)]
pub(super) struct Component {
    pub(super) faces: Vec<usize>,
    /// The edges along which polygons run more often one way than the other: as what closes them runs, and as often.
    pub(super) open: Vec<[DVec3; 2]>,
}

/// A directed edge of a polygon, its ends in order.
struct DirectedEdge {
    key: [Bits; 2],
    ends: [DVec3; 2],
    id: usize,
    is_turned: bool,
}

/// The components of those polygons that lie on their planes exactly and do not cross themselves. O(n log n) for n edges.
pub(super) fn components(polygons: &[PlanarPolygon]) -> Vec<Component> {
    let mut edges: Vec<DirectedEdge> =
        polygons.iter().enumerate().flat_map(|(id, polygon)| edges_of(id, polygon)).collect();
    edges.sort_by_key(|edge| (edge.key, edge.id));
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); polygons.len()];
    for pair in edges.windows(2).filter(|pair| pair[0].key == pair[1].key) {
        neighbours[pair[0].id].push(pair[1].id);
        neighbours[pair[1].id].push(pair[0].id);
    }
    let mut number = vec![None; polygons.len()];
    let mut all = Vec::new();
    for first in (0..polygons.len()).filter(|id| is_exact(&polygons[*id])) {
        if number[first].is_none() {
            let faces = connected(first, &neighbours, &mut number, all.len());
            all.push(Component { faces, open: Vec::new() });
        }
    }
    for uses in edges.chunk_by(|a, b| a.key == b.key) {
        if let Some(component) = number[uses[0].id] {
            all[component].open.extend(closing(uses));
        }
    }
    all
}

fn is_exact(polygon: &PlanarPolygon) -> bool {
    polygon.deviation() == 0.0 && polygon.convex_pieces().next().is_some()
}

/// The edges of a polygon's convex pieces, which run around it whichever way its loops do; those between pieces run both ways.
fn edges_of(id: usize, polygon: &PlanarPolygon) -> Vec<DirectedEdge> {
    let edge = |(a, b): (&DVec3, &DVec3)| {
        let is_turned = bits(*a) > bits(*b);
        let ends = if is_turned { [*b, *a] } else { [*a, *b] };
        DirectedEdge { key: ends.map(bits), ends, id, is_turned }
    };
    let pieces = polygon.convex_pieces().filter(|_| is_exact(polygon));
    pieces.flat_map(|piece| piece.iter().zip(piece.iter().cycle().skip(1)).map(edge)).collect()
}

/// The polygons that are connected with one, numbered as a component.
fn connected(
    first: usize,
    neighbours: &[Vec<usize>],
    number: &mut [Option<usize>],
    component: usize,
) -> Vec<usize> {
    let (mut found, mut open) = (Vec::new(), vec![first]);
    while let Some(id) = open.pop() {
        if number[id].is_none() {
            number[id] = Some(component);
            found.push(id);
            open.extend(&neighbours[id]);
        }
    }
    found.sort_unstable();
    found
}

/// What must run along an edge of these uses so that as many run one way as the other.
fn closing(uses: &[DirectedEdge]) -> impl Iterator<Item = [DVec3; 2]> {
    let turned = uses.iter().filter(|edge| edge.is_turned).count();
    let (straight, [a, b]) = (uses.len() - turned, uses[0].ends);
    let missing = if straight > turned { [b, a] } else { [a, b] };
    std::iter::repeat_n(missing, straight.abs_diff(turned))
}
