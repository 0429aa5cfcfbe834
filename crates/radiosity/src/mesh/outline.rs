//! The polygon around a set of elements.
use super::divide::Points;
use super::element::{Element, Mesh};
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// The mesh's vertices in their patches' frames, and the pieces of the patches' edges.
#[derive(Debug, Default)]
pub(crate) struct Flat {
    points: Vec<DVec2>,
    /// The first vertex at the same point of the same patch.
    welded: Vec<usize>,
    /// Which edge of its patch a piece of the boundary belongs to, by the piece's two ends.
    edges: BTreeMap<[usize; 2], usize>,
}

impl Flat {
    /// Appends a patch whose first vertex has index `base`, and whose vertices are at the points `vertices`.
    pub(super) fn append(&mut self, base: usize, vertices: &[usize], points: &Points) {
        let mut first = vec![usize::MAX; points.flat.len()];
        for (vertex, &point) in vertices.iter().enumerate() {
            first[point] = first[point].min(base + vertex);
        }
        self.points.extend(vertices.iter().map(|&point| points.flat[point]));
        self.welded.extend(vertices.iter().map(|&point| first[point]));
        self.edges.extend(points.boundary.iter().map(|piece| (piece.ends.map(|end| first[end]), piece.edge)));
    }

    /// The polygon that the given elements of one patch cover; vertices in the middle of a straight side are left out.
    pub(crate) fn outline(
        &self,
        mesh: &Mesh,
        elements: &[Element],
    ) -> Result<PlanarPolygon, formfactor::Error> {
        let mut loops: Vec<_> = link(&self.rim(elements)).iter().map(|walk| self.straighten(walk)).collect();
        let outer = (0..loops.len()).max_by(|&a, &b| self.area(&loops[a]).total_cmp(&self.area(&loops[b])));
        loops.swap(0, outer.unwrap_or(0));
        let lift =
            |walk: &Vec<usize>| walk.iter().map(|&vertex| mesh.vertices[vertex]).collect::<Vec<DVec3>>();
        PlanarPolygon::new(loops.iter().map(lift))
    }

    /// The directed sides that only one of the elements has, sorted.
    fn rim(&self, elements: &[Element]) -> Vec<[usize; 2]> {
        let sides = elements.iter().flat_map(|element| {
            let [a, b, c] = element.corners.map(|corner| self.welded[corner]);
            [[a, b], [b, c], [c, a]]
        });
        let mut sides: Vec<_> = sides.collect();
        sides.sort_unstable();
        sides.iter().filter(|[a, b]| sides.binary_search(&[*b, *a]).is_err()).copied().collect()
    }

    /// Drops the vertices that lie on a straight line with their neighbours by construction: inside an edge of the
    /// patch, or on a line of the lattice.
    fn straighten(&self, walk: &[usize]) -> Vec<usize> {
        let count = walk.len();
        let corner =
            |&k: &usize| !self.straight(walk[(k + count - 1) % count], walk[k], walk[(k + 1) % count]);
        (0..count).filter(corner).map(|k| walk[k]).collect()
    }

    /// Whether the way from `before` to `after` passes `vertex` without a turn, known without rounding.
    fn straight(&self, before: usize, vertex: usize, after: usize) -> bool {
        let [a, b, c] = [before, vertex, after].map(|v| self.points[v]);
        let onward = (b - a).dot(c - b) > 0.0;
        let edge = self.edges.get(&[before, vertex]);
        let inside_edge = edge.is_some() && edge == self.edges.get(&[vertex, after]);
        onward && (inside_edge || (a.x == b.x && b.x == c.x) || (a.y == b.y && b.y == c.y))
    }

    /// Signed area of a closed walk in the frame.
    fn area(&self, walk: &[usize]) -> f64 {
        let next = walk.iter().cycle().skip(1);
        walk.iter().zip(next).map(|(&a, &b)| self.points[a].perp_dot(self.points[b])).sum::<f64>() / 2.0
    }
}

/// Closed walks over sides sorted by their start; each side is used once.
fn link(sides: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let mut used = vec![false; sides.len()];
    let mut walks = Vec::new();
    for first in 0..sides.len() {
        let mut walk = Vec::new();
        let mut next = Some(first).filter(|&side| !used[side]);
        while let Some(side) = next {
            used[side] = true;
            walk.push(sides[side][0]);
            let [_, end] = sides[side];
            let from = sides.partition_point(|other| other[0] < end);
            next = (from..sides.len()).take_while(|&k| sides[k][0] == end).find(|&k| !used[k]);
        }
        if !walk.is_empty() {
            walks.push(walk);
        }
    }
    walks
}
