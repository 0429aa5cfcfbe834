//! Stage 3: where edges meet, exactly, sorted along each edge.
//!
//! Four orientation signs tell how two edges meet; everything else follows from them and from comparisons:
//!
//! ```text
//!  crossing          touch             shared end       overlap = two touches or shared ends
//!      \ f            f                  |f              ____f____
//!   ----x---- e   ----+---- e        e---+              e----+====+
//!        \       one record, on e   one vertex, no record
//! ```
//!
//! A crossing becomes a vertex of its own, known as the pair of edges; two crossings at one point always share an edge
//! pairwise, so that equality along each edge is all that is needed to unify them.

use crate::edges::Edges;
use crate::predicates::{
    Parameter, Side, crossing_order, doubled_area, is_inside, lexicographic, point_crossing_order, side,
    side_of,
};
use crate::strips::Strips;
use crate::truth::index;
use crate::union_find::UnionFind;
use std::cmp::Ordering;
use std::ops::Range;

/// No other edge: the contact is an explicit vertex.
const NONE: u32 = u32::MAX;

/// A vertex strictly inside an edge.
#[derive(Clone, Copy, Debug)]
struct Contact {
    at: Parameter,
    edge: u32,
    /// The edge that crosses here, or none.
    other: u32,
    vertex: u32,
}

/// All contacts, by edge and in order along it, and which vertices and rings they join.
#[derive(Debug, Default)]
pub(crate) struct Contacts {
    found: Vec<Contact>,
    sorted: Vec<Contact>,
    starts: Vec<u32>,
    /// The two edges of each crossing; its vertex is the number of explicit vertices plus its index.
    crossings: Vec<[u32; 2]>,
    vertices: UnionFind,
    rings: UnionFind,
    /// The edges that overlap another one.
    overlapping: Vec<u32>,
}

impl Contacts {
    /// Finds the contacts of all candidate pairs; the pairs in `same` are edges with the same ends.
    pub(crate) fn find(&mut self, edges: &Edges, strips: &Strips, same: &[[u32; 2]]) {
        self.found.clear();
        self.crossings.clear();
        self.overlapping.clear();
        self.vertices.reset(edges.len());
        self.rings.reset(edges.rings().len());
        for &[e, f] in same {
            self.join_ends(edges, e, f);
        }
        strips.pairs(|e, f| self.meet(edges, e.min(f), e.max(f)));
        self.bucket(edges.len());
        self.sort(edges);
    }

