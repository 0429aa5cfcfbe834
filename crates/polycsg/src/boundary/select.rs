//! Stage 6: the sub-edges whose two sides differ, directed with the interior to the left, each vertex rounded once.

use crate::arrangement::{Node, labels::LabelledArrangement};
use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, threads::Threads};
use crate::contacts::{Contacts, Place};
use crate::edges::{EdgeRing, Edges};
use crate::predicates::crossing_point;
use crate::region::membership::Membership;
use glam::DVec2;
use std::ops::Range;

/// A directed piece of the boundary: part of one ring, from node to node, or all of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Piece {
    pub(crate) ring: u32,
    /// The nodes where it starts and ends in the ring's direction; none for a whole ring.
    pub(crate) nodes: Option<[u32; 2]>,
    /// The edge on which it starts, in the ring's direction; of a whole ring the last one.
    first_edge: u32,
    /// The ring's vertices inside the piece, in order: at most two spans of slots.
    inner: [[u32; 2]; 2],
    /// Whether the interior lies to the left of the ring; else the piece runs against it.
    pub(crate) along: bool,
}

impl Piece {
    fn whole(ring: u32, about: EdgeRing, along: bool) -> Piece {
        let inner = [[about.start, about.end - 1], [0, 0]];
        Piece { ring, nodes: None, first_edge: about.end - 1, inner, along }
    }

    /// The spans of slots of the vertices inside, in the ring's order.
    pub(crate) fn inner(&self) -> [Range<usize>; 2] {
        self.inner.map(|[start, end]| start as usize..end as usize)
    }

    /// Its edges, as spans.
    pub(crate) fn edge_spans(&self) -> [Range<u32>; 3] {
        let [a, b] = self.inner;
        [self.first_edge..self.first_edge + 1, a[0]..a[1], b[0]..b[1]]
    }

    /// Where the part on an edge of one of its spans starts and ends, in the ring's direction.
    pub(crate) fn ends_on(&self, span: usize, edge: u32, about: EdgeRing) -> [End; 2] {
        let spans = self.edge_spans();
        let is_last = edge + 1 == spans[span].end && spans[span + 1..].iter().all(Range::is_empty);
        let (start, end) = (End::Vertex(edge), End::Vertex(about.next(edge)));
        match self.nodes {
            Some([from, to]) => {
                [if span == 0 { End::Node(from) } else { start }, if is_last { End::Node(to) } else { end }]
            }
            None => [start, end],
        }
    }

    /// Its edges, in the ring's order.
    pub(crate) fn edges(&self) -> impl DoubleEndedIterator<Item = u32> + Clone + use<> {
        let [a, b] = self.inner;
        std::iter::once(self.first_edge).chain(a[0]..a[1]).chain(b[0]..b[1])
    }
}

/// Where a piece's part on one edge ends.
#[derive(Clone, Copy, Debug)]
pub(crate) enum End {
    Vertex(u32),
    Node(u32),
}

/// The boundary's pieces and the rounded crossings.
#[derive(Debug, Default)]
pub(crate) struct Selection {
    pieces: Vec<Piece>,
    /// Per node its point if it is a crossing where a piece ends.
    rounded: Vec<DVec2>,
}

/// A node that is no crossing where a piece ends, and one that is, before it is rounded.
const UNUSED: DVec2 = DVec2::NEG_INFINITY;
const WANTED: DVec2 = DVec2::INFINITY;

/// So many nodes are rounded at a time.
const NODES: usize = 4096;

/// A run of selected sub-edges, being built: from the start of one sub-edge to that of another.
#[derive(Clone, Copy)]
struct SubEdgeRun {
    start: u32,
    end: u32,
    along: bool,
}

impl Selection {
    /// Selects the pieces of the set's boundary.
    ///
    /// Where a piece runs straight on through a crossing, and nothing else of the boundary meets it there, the
    /// crossing is dropped; input vertices are kept.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn select(
        &mut self,
        arranged: LabelledArrangement<'_>,
        meter: &Meter<'_>,
    ) -> Result<&Selection, Refusal> {
        self.pieces.clear();
        let threads = Threads::for_edges(arranged.edges.len());
        threads.list(arranged.edges.rings().len(), &mut self.pieces, |mut rings, pieces| {
            let mut tally = meter.tally();
            rings.try_for_each(|ring| {
                arranged.select_along(index(ring), pieces);
                tally.add(1 + arranged.arrangement.of_ring(index(ring)).len())
            })
        })?;
        self.round(arranged.edges, arranged.contacts, meter)?;
        Ok(self)
    }

    pub(crate) fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// Where a piece's node lies, rounded.
    #[inline]
    pub(crate) fn node_point(&self, edges: &Edges, contacts: &Contacts, node: u32) -> DVec2 {
        match contacts.place(node) {
            Place::Vertex(vertex) => edges.point(vertex),
            Place::Crossing(..) => self.rounded[node as usize],
        }
    }

    /// The points of a piece, in its own direction.
    pub(crate) fn points<'a>(
        &'a self,
        edges: &'a Edges,
        contacts: &'a Contacts,
        piece: Piece,
    ) -> impl Iterator<Item = DVec2> + Clone + 'a {
        let along = piece.along;
        let ends = match piece.nodes {
            Some(nodes) => nodes.map(|node| self.node_point(edges, contacts, node)),
            None => [edges.point(piece.first_edge); 2],
        };
        let [a, b] = piece.inner();
        let count = a.len() + b.len() + 1;
        let inner =
            move |i: usize| edges.points()[if i < a.len() { a.start + i } else { b.start + i - a.len() }];
        (0..=count).map(move |i| {
            let i = if along { i } else { count - i };
            if i == 0 {
                ends[0]
            } else if i < count {
                inner(i - 1)
            } else {
                ends[1]
            }
        })
    }

    fn round(&mut self, edges: &Edges, contacts: &Contacts, meter: &Meter<'_>) -> Result<(), Refusal> {
        meter.fill(&mut self.rounded, UNUSED, contacts.node_count())?;
        meter.for_each(&self.pieces[..], |piece| {
            let Some(nodes) = piece.nodes else { return };
            for node in nodes.map(|node| node as usize) {
                if let Place::Crossing(..) = Place::of(contacts.nodes()[node]) {
                    self.rounded[node] = WANTED;
                }
            }
        })?;
        let parts = self.rounded.chunks_mut(NODES).zip(contacts.nodes().chunks(NODES));
        Threads::for_edges(edges.len()).try_for_each(parts, |(points, nodes)| {
            for (point, &node) in points.iter_mut().zip(nodes).filter(|(point, _)| **point == WANTED) {
                if let Place::Crossing(e, f) = Place::of(node) {
                    *point = crossing_point(edges.segment(e), edges.segment(f));
                }
            }
            meter.spend(points.len())
        })
    }
}

