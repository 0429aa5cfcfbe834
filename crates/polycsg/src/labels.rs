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

/// A component, by its root vertex, whose outer sector is the face left of some half-edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Hung {
    half_edge: u32,
    vertex: u32,
}

/// What is known of a sub-edge, in bits: the truth on its left and on its right, whether these are known, and whether
/// any component hangs on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Label(u8);

impl Label {
    const LEFT: u8 = 1;
    const RIGHT: u8 = 2;
    const KNOWN: u8 = 4;
    const HUNG: u8 = 8;

    fn is(self, bit: u8) -> bool {
        self.0 & bit != 0
    }
}

/// The membership of every sub-edge that stands for itself.
#[derive(Debug, Default)]
pub(crate) struct Labels {
    labels: Vec<Label>,
    seen: Vec<bool>,
    turns: Vec<Turn>,
    /// The lexicographically smallest vertex of each component, by ring.
    leftmost: Vec<u32>,
    /// Sorted by half-edge.
    hung: Vec<Hung>,
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
        self.labels.clear();
        self.labels.resize(arrangement.len(), Label::default());
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
        let label = self.labels[sub as usize];
        Membership::from_sides(label.is(Label::LEFT), label.is(Label::RIGHT))
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
        let roots: Vec<u32> =
            self.leftmost.iter().filter(|&&v| v != END).map(|&v| contacts.vertex(v)).collect();
        if roots.len() < 2 {
            return roots;
        }
        let mut outermost = Vec::new();
        for vertex in roots {
            match nearest_below(edges, strips, contacts, arrangement, edges.point(vertex)) {
                None => outermost.push(vertex),
                Some(half_edge) => {
                    self.labels[half_edge as usize >> 1].0 |= Label::HUNG;
                    self.hung.push(Hung { half_edge, vertex });
                }
            }
        }
        self.hung.sort_unstable();
        outermost
    }

    /// Starts to go around a vertex, from the right of `half_edge` or, at a component's root, from its outer sector.
    ///
    /// Every vertex is entered once, so that the search for the half-edge takes linear time in all.
    fn enter(&mut self, arrangement: &Arrangement, vertex: u32, half_edge: Option<u32>) {
        self.seen[vertex as usize] = true;
        let span = arrangement.span(vertex);
        let from = half_edge.and_then(|h| span.clone().find(|&place| arrangement.around(place) == h));
        self.turns.push(Turn { vertex, place: from.unwrap_or(span.start), left: span.end - span.start });
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
            if self.labels[half_edge as usize >> 1].is(Label::HUNG) {
                self.enter_hung(arrangement, half_edge);
            }
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
            let along = arrangement.tail(other) == arrangement.origin(half_edge);
            edges.cross(arrangement.edge(other), along, truth);
        }
        let left = truth.holds();
        let (l, r) = if half_edge & 1 == 0 { (left, right) } else { (right, left) };
        let known = Label::KNOWN | (u8::from(l) * Label::LEFT) | (u8::from(r) * Label::RIGHT);
        let label = &mut self.labels[sub as usize];
        debug_assert!(!label.is(Label::KNOWN) || label.0 | Label::HUNG == known | Label::HUNG);
        label.0 |= known;
    }

    fn enter_hung(&mut self, arrangement: &Arrangement, half_edge: u32) {
        let mut next = self.hung.partition_point(|hung| hung.half_edge < half_edge);
        while let Some(hung) = self.hung.get(next).filter(|hung| hung.half_edge == half_edge) {
            let vertex = hung.vertex;
            self.enter(arrangement, vertex, None);
            next += 1;
        }
    }
}
