//! The arrangement as the walk sees it.

use crate::arrangement::{Arrangement, Node};
use crate::base::id::index;
use crate::contacts::{Contacts, Place};
use crate::edges::Edges;
use crate::expression::winding::WindingNumbers;
use crate::predicates::crossing_x_order;
use crate::spatial::chains::MonotoneChains;
use crate::spatial::strips::Strips;
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
    /// The arc of a whole ring that nothing meets.
    pub(super) fn of_whole_ring(self, ring: u32) -> u32 {
        index(self.arrangement.len()) + ring
    }

    /// An edge of the ring of an arc.
    #[inline]
    pub(super) fn an_edge(self, arc: u32) -> u32 {
        match (arc as usize).checked_sub(self.arrangement.len()) {
            None => self.arrangement.edge(arc),
            Some(ring) => self.edges.rings()[ring].start,
        }
    }

    /// The arc that contains a vertex or starts there.
    pub(super) fn arc_at(self, vertex: u32) -> u32 {
        let arc = self.arrangement.arc_at(self.edges, vertex);
        arc.unwrap_or_else(|| self.of_whole_ring(self.edges.ring_of(vertex)))
    }

    /// The arc of an edge that runs below a vertex there, and whether the vertex lies on its left.
    pub(super) fn arc_of(self, edge: u32, vertex: u32) -> (u32, bool) {
        let x = self.edges.point(vertex).x;
        let [start, end] = self.edges.segment(edge);
        let rightward = start.x < end.x;
        let starts_behind = |arc: u32| {
            self.arrangement.edge(arc) > edge || {
                self.arrangement.edge(arc) == edge && self.is_left_of(arc, x) != rightward
            }
        };
        let arcs = self.arrangement.of_ring(self.edges.ring_of(edge));
        let Some(arc) = self.arrangement.last_before(arcs, starts_behind) else {
            return (self.of_whole_ring(self.edges.ring_of(edge)), rightward);
        };
        let stands = self.arrangement.stand_in(arc);
        let along = self.arrangement.is_along(self.edges, stands, arc);
        (stands, rightward == along)
    }

    /// Whether an arc starts at or left of an abscissa.
    fn is_left_of(self, arc: u32, x: f64) -> bool {
        match self.contacts.place(self.arrangement.node(arc)) {
            Place::Vertex(vertex) => self.edges.point(vertex).x <= x,
            Place::Crossing(e, f) => {
                crossing_x_order(self.edges.segment(e), self.edges.segment(f), x) != Ordering::Greater
            }
        }
    }

    /// The places of the half-edges that leave a junction together with the one at a place.
    pub(super) fn group(self, junction: u32, place: u32) -> std::ops::Range<u32> {
        let span = self.arrangement.span(junction);
        let arc = |place: u32| self.arrangement.around(place) >> 1;
        let stands = |place: u32| self.arrangement.stand_in(arc(place));
        // An arc that leaves and comes back has two half-edges here, alone each.
        let same = |&p: &u32| p == place || (stands(p) == stands(place) && arc(p) != arc(place));
        let start = (span.start..place).rev().take_while(same).last().unwrap_or(place);
        let end = (place..span.end).take_while(same).last().unwrap_or(place) + 1;
        start..end
    }
}

/// Moves over a bundle from its right to its left, or `back`.
#[inline]
pub(super) fn cross_bundle(arc: u32, back: bool, map: Map<'_>, truth: &mut WindingNumbers) {
    for other in map.arrangement.bundle(arc) {
        let along = map.arrangement.is_along(map.edges, arc, other);
        map.edges.cross(map.an_edge(other), back == along, truth);
    }
}

/// Whether the expression holds to the right of a bundle, from the left of which the walk looks.
#[inline]
pub(super) fn holds_behind(arc: u32, map: Map<'_>, truth: &mut WindingNumbers) -> bool {
    if map.arrangement.bundle(arc).nth(1).is_none() {
        return map.edges.holds_behind(map.an_edge(arc), truth);
    }
    cross_bundle(arc, true, map, truth);
    let holds = truth.holds();
    cross_bundle(arc, false, map, truth);
    holds
}

/// Moves over all crossings from `arc` back to `first`.
pub(super) fn go_back(mut arc: u32, first: u32, map: Map<'_>, truth: &mut WindingNumbers) {
    while arc != first {
        if let Node::Crossing(other) = map.arrangement.met(arc) {
            map.edges.cross(map.arrangement.edge(other), map.arrangement.crossed_from_left(arc), truth);
        }
        arc = map.arrangement.previous(map.edges, arc);
    }
}

/// Moves over all crossings from `arc` forward to `first`.
pub(super) fn go_forward(mut arc: u32, first: u32, map: Map<'_>, truth: &mut WindingNumbers) {
    while arc != first {
        arc = map.arrangement.following(map.edges, arc);
        if let Node::Crossing(other) = map.arrangement.met(arc) {
            map.edges.cross(map.arrangement.edge(other), !map.arrangement.crossed_from_left(arc), truth);
        }
    }
}
