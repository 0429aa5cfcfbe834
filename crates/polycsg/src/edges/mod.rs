//! Stage 1: all operands' rings as one array of directed edges.

pub(crate) mod collect;
pub(crate) mod duplicate_rings;
mod localise;
pub(crate) mod opposite_edges;

use crate::base::id::index;
use crate::expression::winding::WindingNumbers;
use crate::predicates::Segment;
use glam::DVec2;
use std::ops::Range;

/// All edges and their vertices, under one numbering: edge `e` runs from the point in slot `e` to that in slot `e + 1`.
///
/// The rings lie one after the other, each with its first point once more behind the last. That last slot is neither an edge
/// nor a vertex of its own.
#[derive(Debug, Default)]
pub(crate) struct Edges {
    points: Vec<DVec2>,
    /// Per slot its ring.
    ring: Vec<u32>,
    rings: Vec<EdgeRing>,
    /// Per slot where the edge comes from; empty while all of each ring's points are there.
    origins: Vec<Origin>,
    also: Vec<Also>,
}

/// A ring. Its edges are `start..end`; slot `end` holds its first point again.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeRing {
    pub(crate) start: u32,
    pub(crate) end: u32,
    /// The counter that its edges change, none for an open edge, and by how much.
    counter: Option<u32>,
    winds: i32,
    /// The other counters that its edges change, as the place of the first in `also`.
    also: u32,
    /// Where its first edge comes from.
    pub(crate) origin: Origin,
}

/// A counter that the edges of a ring change for a duplicate of it.
#[derive(Clone, Copy, Debug)]
struct Also {
    counter: u32,
    winds: i32,
    next: u32,
}

/// Nothing more in a list.
const END: u32 = u32::MAX;

impl EdgeRing {
    /// Whether it bounds anything: an open edge does not.
    pub(crate) fn is_closed(self) -> bool {
        self.counter.is_some()
    }

    /// The counter that its edges change, none for an open edge.
    #[inline]
    pub(crate) fn counter(self) -> Option<u32> {
        self.counter
    }

    #[inline]
    pub(crate) fn next(self, edge: u32) -> u32 {
        if edge + 1 == self.end { self.start } else { edge + 1 }
    }

    #[inline]
    pub(crate) fn previous(self, edge: u32) -> u32 {
        if edge == self.start { self.end - 1 } else { edge - 1 }
    }
}

/// An operand and the number of an edge of it, in the order given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Origin {
    pub(crate) operand: u32,
    pub(crate) edge: u32,
}

impl Edges {
    /// The operand that all rings come from, if that is one.
    pub(crate) fn only_operand(&self) -> Option<u32> {
        let first = self.rings.first()?.origin.operand;
        self.rings.iter().all(|ring| ring.origin.operand == first).then_some(first)
    }

    pub(crate) fn clear(&mut self) {
        self.points.clear();
        self.ring.clear();
        self.rings.clear();
        self.origins.clear();
        self.also.clear();
    }

    /// Adds edges of others to a new ring.
    pub(crate) fn add_edges(&mut self, others: &Edges, edges: Range<u32>) {
        self.points.extend_from_slice(&others.points[edges.start as usize..edges.end as usize]);
        self.origins.extend(edges.map(|edge| others.origin(edge)));
    }

    /// Adds an edge by its start.
    pub(crate) fn add_edge(&mut self, start: DVec2, origin: Origin) {
        self.points.push(start);
        self.origins.push(origin);
    }

    /// Closes the ring whose edges were added, and lets them change a counter.
    pub(crate) fn close(&mut self, counter: Option<u32>) {
        let start = index(self.ring.len());
        let origin = self.origins[start as usize];
        self.points.push(self.points[start as usize]);
        self.origins.push(origin);
        self.ring.resize(self.points.len(), index(self.rings.len()));
        let end = index(self.points.len()) - 1;
        self.rings.push(EdgeRing { start, end, counter, winds: 1, also: END, origin });
    }

    /// The number of slots: more than any edge's id.
    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.points.len()
    }

    /// All slots' points.
    pub(crate) fn points(&self) -> &[DVec2] {
        &self.points
    }

    #[inline]
    pub(crate) fn point(&self, vertex: u32) -> DVec2 {
        self.points[vertex as usize]
    }

    /// The vertex that an edge runs to.
    #[inline]
    pub(crate) fn head(&self, edge: u32) -> u32 {
        self.ring(edge).next(edge)
    }

    #[inline]
    pub(crate) fn segment(&self, edge: u32) -> Segment {
        [self.points[edge as usize], self.points[edge as usize + 1]]
    }

    /// The two edges that end or start in the point of a slot.
    pub(crate) fn at(&self, slot: u32) -> [u32; 2] {
        let ring = self.ring(slot);
        let vertex = if slot == ring.end { ring.start } else { slot };
        [ring.previous(vertex), vertex]
    }

    #[inline]
    pub(crate) fn ring_of(&self, edge: u32) -> u32 {
        self.ring[edge as usize]
    }

    #[inline]
    pub(crate) fn ring(&self, edge: u32) -> EdgeRing {
        self.rings[self.ring[edge as usize] as usize]
    }

    /// The slots of each ring.
    pub(crate) fn spans(&self) -> impl Iterator<Item = Range<u32>> + '_ {
        self.rings.iter().map(|ring| ring.start..ring.end + 1)
    }

    pub(crate) fn rings(&self) -> &[EdgeRing] {
        &self.rings
    }

    pub(crate) fn origin(&self, edge: u32) -> Origin {
        self.origins.get(edge as usize).copied().unwrap_or_else(|| {
            let EdgeRing { start, origin, .. } = self.ring(edge);
            Origin { operand: origin.operand, edge: origin.edge + edge - start }
        })
    }

    /// Moves the walk over an edge of a ring, from its right to its left, or `back`.
    #[inline]
    pub(crate) fn cross(&self, edge: u32, back: bool, winding: &mut WindingNumbers) {
        let ring = self.ring(edge);
        if let Some(counter) = ring.counter {
            winding.cross(counter, if back { -ring.winds } else { ring.winds });
        }
        if ring.also != END {
            self.cross_also(ring.also, back, winding);
        }
    }

    /// Whether the expression holds to the right of an edge; the walk is on its left.
    #[inline]
    pub(crate) fn holds_behind(&self, edge: u32, winding: &mut WindingNumbers) -> bool {
        let ring = self.ring(edge);
        match ring.counter {
            Some(counter) if ring.also == END => winding.would_hold(counter, -ring.winds),
            _ => {
                self.cross(edge, true, winding);
                let holds = winding.holds();
                self.cross(edge, false, winding);
                holds
            }
        }
    }

    #[cold]
    fn cross_also(&self, mut place: u32, back: bool, winding: &mut WindingNumbers) {
        while place != END {
            let also = self.also[place as usize];
            winding.cross(also.counter, if back { -also.winds } else { also.winds });
            place = also.next;
        }
    }
}
