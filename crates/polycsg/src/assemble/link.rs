//! Stage 8: closed walks along the boundary, split into simple rings.
//!
//! ```text
//!        a     b             Coming in from u with the interior on its left, the walk turns clockwise from the
//!         \   /              way back to u, through that interior, and takes the first chain that leaves v: here a
//!     u ───>v                if it leaves, else b. So each cycle runs around one connected interior, and two parts
//!                            that touch in v become two cycles.
//! ```
//!
//! A cycle that visits a node twice (a hole that touches its outer ring, two holes that touch) is cut there.

use crate::base::id::index;
use crate::boundary::outline::Outline;
use crate::predicates::{Side, lexicographic, side};
use crate::region::rings::Rings;
use glam::DVec2;
use std::{cmp::Ordering, ops::Range};

/// No chain, no place, no ring.
const NONE: u32 = u32::MAX;

/// A simple ring, and the cycle that it was cut from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SimpleRing {
    pub(crate) cycle: u32,
    pub(crate) counter_clockwise: bool,
    /// The slot of its lexicographically smallest point.
    pub(crate) leftmost: u32,
    /// The chain that starts in that point, if one does.
    pub(crate) chain: u32,
}

/// A half-edge at a node where several leave: the end of a chain, and whether the chain leaves there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct IncidentHalfEdge {
    pub(crate) node: u32,
    pub(crate) chain: u32,
    pub(crate) leaves: bool,
}

/// All rings of an outline.
#[derive(Debug, Default)]
pub(crate) struct Cycles {
    rings: Rings,
    about: Vec<SimpleRing>,
    /// The ring that each chain belongs to.
    ring_of_chain: Vec<u32>,
    /// Whether around each node chains arrive and leave in turn, as those of a boundary do.
    pub(crate) alternate: bool,
    /// The chains at nodes where several leave, by node and angle.
    half_edges: Vec<IncidentHalfEdge>,
    /// Per node a chain that leaves it.
    leaving: Vec<u32>,
    next: Vec<u32>,
    walked: Vec<bool>,
    cut: Cut,
}

/// The walk so far: chains without a repeated node.
#[derive(Debug, Default)]
struct Cut {
    /// Per node its place in the path, or none.
    depth: Vec<u32>,
    path: Vec<u32>,
}

impl Cut {
    /// Appends a chain; where it comes back to a node of the path, what lies from that place on is a ring.
    fn visit(&mut self, outline: &Outline, chain: u32) -> Option<usize> {
        let about = outline.chains()[chain as usize];
        self.depth[about.start as usize] = index(self.path.len());
        self.path.push(chain);
        let depth = self.depth[about.end as usize];
        (depth != NONE).then_some(depth as usize)
    }
}

impl Cycles {
    /// The points of all rings.
    pub(crate) fn rings(&self) -> &Rings {
        &self.rings
    }

    pub(crate) fn about(&self) -> &[SimpleRing] {
        &self.about
    }

    pub(crate) fn ring_of_chain(&self, chain: u32) -> u32 {
        self.ring_of_chain[chain as usize]
    }

    /// The chains at the start of a chain, by angle; none where only one leaves.
    pub(crate) fn half_edges_at_start(&self, outline: &Outline, chain: u32) -> &[IncidentHalfEdge] {
        let node = outline.chains()[chain as usize].start;
        let start = self.half_edges.partition_point(|half_edge| half_edge.node < node);
        let count = self.half_edges[start..].partition_point(|half_edge| half_edge.node == node);
        &self.half_edges[start..start + count]
    }

    /// Walks all chains and cuts the walks into rings.
    pub(crate) fn link(&mut self, outline: &Outline) -> &Cycles {
        self.reset(outline);
        self.find_successors(outline);
        let mut cycle = 0;
        for first in 0..index(outline.chains().len()) {
            if self.walked[first as usize] {
                continue;
            }
            let mut chain = first;
            while !self.walked[chain as usize] {
                self.walked[chain as usize] = true;
                if let Some(depth) = self.cut.visit(outline, chain) {
                    self.close_ring(outline, depth, cycle);
                }
                chain = self.next[chain as usize];
            }
            cycle += 1;
        }
        self
    }

    fn reset(&mut self, outline: &Outline) {
        let (chains, nodes) = (outline.chains().len(), outline.node_count());
        self.rings.clear();
        self.about.clear();
        self.ring_of_chain.clear();
        self.ring_of_chain.resize(chains, NONE);
        self.next.clear();
        self.next.resize(chains, NONE);
        self.walked.clear();
        self.walked.resize(chains, false);
        self.leaving.clear();
        self.leaving.resize(nodes, NONE);
        self.cut.path.clear();
        self.cut.depth.clear();
        self.cut.depth.resize(nodes, NONE);
    }

    /// Finds the chain that comes after each one by the turn rule.
    fn find_successors(&mut self, outline: &Outline) {
        self.half_edges.clear();
        for (chain, about) in (0..).zip(outline.chains()) {
            let leaving = &mut self.leaving[about.start as usize];
            if *leaving != NONE {
                self.half_edges.push(IncidentHalfEdge { node: about.start, chain, leaves: true });
            }
            *leaving = chain;
        }
        self.alternate = true;
        if !self.half_edges.is_empty() {
            self.gather_half_edges(outline);
        }
        for (next, about) in self.next.iter_mut().zip(outline.chains()).filter(|(next, _)| **next == NONE) {
            *next = self.leaving[about.end as usize];
        }
    }

