//! The rounded boundary in fragments between cuts.

use super::fragment::{CutAt, Fragment, Part};
use crate::base::id::index;
use crate::boundary::select::{End, Piece, Selection};
use crate::contacts::{Contacts, Place};
use crate::edges::Edges;
use crate::predicates::{Ratio, crossing_ratio};
use glam::DVec2;
use std::cmp::Ordering;

/// The rounded boundary, which may need repair.
#[derive(Clone, Copy)]
pub(crate) struct Rounded<'a> {
    pub(crate) edges: &'a Edges,
    pub(crate) contacts: &'a Contacts,
    pub(crate) selection: &'a Selection,
}

/// An exact abscissa: that of a vertex.
#[derive(Clone, Debug)]
struct Abscissa {
    vertex: u32,
    rounded: f64,
}

impl Rounded<'_> {
    /// The parts of all pieces, or of those on some edges.
    pub(super) fn list_parts(&self, only: Option<&[u32]>, parts: &mut Vec<Part>) {
        parts.clear();
        for piece in self.selection.pieces() {
            for (i, span) in piece.edge_spans().into_iter().enumerate() {
                match only {
                    None => self.add_parts(piece, i, span, parts),
                    Some(edges) => {
                        let first = edges.partition_point(|&e| e < span.start);
                        let count = edges[first..].partition_point(|&e| e < span.end);
                        self.add_parts(piece, i, edges[first..first + count].iter().copied(), parts);
                    }
                }
            }
        }
    }

    fn add_parts(&self, piece: &Piece, span: usize, edges: impl Iterator<Item = u32>, parts: &mut Vec<Part>) {
        for edge in edges {
            let [from, to] = piece.ends_on(span, edge, self.edges.ring(edge)).map(|end| self.vertex(end));
            let (start, end) = if piece.along { (from, to) } else { (to, from) };
            parts.push(Part { start, end, edge });
        }
    }

    /// The id of a vertex, the same for all pieces that end there.
    fn vertex(&self, end: End) -> u32 {
        let node = match end {
            End::Node(node) => Some(node),
            End::Vertex(vertex) => self.contacts.node_at(vertex),
        };
        match (node.map(|node| (node, self.contacts.place(node))), end) {
            (Some((_, Place::Vertex(vertex))), _) | (None, End::Vertex(vertex)) => vertex,
            (Some((node, Place::Crossing(..))), _) | (None, End::Node(node)) => {
                index(self.edges.len()) + node
            }
        }
    }

    /// The edges whose crossing a vertex is; `None` for an explicit one.
    fn crossing(&self, vertex: u32) -> Option<[u32; 2]> {
        let node = vertex.checked_sub(index(self.edges.len()))?;
        match self.contacts.place(node) {
            Place::Crossing(e, f) => Some([e, f]),
            Place::Vertex(_) => None,
        }
    }

    /// Where a vertex lies, rounded.
    fn point(&self, vertex: u32) -> DVec2 {
        match vertex.checked_sub(index(self.edges.len())) {
            Some(node) => self.selection.node_point(self.edges, self.contacts, node),
            None => self.edges.point(vertex),
        }
    }

    /// A fragment for each part.
    pub(super) fn round(&self, parts: &[Part], fragments: &mut Vec<Fragment>) {
        fragments.clear();
        fragments.extend(parts.iter().map(|&Part { start, end, edge }| {
            let ends = [start, end];
            let moved = ends.iter().any(|&vertex| self.crossing(vertex).is_some());
            Fragment { segment: ends.map(|vertex| self.point(vertex)), edge, ends, moved }
        }));
    }

    /// Cuts some of the fragments, and leaves the others.
    pub(super) fn cut_up(&self, mut cuts: &[CutAt], fragments: &mut Vec<Fragment>) {
        let before = std::mem::take(fragments);
        fragments.reserve(before.len() + cuts.len());
        for (id, fragment) in (0..).zip(before) {
            let own = cuts.iter().take_while(|cut| cut.0 == id).count();
            if own == 0 {
                fragments.push(fragment);
            } else {
                self.cut(fragment, &cuts[..own], fragments);
            }
            cuts = &cuts[own..];
        }
    }

    fn cut(&self, fragment: Fragment, cuts: &[CutAt], fragments: &mut Vec<Fragment>) {
        let mut rest = Fragment { moved: true, ..fragment };
        for vertex in self.ordered(fragment.ends, cuts) {
            let point = self.cut_point(fragment.edge, vertex);
            fragments.push(Fragment {
                segment: [rest.segment[0], point],
                ends: [rest.ends[0], vertex],
                ..rest
            });
            (rest.segment[0], rest.ends[0]) = (point, vertex);
        }
        fragments.push(rest);
    }

    /// The vertices of cuts between two vertices, from the first of these to the second, equal abscissae once.
    fn ordered(&self, ends: [u32; 2], cuts: &[CutAt]) -> Vec<u32> {
        let mut vertices: Vec<u32> = cuts.iter().map(|cut| cut.1).collect();
        vertices.sort_by(|&a, &b| self.compare_abscissae(a, b));
        vertices.dedup_by(|a, b| self.compare_abscissae(*a, *b) == Ordering::Equal);
        if self.compare_abscissae(ends[0], ends[1]) == Ordering::Greater {
            vertices.reverse();
        }
        vertices
    }

    fn abscissa(&self, vertex: u32) -> Abscissa {
        Abscissa { vertex, rounded: self.point(vertex).x }
    }

    /// The exact x of a vertex.
    fn exact_abscissa(&self, vertex: u32) -> Ratio {
        match self.crossing(vertex) {
            None => Ratio::from_f64(self.edges.point(vertex).x),
            Some([e, f]) => {
                let [x, _] = crossing_ratio(self.edges.segment(e), self.edges.segment(f));
                x
            }
        }
    }

    /// Rounding is monotone: only equal rounded abscissae need the exact ones.
    fn compare_abscissae(&self, a: u32, b: u32) -> Ordering {
        let (a, b) = (self.abscissa(a), self.abscissa(b));
        match a.rounded.partial_cmp(&b.rounded) {
            Some(Ordering::Equal) | None if a.vertex != b.vertex => {
                self.exact_abscissa(a.vertex).compare(&self.exact_abscissa(b.vertex))
            }
            order => order.unwrap_or(Ordering::Equal),
        }
    }

    /// The point of an edge at a vertex's abscissa, rounded.
    fn cut_point(&self, edge: u32, vertex: u32) -> DVec2 {
        let y = self.exact_abscissa(vertex).ordinate_on(self.edges.segment(edge).map(|p| p.to_array()));
        DVec2::new(self.abscissa(vertex).rounded, y.to_f64())
    }

    /// Two vertices, that with the smaller abscissa first.
    pub(super) fn rightward(&self, [a, b]: [u32; 2]) -> [u32; 2] {
        if self.compare_abscissae(a, b) == Ordering::Greater { [b, a] } else { [a, b] }
    }

    pub(super) fn is_strictly_between(&self, ends: [u32; 2], vertex: u32) -> bool {
        let (from, to) = (self.compare_abscissae(ends[0], vertex), self.compare_abscissae(vertex, ends[1]));
        from == to && from != Ordering::Equal
    }
}
