//! The rounded boundary in fragments between cuts.

use super::fragment::{CutAt, Fragment, Part};
use crate::base::id::index;
use crate::base::meter::{Meter, Refusal, Tally};
use crate::boundary::select::{End, Piece, Selection};
use crate::contacts::{Contacts, Place};
use crate::edges::Edges;
use crate::predicates::{Ratio, crossing_ratio, crossing_x_order, crossings_x_order};
use glam::DVec2;
use std::cmp::Ordering;

/// A cut counts for so much work, as exact numbers make it.
const EXACT: usize = 16;

/// The rounded boundary, which may need repair.
#[derive(Clone, Copy)]
pub(crate) struct Rounded<'a> {
    pub(crate) edges: &'a Edges,
    pub(crate) contacts: &'a Contacts,
    pub(crate) selection: &'a Selection,
}

impl Rounded<'_> {
    /// The parts of all pieces, or of those on some edges.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn list_parts(
        &self,
        only: Option<&[u32]>,
        parts: &mut Vec<Part>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        parts.clear();
        let mut tally = meter.tally();
        for piece in self.selection.pieces() {
            for (i, span) in piece.edge_spans().into_iter().enumerate() {
                tally.add(1)?;
                match only {
                    None => self.add_parts(piece, i, span, parts, &mut tally)?,
                    Some(edges) => {
                        let first = edges.partition_point(|&e| e < span.start);
                        let count = edges[first..].partition_point(|&e| e < span.end);
                        let edges = edges[first..first + count].iter().copied();
                        self.add_parts(piece, i, edges, parts, &mut tally)?;
                    }
                }
            }
        }
        Ok(())
    }

    fn add_parts(
        &self,
        piece: &Piece,
        span: usize,
        edges: impl Iterator<Item = u32>,
        parts: &mut Vec<Part>,
        tally: &mut Tally<'_>,
    ) -> Result<(), Refusal> {
        for edge in edges {
            tally.add(1)?;
            let [from, to] = piece.ends_on(span, edge, self.edges.ring(edge)).map(|end| self.vertex(end));
            let (start, end) = if piece.along { (from, to) } else { (to, from) };
            parts.push(Part { start, end, edge });
        }
        Ok(())
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
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn round(
        &self,
        parts: &[Part],
        fragments: &mut Vec<Fragment>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        fragments.clear();
        let fragment = |&Part { start, end, edge }: &Part| {
            let ends = [start, end];
            let moved = ends.iter().any(|&vertex| self.crossing(vertex).is_some());
            Fragment { segment: ends.map(|vertex| self.point(vertex)), edge, ends, moved, round: 0 }
        };
        meter.extend(fragments, parts.iter().map(fragment))
    }

    /// Cuts some of the fragments: the first piece takes the place of the whole, the others are added.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn cut_up(
        &self,
        cuts: &[CutAt],
        fragments: &mut Vec<Fragment>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let mut tally = meter.tally();
        for own in cuts.chunk_by(|a, b| a.0 == b.0) {
            tally.add(EXACT * own.len())?;
            let place = own[0].0 as usize;
            let mut rest = Fragment { moved: true, ..fragments[place] };
            for vertex in self.ordered(rest.ends, own).into_iter().rev() {
                let point = self.cut_point(rest.edge, vertex);
                fragments.push(Fragment {
                    segment: [point, rest.segment[1]],
                    ends: [vertex, rest.ends[1]],
                    ..rest
                });
                (rest.segment[1], rest.ends[1]) = (point, vertex);
            }
            fragments[place] = rest;
        }
        Ok(())
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

    /// The exact x of a vertex.
    fn exact_abscissa(&self, vertex: u32) -> Ratio {
        match self.crossing(vertex) {
            None => Ratio::from_f64(self.edges.point(vertex).x),
            Some(pair) => {
                let [e, f] = pair.map(|edge| self.edges.segment(edge));
                let [x, _] = crossing_ratio(e, f);
                x
            }
        }
    }

    /// Rounding is monotone: only equal rounded abscissae need the exact ones.
    fn compare_abscissae(&self, a: u32, b: u32) -> Ordering {
        let order = self.point(a).x.total_cmp(&self.point(b).x);
        if order == Ordering::Equal && a != b { self.compare_exactly(a, b) } else { order }
    }

    fn compare_exactly(&self, a: u32, b: u32) -> Ordering {
        let segments = |pair: [u32; 2]| pair.map(|edge| self.edges.segment(edge));
        match [a, b].map(|vertex| self.crossing(vertex).map(segments)) {
            [Some(at), Some(other)] => crossings_x_order(at, other),
            [Some([e, f]), None] => crossing_x_order(e, f, self.point(b).x),
            [None, Some([e, f])] => crossing_x_order(e, f, self.point(a).x).reverse(),
            [None, None] => Ordering::Equal,
        }
    }

    /// The point of an edge at a vertex's abscissa, rounded.
    fn cut_point(&self, edge: u32, vertex: u32) -> DVec2 {
        let y = self.exact_abscissa(vertex).ordinate_on(self.edges.segment(edge).map(|p| p.to_array()));
        DVec2::new(self.point(vertex).x, y.to_f64())
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