impl LabelledArrangement<'_> {
    /// Adds the pieces of one ring: maximal runs of selected sub-edges that run alike and pass straight through their nodes.
    ///
    /// ```text
    ///   sub-edges    0    1    2    3    4    5        + selected along the ring, - against it, . not selected
    ///                +    +    .    -    +    +
    ///   runs        [first]       [3]  [ last ]        `last` goes on in `first` if the ring passes through at its start,
    ///                                                  and both together are one piece
    /// ```
    fn select_along(&self, ring: u32, pieces: &mut Vec<Piece>) {
        let sub_edges = self.arrangement.of_ring(ring);
        let about = self.edges.rings()[ring as usize];
        if sub_edges.is_empty() {
            let whole = self.along(index(self.arrangement.len()) + ring);
            pieces.extend(whole.map(|along| Piece::whole(ring, about, along)));
            return;
        }
        let mut run: Option<SubEdgeRun> = None;
        let mut first_run: Option<SubEdgeRun> = None;
        let mut put = |run: SubEdgeRun| {
            // A run from the ring's first sub-edge may yet turn out to continue the last one, as a ring has no first edge.
            if run.start == sub_edges.start && first_run.is_none() {
                first_run = Some(run)
            } else {
                pieces.push(self.piece(ring, run))
            }
        };
        for sub_edge in sub_edges.clone() {
            let next = if sub_edge + 1 == sub_edges.end { sub_edges.start } else { sub_edge + 1 };
            let along = self.along(sub_edge);
            run = match (run, along) {
                (Some(run), Some(along))
                    if run.along == along && self.passes_through(sub_edge, sub_edge - 1) =>
                {
                    Some(SubEdgeRun { end: next, ..run })
                }
                (before, along) => {
                    before.into_iter().for_each(&mut put);
                    along.map(|along| SubEdgeRun { start: sub_edge, end: next, along })
                }
            };
        }
        // The loop may end with a run open, which the first one may continue where the ring closes.
        match (first_run, run) {
            // One run all around: the ring is a piece without nodes, unless something meets it at its start.
            (None, Some(run)) if run.start == sub_edges.start && run.end == sub_edges.start => {
                let whole = self.passes_through(sub_edges.start, sub_edges.end - 1);
                pieces.push(if whole { Piece::whole(ring, about, run.along) } else { self.piece(ring, run) });
            }
            (Some(a), Some(b))
                if a.along == b.along && self.passes_through(sub_edges.start, sub_edges.end - 1) =>
            {
                pieces.push(self.piece(ring, SubEdgeRun { start: b.start, ..a }));
            }
            (a, b) => {
                for run in [a, b].into_iter().flatten() {
                    pieces.push(self.piece(ring, run));
                }
            }
        }
    }

    /// Whether a sub-edge is selected, and its ring's direction then.
    #[inline]
    fn along(&self, sub_edge: u32) -> Option<bool> {
        match self.labels.of(sub_edge) {
            Membership::OnPlus => Some(true),
            Membership::OnMinus => Some(false),
            Membership::In | Membership::Out => None,
        }
    }

    /// Whether between two selected sub-edges of a ring there is only a crossing, and nothing else selected.
    fn passes_through(&self, sub_edge: u32, before: u32) -> bool {
        let selected = |sub_edge: u32| self.along(sub_edge).is_some();
        match self.arrangement.met(sub_edge) {
            Node::Crossing(other) => {
                !selected(other) && !selected(self.arrangement.previous(self.edges, other))
            }
            Node::Junction(junction) => {
                let others = self.arrangement.span(junction).map(|place| self.arrangement.around(place));
                let mut others =
                    others.filter(|&half_edge| half_edge != 2 * sub_edge && half_edge != 2 * before + 1);
                matches!(self.contacts.place(self.arrangement.node(sub_edge)), Place::Crossing(..))
                    && !others.any(|half_edge| selected(half_edge >> 1))
            }
        }
    }

    fn piece(&self, ring: u32, run: SubEdgeRun) -> Piece {
        let about = self.edges.rings()[ring as usize];
        let (first_edge, last_edge) = (self.arrangement.edge(run.start), self.arrangement.edge(run.end));
        let end = last_edge + u32::from(!self.arrangement.starts_edge(run.end));
        let inner = if run.end > run.start {
            [[first_edge + 1, end.max(first_edge + 1)], [0, 0]]
        } else {
            [[first_edge + 1, about.end.max(first_edge + 1)], [about.start, end]]
        };
        let nodes = Some([run.start, run.end].map(|sub_edge| self.arrangement.node(sub_edge)));
        Piece { ring, nodes, first_edge, inner, along: run.along }
    }
}