    /// Pairs the chains where several leave a node.
    fn gather_half_edges(&mut self, outline: &Outline) {
        let mut crowded: Vec<u32> = self.half_edges.iter().map(|half_edge| half_edge.node).collect();
        crowded.sort_unstable();
        crowded.dedup();
        self.half_edges.clear();
        for (chain, about) in (0..).zip(outline.chains()) {
            for (node, leaves) in [(about.start, true), (about.end, false)] {
                if crowded.binary_search(&node).is_ok() {
                    self.half_edges.push(IncidentHalfEdge { node, chain, leaves });
                }
            }
        }
        self.half_edges.sort_unstable_by_key(|half_edge| half_edge.node);
        let mut half_edges = std::mem::take(&mut self.half_edges);
        for around in half_edges.chunk_by_mut(|a, b| a.node == b.node) {
            self.alternate &= self.pair_by_angle(outline, around);
        }
        self.half_edges = half_edges;
    }

    /// Follows each arriving chain by the first leaving one clockwise; false where two in a row arrive or leave.
    fn pair_by_angle(&mut self, outline: &Outline, around: &mut [IncidentHalfEdge]) -> bool {
        let pivot = self.node_point(outline, around[0].node);
        around.sort_unstable_by(|&a, &b| {
            by_angle(pivot, self.half_edge_end(outline, a), self.half_edge_end(outline, b))
                .then((a.chain, a.leaves).cmp(&(b.chain, b.leaves)))
        });
        let alternate = (0..around.len()).all(|i| {
            let (half_edge, before) = (around[i], around[if i == 0 { around.len() - 1 } else { i - 1 }]);
            if !half_edge.leaves {
                self.next[half_edge.chain as usize] = before.chain;
            }
            half_edge.leaves != before.leaves
        });
        if !alternate {
            let (leaving, arriving): (Vec<IncidentHalfEdge>, Vec<IncidentHalfEdge>) =
                around.iter().partition(|half_edge| half_edge.leaves);
            arriving.iter().zip(leaving).for_each(|(a, l)| self.next[a.chain as usize] = l.chain);
        }
        alternate
    }

    fn node_point(&self, outline: &Outline, node: u32) -> DVec2 {
        outline.points(self.leaving[node as usize])[0]
    }

    /// The point next to the node on a chain.
    pub(crate) fn half_edge_end(&self, outline: &Outline, half_edge: IncidentHalfEdge) -> DVec2 {
        let points = outline.points(half_edge.chain);
        match (half_edge.leaves, points.len()) {
            (true, 1) => self.node_point(outline, outline.chains()[half_edge.chain as usize].end),
            (true, _) => points[1],
            (false, count) => points[count - 1],
        }
    }

    /// Moves the path's chains from `depth` on to a ring of their own.
    fn close_ring(&mut self, outline: &Outline, depth: usize, cycle: u32) {
        let start = self.rings.points().len();
        let mut chains = 0..0;
        let mut smallest = (DVec2::MAX, NONE, NONE);
        for chain in self.cut.path.drain(depth..) {
            self.cut.depth[outline.chains()[chain as usize].start as usize] = NONE;
            self.ring_of_chain[chain as usize] = index(self.about.len());
            let points = outline.points(chain);
            chains = chains.end..chains.end + points.len();
            for (i, &point) in points.iter().enumerate() {
                if lexicographic(point, smallest.0) == Ordering::Less || smallest.1 == NONE {
                    smallest = (point, index(start + chains.start + i), if i == 0 { chain } else { NONE });
                }
            }
            self.rings.extend(points);
        }
        self.rings.close();
        let ring = self.rings.slots(self.about.len());
        // The turn at the lexicographically smallest point is that of the whole ring.
        let [before, after] = neighbours(&ring, smallest.1 as usize).map(|slot| self.rings.points()[slot]);
        let counter_clockwise = side(before, smallest.0, after) == Side::Left;
        self.about.push(SimpleRing { cycle, counter_clockwise, leftmost: smallest.1, chain: smallest.2 });
    }
}

/// The slots of the points before and behind one of a closed ring's.
pub(crate) fn neighbours(ring: &Range<usize>, slot: usize) -> [usize; 2] {
    [if slot == ring.start { ring.end - 2 } else { slot - 1 }, slot + 1]
}

/// The order of two directions by angle in (-90°, 270°].
pub(crate) fn by_angle(pivot: DVec2, a: DVec2, b: DVec2) -> Ordering {
    let leftward = |p: DVec2| lexicographic(pivot, p) == Ordering::Greater;
    leftward(a).cmp(&leftward(b)).then_with(|| match side(pivot, a, b) {
        Side::Left => Ordering::Less,
        Side::On => Ordering::Equal,
        Side::Right => Ordering::Greater,
    })
}
