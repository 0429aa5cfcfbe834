//! Stage 4: the arrangement: sub-edges between neighbouring vertices, and around each vertex the half-edges by angle.
//!
//! ```text
//!            h1                  Half-edges leave their vertex: half-edge 2s runs along sub-edge s, 2s + 1 against it.
//!             |   h0             The sector between h[k] and h[k + 1], counter-clockwise, lies to the left of h[k]
//!             |  /               and to the right of h[k + 1].
//!     h2 -----v                  Sorted by angle from just above straight down, so that at the lexicographically
//!              \                 smallest vertex of a component the outer sector lies right of h[0].
//!               h3
//! ```
//!
//! Sub-edges that coincide are one: the one with the smallest id stands for all, and knows the others.

use crate::contacts::Contacts;
use crate::edges::Edges;
use crate::predicates::{Segment, Side, lexicographic, turn};
use crate::truth::index;
use std::cmp::Ordering;
use std::ops::Range;

/// No further sub-edge.
const END: u32 = u32::MAX;

/// See the module's page.
#[derive(Debug, Default)]
pub(crate) struct Arrangement {
    /// Tail and head of each sub-edge.
    ends: Vec<[u32; 2]>,
    edge: Vec<u32>,
    /// Per edge the first of its sub-edges; they follow one another along the edge.
    first: Vec<u32>,
    /// Per sub-edge the one that stands for it and the next that coincides; empty when nothing overlaps.
    stands: Vec<u32>,
    next: Vec<u32>,
    /// Per vertex the span of its half-edges in `around`.
    starts: Vec<u32>,
    around: Vec<u32>,
}

impl Arrangement {
    /// Splits all edges at their contacts and sorts what leaves each vertex.
    pub(crate) fn split(&mut self, edges: &Edges, contacts: &Contacts) {
        self.cut(edges, contacts);
        self.unite(contacts);
        self.gather(contacts.vertex_count());
        self.sort(edges);
        debug_assert!(self.check(edges));
    }

    fn cut(&mut self, edges: &Edges, contacts: &Contacts) {
        self.ends.clear();
        self.edge.clear();
        self.first.clear();
        for edge in 0..index(edges.len()) {
            self.first.push(index(self.ends.len()));
            if !edges.is_edge(edge) || edges.follows(edge) {
                continue;
            }
            let mut tail = contacts.vertex(edge);
            for vertex in contacts.inside(edge).chain([contacts.vertex(edges.head(edge))]) {
                if vertex != tail {
                    self.ends.push([tail, vertex]);
                    self.edge.push(edge);
                    tail = vertex;
                }
            }
        }
        self.first.push(index(self.ends.len()));
    }

