//! Stage 1: all operands' rings as one array of directed edges.

pub(crate) mod coincident;
pub(crate) mod collect;
mod localise;

use crate::base::id::index;
use crate::expression::winding::WindingNumbers;
use crate::predicates::Segment;
use glam::DVec2;
use std::ops::Range;

/// All edges and their vertices, under one numbering: edge `e` runs from the point in slot `e` to that in slot `e + 1`.
///
/// The rings lie one after the other, each with its first point once more behind the last. That last slot is neither an edge
/// nor a vertex of its own. Where edges coincide, one stands for all, and rings may be open: then the last slot is a vertex.
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

/// A ring, closed or open. Its edges are `start..end`; slot `end` of a closed one holds its first point again.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeRing {
    pub(crate) start: u32,
    pub(crate) end: u32,
    /// Whether it ends in a vertex of its own, the slot `end`. Its two ends are nodes.
    pub(crate) is_open: bool,
    /// The counter that its edges change, none for an edge that bounds nothing, and by how much.
    counter: Option<u32>,
    winds: i32,
    /// The other counters that its edges change, as the place of the first in `also`.
    also: u32,
    /// Where its first edge comes from.
    pub(crate) origin: Origin,
}

/// One more counter that the edges of a ring change.
#[derive(Clone, Copy, Debug)]
struct Also {
    change: Change,
    next: u32,
}

/// By how much a counter changes from the right of an edge to its left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Change {
    pub(crate) counter: u32,
    pub(crate) winds: i32,
}

/// Nothing more in a list.
const END: u32 = u32::MAX;

impl EdgeRing {
    /// The vertex behind another one; behind the last edge of an open ring its end.
    #[inline]
    pub(crate) fn next(self, vertex: u32) -> u32 {
        if vertex + 1 == self.end && !self.is_open { self.start } else { vertex + 1 }
    }

    /// The vertex before another one, which is not the start of an open ring.
    #[inline]
    pub(crate) fn previous(self, vertex: u32) -> u32 {
        if vertex == self.start { self.end - 1 } else { vertex - 1 }
    }

    /// The edge that ends where one starts.
    #[inline]
    pub(crate) fn edge_before(self, edge: u32) -> Option<u32> {
        let is_first = self.is_open && edge == self.start;
        (!is_first).then(|| self.previous(edge))
    }

    /// The edge that starts where one ends.
    #[inline]
    pub(crate) fn edge_after(self, edge: u32) -> Option<u32> {
        let is_last = self.is_open && edge + 1 == self.end;
        (!is_last).then(|| self.next(edge))
    }

    /// The ends of an open ring.
    pub(crate) fn ends(self) -> impl Iterator<Item = u32> {
        self.is_open.then_some([self.start, self.end]).into_iter().flatten()
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

    /// Gives the rings, each of one operand's, the counters that these have now.
    pub(crate) fn count_by(&mut self, winding: &WindingNumbers) {
        self.rings.iter_mut().for_each(|ring| ring.counter = winding.counter(ring.origin.operand as usize));
    }

    pub(crate) fn clear(&mut self) {
        self.points.clear();
        self.ring.clear();
        self.rings.clear();
        self.origins.clear();
        self.also.clear();
    }

    /// Adds edges of others, all of one ring, to a new ring.
    pub(crate) fn add_edges(&mut self, others: &Edges, edges: Range<u32>) {
        let span = edges.start as usize..edges.end as usize;
        self.points.extend_from_slice(&others.points[span.clone()]);
        match others.origins.get(span) {
            Some(origins) => self.origins.extend_from_slice(origins),
            None => self.origins.extend(edges.map(|edge| others.origin(edge))),
        }
    }

    /// Adds an edge by its start to a new ring.
    pub(crate) fn add_edge(&mut self, start: DVec2, origin: Origin) {
        self.points.push(start);
        self.origins.push(origin);
    }

    /// Ends the ring whose edges were added, in its start or, if it is open, in another point.
    pub(crate) fn end_ring(&mut self, end: Option<DVec2>, changes: &[Change]) {
        let start = index(self.ring.len());
        let origin = self.origins[start as usize];
        self.points.push(end.unwrap_or(self.points[start as usize]));
        self.origins.push(origin);
        self.ring.resize(self.points.len(), index(self.rings.len()));
        let (counter, winds) = changes.first().map_or((None, 0), |first| (Some(first.counter), first.winds));
        let mut also = END;
        for &change in changes.iter().skip(1).rev() {
            self.also.push(Also { change, next: also });
            also = index(self.also.len()) - 1;
        }
        let slots = [start, index(self.points.len()) - 1];
        self.rings.push(EdgeRing {
            start: slots[0],
            end: slots[1],
            is_open: end.is_some(),
            counter,
            winds,
            also,
            origin,
        });
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

    /// The vertex that an edge runs to, if no edge starts there: the end of an open ring.
    #[inline]
    pub(crate) fn open_end(&self, edge: u32) -> Option<u32> {
        let ring = self.ring(edge);
        (ring.is_open && edge + 1 == ring.end).then_some(ring.end)
    }

    #[inline]
    pub(crate) fn segment(&self, edge: u32) -> Segment {
        [self.points[edge as usize], self.points[edge as usize + 1]]
    }

    /// The two edges of a ring that end or start in the point of a slot; at the ends of an open ring twice the same.
    pub(crate) fn at(&self, slot: u32) -> [u32; 2] {
        let ring = self.ring(slot);
        match (ring.is_open, slot) {
            (true, end) if end == ring.end => [end - 1; 2],
            (true, start) if start == ring.start => [start; 2],
            (false, end) if end == ring.end => [end - 1, ring.start],
            (_, vertex) => [ring.previous(vertex), vertex],
        }
    }

    /// Whether a slot is a vertex, not the repeated point of a closed ring.
    pub(crate) fn is_vertex(&self, slot: u32) -> bool {
        let ring = self.ring(slot);
        ring.is_open || slot != ring.end
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

    /// The counters that the edges of a ring change, and by how much.
    pub(crate) fn changes(&self, ring: EdgeRing) -> impl Iterator<Item = Change> + '_ {
        let first = ring.counter.map(|counter| Change { counter, winds: ring.winds });
        let get = |place: u32| self.also.get(place as usize);
        let others = std::iter::successors(get(ring.also), move |also| get(also.next));
        first.into_iter().chain(others.map(|also| also.change))
    }

    /// Moves the walk over an edge of a ring, from its right to its left, or `back`.
    #[inline]
    pub(crate) fn cross(&self, edge: u32, back: bool, winding: &mut WindingNumbers) {
        let ring = self.ring(edge);
        if let Some(counter) = ring.counter {
            winding.cross(counter, if back { -ring.winds } else { ring.winds });
        }
        if ring.also != END {
            self.cross_also(ring, back, winding);
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
    fn cross_also(&self, ring: EdgeRing, back: bool, winding: &mut WindingNumbers) {
        let mut place = ring.also;
        while let Some(&Also { change: Change { counter, winds }, next }) = self.also.get(place as usize) {
            winding.cross(counter, if back { -winds } else { winds });
            place = next;
        }
    }
}
