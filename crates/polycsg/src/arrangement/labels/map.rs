//! The arrangement as the walk sees it.

use crate::arrangement::{Arrangement, Node};
use crate::base::id::index;
use crate::contacts::{Contacts, Place};
use crate::edges::Edges;
use crate::expression::winding::WindingNumbers;
use crate::predicates::crossing_x_order;
use crate::spatial::{chains::MonotoneChains, strips::Strips};
use std::cmp::Ordering;

/// All that is known when the walk starts.
#[derive(Clone, Copy)]
pub(crate) struct Map<'a> {
    pub(crate) edges: &'a Edges,
    pub(crate) chains: &'a MonotoneChains,
    pub(crate) strips: &'a Strips,
    pub(crate) contacts: &'a Contacts,
    pub(crate) arrangement: &'a Arrangement,
}

impl Map<'_> {
    /// The sub-edge of a whole ring that nothing meets.
    pub(super) fn of_whole_ring(self, ring: u32) -> u32 {
        index(self.arrangement.len()) + ring
    }

    /// An edge of the ring of a sub-edge.
    #[inline]
    pub(super) fn an_edge(self, sub_edge: u32) -> u32 {
        match (sub_edge as usize).checked_sub(self.arrangement.len()) {
            None => self.arrangement.edge(sub_edge),
            Some(ring) => self.edges.rings()[ring].start,
        }
    }

    /// The sub-edge that contains a vertex or starts there.
    pub(super) fn sub_edge_at(self, vertex: u32) -> u32 {
        let sub_edge = self.arrangement.sub_edge_at(self.edges, vertex);
        sub_edge.unwrap_or_else(|| self.of_whole_ring(self.edges.ring_of(vertex)))
    }

    /// The sub-edge of an edge that runs below a vertex there, and whether the vertex lies on its left.
    pub(super) fn sub_edge_of(self, edge: u32, vertex: u32) -> (u32, bool) {
        let x = self.edges.point(vertex).x;
        let [start, end] = self.edges.segment(edge);
        let rightward = start.x < end.x;
        let starts_behind = |sub_edge: u32| {
            self.arrangement.edge(sub_edge) > edge || {
                self.arrangement.edge(sub_edge) == edge && self.is_left_of(sub_edge, x) != rightward
            }
        };
        let sub_edges = self.arrangement.of_ring(self.edges.ring_of(edge));
        let Some(sub_edge) = self.arrangement.last_before(sub_edges, starts_behind) else {
            return (self.of_whole_ring(self.edges.ring_of(edge)), rightward);
        };
        let representative = self.arrangement.representative(sub_edge);
        let along = self.arrangement.is_along(self.edges, representative, sub_edge);
        (representative, rightward == along)
    }

    /// Whether a sub-edge starts at or left of an abscissa.
    fn is_left_of(self, sub_edge: u32, x: f64) -> bool {
        match self.contacts.place(self.arrangement.node(sub_edge)) {
            Place::Vertex(vertex) => self.edges.point(vertex).x <= x,
            Place::Crossing(e, f) => {
                crossing_x_order(self.edges.segment(e), self.edges.segment(f), x) != Ordering::Greater
            }
        }
    }

    /// The places of the half-edges that leave a junction together with the one at a place.
    pub(super) fn group(self, junction: u32, place: u32) -> std::ops::Range<u32> {
        if !self.arrangement.overlaps() {
            return place..place + 1;
        }
        let span = self.arrangement.span(junction);
        let sub_edge = |place: u32| self.arrangement.around(place) >> 1;
        let representative = |place: u32| self.arrangement.representative(sub_edge(place));
        // A sub-edge that leaves and comes back has two half-edges here, alone each.
        let same = |&p: &u32| {
            p == place || (representative(p) == representative(place) && sub_edge(p) != sub_edge(place))
        };
        let start = (span.start..place).rev().take_while(same).last().unwrap_or(place);
        let end = (place..span.end).take_while(same).last().unwrap_or(place) + 1;
        start..end
    }
}

/// Moves over a sub-edge and all that overlap it, from its right to its left, or `back`.
#[inline]
pub(super) fn cross_overlapping(sub_edge: u32, back: bool, map: Map<'_>, winding: &mut WindingNumbers) {
    for other in map.arrangement.overlapping(sub_edge) {
        let along = map.arrangement.is_along(map.edges, sub_edge, other);
        map.edges.cross(map.an_edge(other), back == along, winding);
    }
}

/// Whether the expression holds to the right of a sub-edge and all that overlap it; the walk is on its left.
#[inline]
pub(super) fn holds_behind(sub_edge: u32, map: Map<'_>, winding: &mut WindingNumbers) -> bool {
    if map.arrangement.overlapping(sub_edge).nth(1).is_none() {
        return map.edges.holds_behind(map.an_edge(sub_edge), winding);
    }
    cross_overlapping(sub_edge, true, map, winding);
    let holds = winding.holds();
    cross_overlapping(sub_edge, false, map, winding);
    holds
}

/// Moves over all crossings from `sub_edge` back to `first`; returns how many sub-edges it went along.
pub(super) fn go_back(mut sub_edge: u32, first: u32, map: Map<'_>, winding: &mut WindingNumbers) -> usize {
    let mut passed = 0;
    while sub_edge != first {
        if let Node::Crossing(other) = map.arrangement.met(sub_edge) {
            map.edges.cross(
                map.arrangement.edge(other),
                map.arrangement.crossed_from_left(sub_edge),
                winding,
            );
        }
        sub_edge = map.arrangement.previous(map.edges, sub_edge);
        passed += 1;
    }
    passed
}

/// Moves over all crossings from `sub_edge` forward to `first`; returns how many sub-edges it went along.
pub(super) fn go_forward(mut sub_edge: u32, first: u32, map: Map<'_>, winding: &mut WindingNumbers) -> usize {
    let mut passed = 0;
    while sub_edge != first {
        sub_edge = map.arrangement.following(map.edges, sub_edge);
        if let Node::Crossing(other) = map.arrangement.met(sub_edge) {
            map.edges.cross(
                map.arrangement.edge(other),
                !map.arrangement.crossed_from_left(sub_edge),
                winding,
            );
        }
        passed += 1;
    }
    passed
}