    /// Finds the sub-edges with equal ends: only those of overlapping edges can be.
    fn unite(&mut self, contacts: &Contacts) {
        self.stands.clear();
        self.next.clear();
        if contacts.overlapping().is_empty() {
            return;
        }
        self.stands.extend(0..index(self.len()));
        self.next.resize(self.len(), END);
        let mut edges = contacts.overlapping().to_vec();
        edges.sort_unstable();
        edges.dedup();
        let mut ends: Vec<(u32, u32, u32)> = Vec::new();
        for sub in edges.iter().flat_map(|&e| self.of_edge(e)) {
            let (a, b) = (self.tail(sub), self.head(sub));
            ends.push((a.min(b), a.max(b), sub));
        }
        ends.sort_unstable();
        for pair in ends.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            if (a.0, a.1) == (b.0, b.1) {
                self.next[a.2 as usize] = b.2;
                self.stands[b.2 as usize] = self.stands[a.2 as usize];
            }
        }
    }

    /// Lists the half-edges of each vertex (a counting sort).
    fn gather(&mut self, vertex_count: usize) {
        self.starts.clear();
        self.starts.resize(vertex_count + 2, 0);
        let live: Vec<u32> = self.live().collect();
        for &sub in &live {
            for vertex in [self.tail(sub), self.head(sub)] {
                self.starts[vertex as usize + 2] += 1;
            }
        }
        for v in 2..vertex_count + 2 {
            self.starts[v] += self.starts[v - 1];
        }
        self.around.clear();
        self.around.resize(2 * live.len(), END);
        for &sub in &live {
            for half_edge in [2 * sub, 2 * sub + 1] {
                let origin = self.origin(half_edge) as usize;
                let at = &mut self.starts[origin + 1];
                self.around[*at as usize] = half_edge;
                *at += 1;
            }
        }
        self.starts.pop();
    }

    fn sort(&mut self, edges: &Edges) {
        let mut around = std::mem::take(&mut self.around);
        for v in 0..self.starts.len() - 1 {
            let span = &mut around[self.starts[v] as usize..self.starts[v + 1] as usize];
            if span.len() > 1 {
                span.sort_unstable_by(|&g, &h| by_angle(self.direction(edges, g), self.direction(edges, h)));
            }
        }
        self.around = around;
    }

    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The sub-edges of an edge, in order along it.
    pub(crate) fn of_edge(&self, edge: u32) -> Range<u32> {
        self.first[edge as usize]..self.first[edge as usize + 1]
    }

    /// The sub-edges that stand for themselves.
    pub(crate) fn live(&self) -> impl Iterator<Item = u32> + '_ {
        (0..index(self.len())).filter(|&sub| self.stand_in(sub) == sub)
    }

    #[inline]
    pub(crate) fn tail(&self, sub: u32) -> u32 {
        self.ends[sub as usize][0]
    }

    #[inline]
    pub(crate) fn head(&self, sub: u32) -> u32 {
        self.ends[sub as usize][1]
    }

    /// The edge that the sub-edge is a piece of.
    #[inline]
    pub(crate) fn edge(&self, sub: u32) -> u32 {
        self.edge[sub as usize]
    }

    /// The sub-edge that stands for all that coincide with this one.
    #[inline]
    pub(crate) fn stand_in(&self, sub: u32) -> u32 {
        self.stands.get(sub as usize).copied().unwrap_or(sub)
    }

    /// A sub-edge that stands for itself, and all that coincide with it.
    #[inline]
    pub(crate) fn coincident(&self, sub: u32) -> impl Iterator<Item = u32> + '_ {
        let next = |&s: &u32| self.next.get(s as usize).copied().filter(|&n| n != END);
        std::iter::successors(Some(sub), next)
    }

    #[inline]
    pub(crate) fn origin(&self, half_edge: u32) -> u32 {
        self.ends[half_edge as usize >> 1][half_edge as usize & 1]
    }

    /// The places in [`around`](Arrangement::around) of the half-edges that leave a vertex.
    #[inline]
    pub(crate) fn span(&self, vertex: u32) -> Range<u32> {
        self.starts[vertex as usize]..self.starts[vertex as usize + 1]
    }

    #[inline]
    pub(crate) fn around(&self, place: u32) -> u32 {
        self.around[place as usize]
    }

    /// The edge along a half-edge, directed as it.
    #[inline]
    fn direction(&self, edges: &Edges, half_edge: u32) -> Segment {
        let [a, b] = edges.segment(self.edge(half_edge >> 1));
        if half_edge & 1 == 0 { [a, b] } else { [b, a] }
    }

    /// The laws: half-edges leave their vertex, and angles strictly increase around each vertex.
    fn check(&self, edges: &Edges) -> bool {
        (0..index(self.starts.len() - 1)).all(|v| {
            let directions: Vec<Segment> =
                self.span(v).map(|place| self.direction(edges, self.around(place))).collect();
            self.span(v).all(|place| self.origin(self.around(place)) == v)
                && directions.windows(2).all(|pair| by_angle(pair[0], pair[1]) == Ordering::Less)
        })
    }
}

/// By angle in (-90°, 270°].
#[inline]
fn by_angle(g: Segment, h: Segment) -> Ordering {
    let leftward = |s: Segment| lexicographic(s[0], s[1]) == Ordering::Greater;
    leftward(g).cmp(&leftward(h)).then_with(|| match turn(g, h) {
        Side::Left => Ordering::Less,
        Side::On => Ordering::Equal,
        Side::Right => Ordering::Greater,
    })
}
