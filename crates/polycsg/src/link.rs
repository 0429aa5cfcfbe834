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
use std::ops::Range;

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
}

impl Cycles {
    pub(crate) fn rings(&self) -> &[Ring] {
        &self.rings
    }

    /// The point ids of a ring.
    pub(crate) fn ids(&self, ring: Ring) -> &[u32] {
        &self.ids[ring.start as usize..ring.end as usize]
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

/// The outline's edges by the point that they leave: they are sorted by it.
struct Leaving {
    starts: Vec<u32>,
}

impl Leaving {
    fn of(outline: &Outline) -> Leaving {
        let mut starts = vec![0; outline.point_count() + 1];
        for edge in outline.edges() {
            starts[edge[0] as usize + 1] += 1;
        }
        for p in 1..starts.len() {
            starts[p] += starts[p - 1];
        }
        Leaving { starts }
    }

    fn at(&self, point: u32) -> Range<u32> {
        self.starts[point as usize]..self.starts[point as usize + 1]
    }
}

/// Walks all edges and cuts the walks into rings.
pub(crate) fn link(outline: &Outline) -> Cycles {
    let leaving = Leaving::of(outline);
    let mut cycles = Cycles { ring_of_edge: vec![u32::MAX; outline.edges().len()], ..Cycles::default() };
    let mut walked = vec![false; outline.edges().len()];
    let mut cut = Cut { depth: vec![u32::MAX; outline.point_count()], chain: Vec::new() };
    let mut cycle = 0;
    for first in 0..index(outline.edges().len()) {
        if walked[first as usize] {
            continue;
        }
        let mut edge = first;
        loop {
            walked[edge as usize] = true;
            cut.visit(outline, edge, cycle, &mut cycles);
            match next_edge(outline, &leaving, edge, |e| e == first || !walked[e as usize]) {
                Some(next) if next != first => edge = next,
                _ => break,
            }
        }
        cycle += 1;
    }
    cycles
}

/// The edge that follows by the turn rule, of those that are open.
fn next_edge(outline: &Outline, leaving: &Leaving, edge: u32, is_open: impl Fn(u32) -> bool) -> Option<u32> {
    let [from, at] = outline.edges()[edge as usize];
    let mut candidates = leaving.at(at).filter(|&e| is_open(e));
    let mut best = candidates.next()?;
    let (back, pivot) = (outline.point(from), outline.point(at));
    let end = |e: u32| outline.point(outline.edges()[e as usize][1]);
    for other in candidates {
        if is_clockwise_nearer(pivot, back, end(other), end(best)) {
            best = other;
        }
    }
    Some(best)
}

/// Whether, turning clockwise around `pivot` from the direction of `back`, `a` comes before `b`.
fn is_clockwise_nearer(pivot: DVec2, back: DVec2, a: DVec2, b: DVec2) -> bool {
    let (a_after, b_after) = (by_angle(pivot, a, back), by_angle(pivot, b, back));
    match (a_after == Ordering::Less, b_after == Ordering::Less) {
        (true, false) => true,
        (false, true) => false,
        // Both on one side of the start: the larger angle comes first.
        _ => by_angle(pivot, a, b) == Ordering::Greater,
    }
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
struct Cut {
    /// Per point its place in the chain, or none.
    depth: Vec<u32>,
    /// The chain's edges.
    chain: Vec<u32>,
}

impl Cut {
    /// Appends an edge; where it comes back to a point of the chain, what lies between is a ring.
    fn visit(&mut self, outline: &Outline, edge: u32, cycle: u32, cycles: &mut Cycles) {
        let [from, to] = outline.edges()[edge as usize];
        self.depth[from as usize] = index(self.chain.len());
        self.chain.push(edge);
        let depth = self.depth[to as usize];
        if depth == u32::MAX {
            return;
        }
        let ring: Vec<u32> = self.chain.drain(depth as usize..).collect();
        for &e in &ring {
            self.depth[outline.edges()[e as usize][0] as usize] = u32::MAX;
        }
        cycles.add(outline, &ring, cycle);
    }
}

impl Cycles {
    fn add(&mut self, outline: &Outline, edges: &[u32], cycle: u32) {
        let start = index(self.ids.len());
        for &e in edges {
            self.ring_of_edge[e as usize] = index(self.rings.len());
            self.ids.push(outline.edges()[e as usize][0]);
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
