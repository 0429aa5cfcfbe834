//! Rings with the same points: one stands for all, so that a million copies of a ring cost little more than one.

use crate::chains::Chains;
use crate::edges::{Edges, Ring};
use crate::truth::index;
use glam::DVec2;

/// A ring that has the points of another one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Copy {
    pub(crate) ring: u32,
    pub(crate) of: u32,
    /// Whether both run in one direction.
    pub(crate) along: bool,
}

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct Copies {
    keys: Vec<(u64, u32)>,
    found: Vec<Copy>,
}

impl Copies {
    /// Finds the rings that are copies of another ring, the first of its kind.
    ///
    /// Rings are compared from their leftmost points, so that a copy may be missed if it visits that point twice.
    pub(crate) fn find(&mut self, edges: &Edges, chains: &Chains) -> &[Copy] {
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
                    direction(edges, [chains.leftmost(of), chains.leftmost(ring)]).map(|along| Copy {
                        ring,
                        of,
                        along,
                    })
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

/// Equal for rings with the same points, whatever their direction and start.
fn key(edges: &Edges, chains: &Chains, ring: u32) -> u64 {
    let (about, vertex) = (edges.rings()[ring as usize], chains.leftmost(ring));
    let [before, after] = [about.previous(vertex), about.next(vertex)].map(|v| mixed(edges.point(v)));
    let both = before.wrapping_add(after).wrapping_add(u64::from(about.end - about.start));
    (mixed(edges.point(vertex)) ^ both).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

/// A number for a point, to tell it from others quickly.
#[inline]
pub(crate) fn mixed(p: DVec2) -> u64 {
    let product = p.x.to_bits().wrapping_mul(0xff51_afd7_ed55_8ccd) ^ p.y.to_bits().rotate_left(32);
    (product ^ product >> 29).wrapping_mul(0xc4ce_b9fe_1a85_ec53)
}

/// Whether two rings, each by a vertex of it, run through the same points from there, in one direction or against one
/// another.
fn direction(edges: &Edges, vertices: [u32; 2]) -> Option<bool> {
    let [a, b] = vertices.map(|vertex| edges.ring(vertex));
    let same = |step: fn(Ring, u32) -> u32| {
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
    if same(Ring::next) {
        Some(true)
    } else if same(Ring::previous) {
        Some(false)
    } else {
        None
    }
}
