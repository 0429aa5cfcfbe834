//! Stage 5: which sides of each sub-edge lie inside the set.
//!
//! One walk over the arrangement with one state, the winding numbers of all operands (see [`Truth`]): going around a
//! vertex counter-clockwise, the walk crosses each half-edge from its right to its left; at the other end of a
//! half-edge it goes around that vertex, and comes back with the state that it left with, since the edges
//! around a vertex balance. A component that lies inside a face of another one hangs on a half-edge of that face.

use crate::arrangement::Arrangement;
use crate::below::nearest_below;
use crate::contacts::Contacts;
use crate::edges::Edges;
use crate::membership::Membership;
use crate::predicates::lexicographic;
use crate::strips::Strips;
use crate::truth::{Truth, index};
use std::cmp::Ordering;

/// Nothing more in a list.
const END: u32 = u32::MAX;

/// A vertex being gone around: the next half-edge's place and how many are left.
#[derive(Clone, Copy, Debug)]
struct Turn {
    vertex: u32,
    place: u32,
    left: u32,
}

/// A component whose outer sector is the face left of some half-edge; the next one there.
#[derive(Clone, Copy, Debug)]
struct Hung {
    vertex: u32,
    next: u32,
}

/// The membership of every sub-edge that stands for itself.
#[derive(Debug, Default)]
pub(crate) struct Labels {
    members: Vec<Option<Membership>>,
    seen: Vec<bool>,
    turns: Vec<Turn>,
    /// The lexicographically smallest vertex of each component, by ring.
    leftmost: Vec<u32>,
    hung: Vec<Hung>,
    /// Per half-edge the first component that hangs on it; empty when there is one component only.
    hanging: Vec<u32>,
}

impl Labels {
    /// Labels every sub-edge with the side of it on which `truth` holds.
    pub(crate) fn classify(
        &mut self,
        edges: &Edges,
        strips: &Strips,
        contacts: &Contacts,
        arrangement: &Arrangement,
        truth: &mut Truth,
    ) {
        self.members.clear();
        self.members.resize(arrangement.len(), None);
        self.seen.clear();
        self.seen.resize(contacts.vertex_count(), false);
        self.find_leftmost(edges, contacts);
        let outermost = self.hang(edges, strips, contacts, arrangement);
        for vertex in outermost {
            self.enter(arrangement, vertex, None);
            self.walk(edges, arrangement, truth);
            debug_assert!(truth.is_outside());
        }
    }

    /// The membership of a sub-edge that stands for itself, in that sub-edge's direction.
    pub(crate) fn of(&self, sub: u32) -> Membership {
        self.members[sub as usize].unwrap_or(Membership::Out)
    }

    fn find_leftmost(&mut self, edges: &Edges, contacts: &Contacts) {
        self.leftmost.clear();
        self.leftmost.resize(edges.rings().len(), END);
        for vertex in 0..index(edges.len()) {
            let best = &mut self.leftmost[contacts.component(edges.ring_of(vertex)) as usize];
            if *best == END || lexicographic(edges.point(vertex), edges.point(*best)) == Ordering::Less {
                *best = vertex;
            }
        }
    }

    /// Hangs each component on the half-edge below it; returns the vertices of those that have none below.
    fn hang(
        &mut self,
        edges: &Edges,
        strips: &Strips,
        contacts: &Contacts,
        arrangement: &Arrangement,
    ) -> Vec<u32> {
        self.hung.clear();
        self.hanging.clear();
        let roots: Vec<u32> =
            self.leftmost.iter().filter(|&&v| v != END).map(|&v| contacts.vertex(v)).collect();
        if roots.len() < 2 {
            return roots;
        }
        self.hanging.resize(2 * arrangement.len(), END);
        let mut outermost = Vec::new();
        for vertex in roots {
            match nearest_below(edges, strips, contacts, arrangement, edges.point(vertex)) {
                None => outermost.push(vertex),
                Some(half_edge) => {
                    let first = &mut self.hanging[half_edge as usize];
                    self.hung.push(Hung { vertex, next: *first });
                    *first = index(self.hung.len() - 1);
                }
            }
        }
        outermost
    }

    /// Starts to go around a vertex, from the right of `half_edge` or, at a component's root, from its outer sector.
    fn enter(&mut self, arrangement: &Arrangement, vertex: u32, half_edge: Option<u32>) {
        self.seen[vertex as usize] = true;
        let span = arrangement.span(vertex);
        let place = half_edge.map_or(span.start, |h| arrangement.place(h));
        self.turns.push(Turn { vertex, place, left: span.end - span.start });
    }

    fn walk(&mut self, edges: &Edges, arrangement: &Arrangement, truth: &mut Truth) {
        while let Some(turn) = self.turns.last_mut() {
            if turn.left == 0 {
                self.turns.pop();
                continue;
            }
            let half_edge = arrangement.around(turn.place);
            let span = arrangement.span(turn.vertex);
            turn.left -= 1;
            turn.place = if turn.place + 1 == span.end { span.start } else { turn.place + 1 };
            self.cross(edges, arrangement, half_edge, truth);
            self.enter_hung(arrangement, half_edge);
            let twin = half_edge ^ 1;
            let other_end = arrangement.origin(twin);
            if !self.seen[other_end as usize] {
                self.enter(arrangement, other_end, Some(twin));
            }
        }
    }

    /// Moves the walk from the right of a half-edge to its left and labels its sub-edge.
    #[inline]
    fn cross(&mut self, edges: &Edges, arrangement: &Arrangement, half_edge: u32, truth: &mut Truth) {
        let sub = half_edge >> 1;
        let right = truth.holds();
        for other in arrangement.coincident(sub) {
            if let Some(counter) = edges.ring(arrangement.edge(other)).counter {
                let along = arrangement.tail(other) == arrangement.origin(half_edge);
                truth.cross(counter, if along { 1 } else { -1 });
            }
        }
        let left = truth.holds();
        let sides = if half_edge & 1 == 0 { [left, right] } else { [right, left] };
        let membership = Membership::from_sides(sides[0], sides[1]);
        let label = &mut self.members[sub as usize];
        debug_assert!(label.is_none_or(|known| known == membership));
        *label = Some(membership);
    }

    fn enter_hung(&mut self, arrangement: &Arrangement, half_edge: u32) {
        let mut next = self.hanging.get(half_edge as usize).copied().unwrap_or(END);
        while next != END {
            let hung = self.hung[next as usize];
            self.enter(arrangement, hung.vertex, None);
            next = hung.next;
        }
    }
}