    /// The vertices strictly inside an edge, in order along it; one vertex may stand twice in a row.
    pub(crate) fn inside(&self, edge: u32) -> impl Iterator<Item = u32> + '_ {
        self.sorted[self.span(edge)].iter().map(|contact| self.vertices.find(contact.vertex))
    }

    /// The one vertex that stands for all at its point; an explicit one if there is any.
    #[inline]
    pub(crate) fn vertex(&self, vertex: u32) -> u32 {
        self.vertices.find(vertex)
    }

    pub(crate) fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// The edges whose crossing a vertex is; `None` for an explicit one.
    pub(crate) fn crossing(&self, vertex: u32) -> Option<[u32; 2]> {
        let explicit = self.vertices.len() - self.crossings.len();
        (vertex as usize).checked_sub(explicit).map(|i| self.crossings[i])
    }

    /// The connected component of a ring, named by one of its rings.
    pub(crate) fn component(&self, ring: u32) -> u32 {
        self.rings.find(ring)
    }

    pub(crate) fn overlapping(&self) -> &[u32] {
        &self.overlapping
    }

    fn span(&self, edge: u32) -> Range<usize> {
        self.starts[edge as usize] as usize..self.starts[edge as usize + 1] as usize
    }

    fn join_ends(&mut self, edges: &Edges, e: u32, f: u32) {
        let ends = if edges.is_along(e, f) { [f, edges.head(f)] } else { [edges.head(f), f] };
        self.vertices.join(e, ends[0]);
        self.vertices.join(edges.head(e), ends[1]);
        self.rings.join(edges.ring_of(e), edges.ring_of(f));
    }

    fn meet(&mut self, edges: &Edges, e: u32, f: u32) {
        let (s, t) = (edges.segment(e), edges.segment(f));
        let neighbours_turn = (edges.head(e) == f && side(s[0], s[1], t[1]) != Side::On)
            || (edges.head(f) == e && side(t[0], t[1], s[1]) != Side::On);
        if neighbours_turn {
            return; // they share their vertex and nothing else
        }
        let (t0, t1) = (doubled_area(s[0], s[1], t[0]), doubled_area(s[0], s[1], t[1]));
        let (p0, p1) = (side_of(t0, s[0], s[1], t[0]), side_of(t1, s[0], s[1], t[1]));
        if p0 == p1 && p0 != Side::On {
            return;
        }
        let (s0, s1) = (doubled_area(t[0], t[1], s[0]), doubled_area(t[0], t[1], s[1]));
        let (q0, q1) = (side_of(s0, t[0], t[1], s[0]), side_of(s1, t[0], t[1], s[1]));
        if q0 == q1 && q0 != Side::On {
            return;
        }
        if [p0, p1, q0, q1].contains(&Side::On) {
            self.touch(edges, e, f, [p0, p1, q0, q1]);
        } else {
            self.cross(edges, (e, Parameter::of_crossing(s0, s1)), (f, Parameter::of_crossing(t0, t1)));
        }
    }

    fn cross(&mut self, edges: &Edges, (e, at_e): (u32, Parameter), (f, at_f): (u32, Parameter)) {
        let vertex = self.vertices.push();
        self.crossings.push([e, f]);
        self.found.push(Contact { at: at_e, edge: e, other: f, vertex });
        self.found.push(Contact { at: at_f, edge: f, other: e, vertex });
        self.rings.join(edges.ring_of(e), edges.ring_of(f));
    }

    /// Contacts at ends: `sides` are those of f's ends against e and of e's ends against f.
    fn touch(&mut self, edges: &Edges, e: u32, f: u32, sides: [Side; 4]) {
        let mut joined = 0;
        for (side, (edge, vertex)) in
            sides.into_iter().zip([(e, f), (e, edges.head(f)), (f, e), (f, edges.head(e))])
        {
            if side == Side::On {
                joined += u32::from(self.put(edges, edge, vertex));
            }
        }
        if joined > 0 {
            self.rings.join(edges.ring_of(e), edges.ring_of(f));
        }
        // Collinear edges with two common points overlap; a shared end counts from both sides.
        let shared_end = joined == 2 && {
            let (s, t) = (edges.segment(e), edges.segment(f));
            s.iter().filter(|p| t.contains(p)).count() == 1
        };
        if sides == [Side::On; 4] && joined >= 2 && !shared_end {
            self.overlapping.extend([e, f]);
        }
    }

    /// Records a vertex, a point on the line of `edge`, if it lies on the edge.
    fn put(&mut self, edges: &Edges, edge: u32, vertex: u32) -> bool {
        let (segment, point) = (edges.segment(edge), edges.point(vertex));
        if point == segment[0] {
            self.vertices.join(edge, vertex);
            return true;
        }
        if point == segment[1] {
            self.vertices.join(edges.head(edge), vertex);
            return true;
        }
        let inside = is_inside(segment, point);
        if inside {
            let at = Parameter::of_point(segment, point);
            self.found.push(Contact { at, edge, other: NONE, vertex });
        }
        inside
    }

    /// Moves the contacts to their edges' places (a counting sort).
    fn bucket(&mut self, edge_count: usize) {
        self.starts.clear();
        self.starts.resize(edge_count + 2, 0);
        for contact in &self.found {
            self.starts[contact.edge as usize + 2] += 1;
        }
        for e in 2..edge_count + 2 {
            self.starts[e] += self.starts[e - 1];
        }
        self.sorted.clear();
        self.sorted.resize(
            self.found.len(),
            Contact { at: Parameter::default(), edge: NONE, other: NONE, vertex: NONE },
        );
        for &contact in &self.found {
            let at = &mut self.starts[contact.edge as usize + 1];
            self.sorted[*at as usize] = contact;
            *at += 1;
        }
        self.starts.pop();
    }

    fn sort(&mut self, edges: &Edges) {
        let mut start = 0;
        while start < self.sorted.len() {
            let edge = self.sorted[start].edge;
            let span = self.span(edge);
            start = span.end;
            if span.len() < 2 {
                continue;
            }
            let contacts = &mut self.sorted[span];
            contacts.sort_unstable_by(|a, b| order(edges, a, b));
            for pair in contacts.windows(2) {
                if order(edges, &pair[0], &pair[1]) == Ordering::Equal {
                    self.vertices.join(pair[0].vertex, pair[1].vertex);
                }
            }
        }
        debug_assert!(index(self.found.len()) as usize == self.sorted.len());
    }
}

/// The order of two contacts along their common edge: by the parameters where their bounds allow, else exactly.
#[inline]
fn order(edges: &Edges, a: &Contact, b: &Contact) -> Ordering {
    a.at.certain_order(b.at).unwrap_or_else(|| order_exactly(edges, a, b))
}

#[cold]
fn order_exactly(edges: &Edges, a: &Contact, b: &Contact) -> Ordering {
    let e = edges.segment(a.edge);
    match (a.other, b.other) {
        (NONE, NONE) => {
            let order = lexicographic(edges.point(a.vertex), edges.point(b.vertex));
            if lexicographic(e[0], e[1]) == Ordering::Less { order } else { order.reverse() }
        }
        (NONE, g) => point_crossing_order(e, edges.point(a.vertex), edges.segment(g)),
        (g, NONE) => point_crossing_order(e, edges.point(b.vertex), edges.segment(g)).reverse(),
        (f, g) => crossing_order(e, edges.segment(f), edges.segment(g)),
    }
}
