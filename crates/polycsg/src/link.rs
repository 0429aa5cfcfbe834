//! Stage 8: closed walks along the boundary, split into simple rings.
//!
//! ```text
//!        a     b             Coming in from u with the interior on its left, the walk turns clockwise from the
//!         \   /              way back to u, through that interior, and takes the first edge that leaves v: here a
//!     u ───>v                if it leaves, else b. So each cycle runs around one connected interior, and two parts
//!                            that touch in v become two cycles.
//! ```
//!
//! A cycle that visits a point twice (a hole that touches its outer ring, two holes that touch) is cut there.

use crate::outline::Outline;
use crate::predicates::{Side, lexicographic, side};
use crate::rings::Rings;
use crate::truth::index;
use glam::DVec2;
use std::cmp::Ordering;

/// No edge, no place, no ring.
const NONE: u32 = u32::MAX;

/// A simple ring: a span of point ids, the smallest first, and the cycle that it was cut from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring {
    start: u32,
    end: u32,
    pub(crate) cycle: u32,
    pub(crate) counter_clockwise: bool,
}

/// All rings of an outline.
#[derive(Debug, Default)]
pub(crate) struct Cycles {
    ids: Vec<u32>,
    rings: Vec<Ring>,
    /// The ring that each of the outline's edges belongs to.
    ring_of_edge: Vec<u32>,
    /// Whether around each point edges arrive and leave in turn, as those of a boundary do.
    pub(crate) alternate: bool,
    next: Vec<u32>,
    walked: Vec<bool>,
    cut: Cut,
}

impl Cycles {
    pub(crate) fn rings(&self) -> &[Ring] {
        &self.rings
    }

    /// The point ids of a ring.
    pub(crate) fn ids(&self, ring: Ring) -> &[u32] {
        &self.ids[ring.start as usize..ring.end as usize]
    }

    /// The number of points of all rings.
    pub(crate) fn point_count(&self) -> usize {
        self.ids.len()
    }

    pub(crate) fn ring_of_edge(&self, edge: u32) -> u32 {
        self.ring_of_edge[edge as usize]
    }

    pub(crate) fn to_rings(&self, outline: &Outline) -> Rings {
        let mut rings = Rings::default();
        for &ring in &self.rings {
            self.ids(ring).iter().for_each(|&id| rings.push(outline.point(id)));
            rings.close();
        }
        rings
    }
}

impl Cycles {
    /// Walks all edges and cuts the walks into rings.
    pub(crate) fn link(&mut self, outline: &Outline) {
        self.reset(outline);
        self.alternate = find_successors(outline, &mut self.next);
        let mut cycle = 0;
        for first in 0..index(outline.edges().len()) {
            if self.walked[first as usize] {
                continue;
            }
            let mut edge = first;
            while !self.walked[edge as usize] {
                self.walked[edge as usize] = true;
                if let Some(start) = self.cut.visit(outline, edge) {
                    self.close_ring(outline, start, cycle);
                }
                edge = self.next[edge as usize];
            }
            cycle += 1;
        }
    }

    fn reset(&mut self, outline: &Outline) {
        self.ids.clear();
        self.rings.clear();
        self.ring_of_edge.clear();
        self.ring_of_edge.resize(outline.edges().len(), NONE);
        self.next.clear();
        self.next.resize(outline.edges().len(), NONE);
        self.walked.clear();
        self.walked.resize(outline.edges().len(), false);
        self.cut.chain.clear();
        self.cut.depth.clear();
        self.cut.depth.resize(outline.point_count(), NONE);
    }
}

/// Finds the edge that follows each edge by the turn rule; tells whether around each point edges arrive and leave in turn.
fn find_successors(outline: &Outline, next: &mut [u32]) -> bool {
    let mut alternate = true;
    for point in 0..index(outline.point_count()) {
        let (leaving, arriving) = (outline.leaving(point), outline.arriving(point));
        if leaving.len() < 2 || !pair_by_angle(outline, point, next) {
            alternate &= leaving.len() < 2;
            arriving.iter().zip(leaving).for_each(|(&a, l)| next[a as usize] = l);
        }
    }
    alternate
}

/// Follows each arriving edge by the first leaving one clockwise; false where two in a row arrive or leave.
fn pair_by_angle(outline: &Outline, point: u32, next: &mut [u32]) -> bool {
    let end =
        |(edge, leaves): (u32, bool)| outline.point(outline.edges()[edge as usize][usize::from(leaves)]);
    let leaving = outline.leaving(point).map(|edge| (edge, true));
    let mut around: Vec<(u32, bool)> =
        leaving.chain(outline.arriving(point).iter().map(|&edge| (edge, false))).collect();
    around.sort_unstable_by(|&a, &b| by_angle(outline.point(point), end(a), end(b)));
    let previous = around.iter().cycle().skip(around.len() - 1);
    around.iter().zip(previous).all(|(&(edge, leaves), &(before, before_leaves))| {
        if !leaves {
            next[edge as usize] = before;
        }
        leaves != before_leaves
    })
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

/// The walk so far, as a chain of edges without a repeated point.
#[derive(Debug, Default)]
struct Cut {
    /// Per point its place in the chain, or none.
    depth: Vec<u32>,
    /// The chain's edges.
    chain: Vec<u32>,
}

impl Cut {
    /// Appends an edge; where it comes back to a point of the chain, what lies from that place on is a ring.
    fn visit(&mut self, outline: &Outline, edge: u32) -> Option<usize> {
        let [from, to] = outline.edges()[edge as usize];
        self.depth[from as usize] = index(self.chain.len());
        self.chain.push(edge);
        let depth = self.depth[to as usize];
        (depth != NONE).then_some(depth as usize)
    }
}

impl Cycles {
    /// Moves the chain's edges from `depth` on to a ring of their own.
    fn close_ring(&mut self, outline: &Outline, depth: usize, cycle: u32) {
        let start = index(self.ids.len());
        for edge in self.cut.chain.drain(depth..) {
            let [from, _] = outline.edges()[edge as usize];
            self.cut.depth[from as usize] = NONE;
            self.ring_of_edge[edge as usize] = index(self.rings.len());
            self.ids.push(from);
        }
        let ids = &mut self.ids[start as usize..];
        let smallest = (0..ids.len()).min_by_key(|&i| ids[i]).unwrap_or(0);
        ids.rotate_left(smallest);
        // The turn at the lexicographically smallest point is that of the whole ring.
        let corner = [ids[ids.len() - 1], ids[0], ids[1 % ids.len()]].map(|id| outline.point(id));
        let counter_clockwise = side(corner[0], corner[1], corner[2]) == Side::Left;
        self.rings.push(Ring { start, end: index(self.ids.len()), cycle, counter_clockwise });
    }
}
