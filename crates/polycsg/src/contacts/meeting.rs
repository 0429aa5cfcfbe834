//! What follows from how two edges meet: nodes and contacts.

use super::close_pairs::ClosePairs;
use super::contact::{Contact, Partner};
use super::pair::{Crossing, Meeting, SharedEnd, meeting};
use super::{Contacts, NONE};
use crate::edges::Edges;
use crate::predicates::{Area, Parameter, Segment, Side, is_inside, side_of};

impl Contacts {
    /// Compares two edges and notes how they meet.
    #[inline]
    pub(super) fn meet(&mut self, edges: &Edges, e: u32, f: u32, close_pairs: &mut ClosePairs) {
        match meeting(edges, [e, f], close_pairs.margins()) {
            Meeting::Apart => {}
            Meeting::Sharing(at_end) => self.share(edges, [e, f], at_end),
            Meeting::Crossing(crossing) => self.cross(edges, crossing),
            Meeting::Close { ends_of_f, ends_of_e } => {
                self.meet_closely(edges, [e, f], ends_of_f, ends_of_e, close_pairs);
            }
        }
    }

    pub(super) fn cross(&mut self, edges: &Edges, Crossing { edges: [e, f], at, from_left }: Crossing) {
        let node = self.classes.push();
        self.nodes.push([e, f]);
        self.found.push(Contact::new(at[0], e, node, Partner::crossing(f, from_left)));
        // Seen along f, e comes from the other side.
        self.found.push(Contact::new(at[1], f, node, Partner::crossing(e, !from_left)));
        self.rings.join(edges.ring_of(e), edges.ring_of(f));
    }

    /// As [`meet`](Contacts::meet), for edges that are not clear of one another or have an end in common.
    fn meet_closely(
        &mut self,
        edges: &Edges,
        [e, f]: [u32; 2],
        ends_of_f: [Area; 2],
        ends_of_e: [Area; 2],
        close_pairs: &mut ClosePairs,
    ) {
        let (s, t) = (edges.segment(e), edges.segment(f));
        if let Some(shared) = SharedEnd::of(s, t).filter(SharedEnd::is_corner) {
            close_pairs.add(e, f);
            return self.share(edges, [e, f], shared.at_end);
        }
        let sides_of = |line: Segment, areas: [Area; 2], ends: Segment| {
            [0, 1].map(|i| side_of(areas[i], line[0], line[1], ends[i]))
        };
        let ([p0, p1], [q0, q1]) = (sides_of(s, ends_of_f, t), sides_of(t, ends_of_e, s));
        let on_one_side = |a: Side, b: Side| a == b && a != Side::On;
        if on_one_side(p0, p1) || on_one_side(q0, q1) {
            return close_pairs.add(e, f);
        }
        if ![p0, p1, q0, q1].contains(&Side::On) {
            close_pairs.add(e, f);
            let crossing = Crossing::new([e, f], ends_of_f, ends_of_e, p0 == Side::Left);
            return self.cross(edges, crossing);
        }
        self.touch(edges, [e, f], [p0, p1, q0, q1]);
        let line_up = [p0, p1, q0, q1] == [Side::On; 4];
        let steep =
            ends_of_f.iter().chain(&ends_of_e).any(|&area| close_pairs.margins().are_steep([s, t], area));
        if !line_up && !steep {
            close_pairs.add(e, f);
        }
    }

    /// Two edges that have an end in common, and nothing else. The edges that start there join its vertices, and those that
    /// end open rings there.
    fn share(&mut self, edges: &Edges, pair: [u32; 2], at_end: [bool; 2]) {
        let vertex = |i: usize| if at_end[i] { edges.open_end(pair[i]) } else { Some(pair[i]) };
        if let (Some(v), Some(w)) = (vertex(0), vertex(1)) {
            self.join(edges, v, w);
        }
    }

    /// Records contacts at ends: `sides` are those of f's ends against e and of e's ends against f.
    fn touch(&mut self, edges: &Edges, [e, f]: [u32; 2], sides: [Side; 4]) {
        for (side, (edge, vertex)) in
            sides.into_iter().zip([(e, f), (e, edges.head(f)), (f, e), (f, edges.head(e))])
        {
            if side == Side::On {
                self.put(edges, edge, vertex);
            }
        }
    }

    /// Records a vertex, a point on the line of `edge`, if it lies on the edge.
    fn put(&mut self, edges: &Edges, edge: u32, vertex: u32) {
        let (segment, point) = (edges.segment(edge), edges.point(vertex));
        if point == segment[0] {
            self.join(edges, edge, vertex);
        } else if point == segment[1] {
            self.join(edges, edges.head(edge), vertex);
        } else if is_inside(segment, point) {
            let node = self.make_node(edges, vertex);
            let at = Parameter::of_point(segment, point);
            self.found.push(Contact::new(at, edge, node, Partner::vertex(vertex)));
            self.rings.join(edges.ring_of(edge), edges.ring_of(vertex));
        }
    }

    /// Makes two vertices at one point one node.
    pub(super) fn join(&mut self, edges: &Edges, v: u32, w: u32) {
        let (a, b) = (self.make_node(edges, v), self.make_node(edges, w));
        self.classes.join(a, b);
        self.rings.join(edges.ring_of(v), edges.ring_of(w));
    }

    pub(super) fn make_node(&mut self, edges: &Edges, vertex: u32) -> u32 {
        if !self.degenerate {
            self.degenerate = true;
            self.node_of_vertex.resize(edges.len(), NONE);
        }
        if self.node_of_vertex[vertex as usize] == NONE {
            let node = self.classes.push();
            self.node_of_vertex[vertex as usize] = node;
            self.nodes.push([vertex, NONE]);
            let ring = edges.ring(vertex);
            let partner = match (ring.is_open, vertex) {
                (true, first) if first == ring.start => Partner::FIRST,
                (true, end) if end == ring.end => Partner::END,
                _ => Partner::START,
            };
            self.found.push(Contact::new(Parameter::START, vertex, node, partner));
        }
        self.node_of_vertex[vertex as usize]
    }
}
