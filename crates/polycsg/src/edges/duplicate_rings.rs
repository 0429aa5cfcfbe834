//! Duplicate rings, which have the same points: one represents all, so that a million of them cost little more than one.

use super::{Also, EdgeRing, Edges};
use crate::base::{hash::mixed, id::index};
use crate::spatial::chains::MonotoneChains;

/// A ring with the same points as an earlier one.
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
}

impl DuplicateRings {
    /// Lets one of several duplicate rings represent all, and tells whether there were any.
    pub(crate) fn unite(&mut self, edges: &mut Edges, chains: &MonotoneChains) -> bool {
        let found = self.find(edges, chains);
        edges.unite(found);
        !found.is_empty()
    }

    /// Finds the duplicates of each first ring of its kind.
    ///
    /// Rings are compared from their leftmost points, so that a duplicate may be missed if it visits that point twice.
    fn find(&mut self, edges: &Edges, chains: &MonotoneChains) -> &[DuplicateRing] {
        self.found.clear();
        self.keys.clear();
        if edges.rings().len() > 1 {
            let keys = (0..index(edges.rings().len())).map(|ring| (key(edges, chains, ring), ring));
            self.keys.extend(keys);
            self.keys.sort_unstable();
        }
        for group in self.keys.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
            let mut kinds: Vec<u32> = Vec::new();
            for &(_, ring) in group {
                let mut same = kinds.iter().filter_map(|&of| {
                    direction(edges, [of, ring].map(|ring| chains.leftmost(ring)))
                        .map(|along| DuplicateRing { ring, of, along })
                });
                match same.next() {
                    Some(duplicate) => self.found.push(duplicate),
                    None => kinds.push(ring),
                }
            }
        }
        &self.found
    }
}

impl Edges {
    /// Lets rings represent their duplicates, and drops these. Where they cancel, a ring that changes nothing is left, as its
    /// vertices count.
    fn unite(&mut self, duplicates: &[DuplicateRing]) {
        if duplicates.is_empty() {
            return;
        }
        let mut dropped = vec![false; self.rings.len()];
        for duplicate in duplicates {
            dropped[duplicate.ring as usize] = true;
            let EdgeRing { counter, winds, .. } = self.rings[duplicate.ring as usize];
            let winds = if duplicate.along { winds } else { -winds };
            let of = &mut self.rings[duplicate.of as usize];
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

/// Equal for rings with the same points, whatever their direction and start.
fn key(edges: &Edges, chains: &MonotoneChains, ring: u32) -> u64 {
    let (about, vertex) = (edges.rings()[ring as usize], chains.leftmost(ring));
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
