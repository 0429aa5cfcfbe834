//! Rings with the same points: one stands for all, so that a million copies of a ring cost little more than one.

use super::{Also, EdgeRing, Edges};
use crate::base::hash::mixed;
use crate::base::id::index;
use glam::DVec2;

/// A ring that has the points of another one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DuplicateRing {
    pub(crate) ring: u32,
    pub(crate) of: u32,
    /// Whether both run in one direction.
    pub(crate) along: bool,
}

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct DuplicateRings {
    keys: Vec<(u64, u32)>,
    found: Vec<DuplicateRing>,
    /// Per ring its lexicographically smallest vertex.
    leftmost: Vec<u32>,
}

impl DuplicateRings {
    /// Lets of rings with the same points one stand for all.
    pub(crate) fn unite(&mut self, edges: &mut Edges) {
        if edges.rings().len() > 1 && !self.find(edges).is_empty() {
            edges.unite(&self.found);
        }
    }

    /// Finds the rings that are copies of another ring, the first of its kind.
    ///
    /// Rings are compared from their leftmost points, so that a copy may be missed if it visits that point twice.
    fn find(&mut self, edges: &Edges) -> &[DuplicateRing] {
        self.found.clear();
        self.keys.clear();
        self.leftmost.clear();
        self.leftmost.extend(edges.rings().iter().map(|ring| leftmost(edges.points(), *ring)));
        let vertices = self.leftmost.iter().zip(0..);
        self.keys.extend(vertices.map(|(&vertex, ring)| (key(edges, vertex), ring)));
        self.keys.sort_unstable();
        for group in self.keys.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
            let mut kinds: Vec<u32> = Vec::new();
            for &(_, ring) in group {
                let mut same = kinds.iter().filter_map(|&of| {
                    direction(edges, [of, ring].map(|ring| self.leftmost[ring as usize]))
                        .map(|along| DuplicateRing { ring, of, along })
                });
                match same.next() {
                    Some(copy) => self.found.push(copy),
                    None => kinds.push(ring),
                }
            }
        }
        &self.found
    }
}

impl Edges {
    /// Lets rings stand for their copies too, and drops these; where they cancel, a ring that changes nothing is left, as its
    /// vertices count.
    pub(crate) fn unite(&mut self, copies: &[DuplicateRing]) {
        let mut dropped = vec![false; self.rings.len()];
        for copy in copies {
            dropped[copy.ring as usize] = true;
            let EdgeRing { counter, winds, .. } = self.rings[copy.ring as usize];
            let winds = if copy.along { winds } else { -winds };
            let of = &mut self.rings[copy.of as usize];
            match counter {
                Some(counter) if Some(counter) != of.counter => {
                    let next = std::mem::replace(&mut of.also, index(self.also.len()));
                    self.also.push(Also { counter, winds, next });
                }
                _ => of.winds += winds,
            }
        }
        self.drop_rings(&dropped);
    }

    fn drop_rings(&mut self, dropped: &[bool]) {
        let rings = std::mem::take(&mut self.rings);
        let mut end = 0;
        self.ring.clear();
        for (ring, _) in rings.iter().zip(dropped).filter(|(_, dropped)| !**dropped) {
            let slots = ring.start as usize..ring.end as usize + 1;
            self.points.copy_within(slots.clone(), end);
            if !self.origins.is_empty() {
                self.origins.copy_within(slots.clone(), end);
            }
            let start = index(end);
            end += slots.len();
            self.ring.resize(end, index(self.rings.len()));
            self.rings.push(EdgeRing { start, end: index(end - 1), ..*ring });
        }
        self.points.truncate(end);
        self.origins.truncate(end);
    }
}

/// The lexicographically smallest vertex of a ring, the first if there are several.
fn leftmost(points: &[DVec2], ring: EdgeRing) -> u32 {
    let mut best = ring.start;
    for vertex in ring.start + 1..ring.end {
        let (p, q) = (points[vertex as usize], points[best as usize]);
        if p.x < q.x || (p.x == q.x && p.y < q.y) {
            best = vertex;
        }
    }
    best
}

/// Equal for rings with the same points, whatever their direction and start; a ring by its leftmost vertex.
fn key(edges: &Edges, vertex: u32) -> u64 {
    let about = edges.ring(vertex);
    let [before, after] = [about.previous(vertex), about.next(vertex)].map(|v| mixed(edges.point(v)));
    let both = before.wrapping_add(after).wrapping_add(u64::from(about.end - about.start));
    (mixed(edges.point(vertex)) ^ both).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

/// Whether two rings, each by a vertex of it, run through the same points from there, in one direction or against one
/// another.
fn direction(edges: &Edges, vertices: [u32; 2]) -> Option<bool> {
    let [a, b] = vertices.map(|vertex| edges.ring(vertex));
    let same = |step: fn(EdgeRing, u32) -> u32| {
        let [mut v, mut w] = vertices;
        (a.start..a.end).all(|_| {
            let same = edges.point(v) == edges.point(w);
            (v, w) = (a.next(v), step(b, w));
            same
        })
    };
    if a.end - a.start != b.end - b.start || !a.is_closed() || !b.is_closed() {
        return None;
    }
    if same(EdgeRing::next) {
        Some(true)
    } else if same(EdgeRing::previous) {
        Some(false)
    } else {
        None
    }
}
