//! Stage 6: the sub-edges whose two sides differ, directed with the interior to the left, each vertex rounded once.

use crate::arrangement::Arrangement;
use crate::contacts::Contacts;
use crate::edges::Edges;
use crate::labels::Labels;
use crate::membership::Membership;
use crate::predicates::crossing_point;
use glam::DVec2;

/// A directed piece of the boundary: two vertices and the edge that it lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Piece {
    pub(crate) start: u32,
    pub(crate) end: u32,
    pub(crate) edge: u32,
}

/// The boundary's pieces and the rounded crossings.
#[derive(Debug, Default)]
pub(crate) struct Selection {
    pieces: Vec<Piece>,
    /// The number of explicit vertices; beyond them `rounded` and `degree` are indexed.
    explicit: usize,
    rounded: Vec<DVec2>,
    /// How many pieces start in each crossing; two are as good as more.
    degree: Vec<u8>,
}

impl Selection {
    /// Selects the pieces of the set's boundary.
    ///
    /// Where a piece runs straight on through a crossing, and nothing else of the boundary meets it there, the
    /// crossing is dropped; input vertices are kept.
    pub(crate) fn select(
        &mut self,
        edges: &Edges,
        contacts: &Contacts,
        arrangement: &Arrangement,
        labels: &Labels,
    ) {
        self.pieces.clear();
        self.explicit = edges.len();
        let crossings = contacts.vertex_count() - edges.len();
        self.degree.clear();
        self.degree.resize(crossings, 0);
        self.count_degrees(arrangement, labels);
        for edge in edges.ids() {
            self.select_along(edge, arrangement, labels);
        }
        self.round(edges, contacts, crossings);
    }

    pub(crate) fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// Where a vertex of a piece lies, rounded.
    #[inline]
    pub(crate) fn point(&self, edges: &Edges, vertex: u32) -> DVec2 {
        match self.crossing_index(vertex) {
            None => edges.point(vertex),
            Some(i) => self.rounded[i],
        }
    }

    /// Whether the vertex is a crossing, which rounding may have moved.
    #[inline]
    pub(crate) fn is_crossing(&self, vertex: u32) -> bool {
        vertex as usize >= self.explicit
    }

    fn crossing_index(&self, vertex: u32) -> Option<usize> {
        (vertex as usize).checked_sub(self.explicit)
    }

    fn count_degrees(&mut self, arrangement: &Arrangement, labels: &Labels) {
        for sub in arrangement.live() {
            let start = directed(arrangement, labels, sub).map(|[start, _]| start);
            if let Some(i) = start.and_then(|start| self.crossing_index(start)) {
                self.degree[i] = self.degree[i].saturating_add(1);
            }
        }
    }

    fn select_along(&mut self, edge: u32, arrangement: &Arrangement, labels: &Labels) {
        let mut last: Option<Piece> = None;
        for sub in arrangement.of_edge(edge) {
            let selected = (arrangement.stand_in(sub) == sub)
                .then(|| directed(arrangement, labels, sub))
                .flatten()
                .map(|[start, end]| Piece { start, end, edge });
            match (last, selected) {
                (Some(a), Some(b)) if a.end == b.start && self.passes_through(a.end) => {
                    last = Some(Piece { end: b.end, ..a });
                }
                (Some(a), Some(b)) if b.end == a.start && self.passes_through(a.start) => {
                    last = Some(Piece { start: b.start, ..a });
                }
                _ => {
                    self.pieces.extend(last);
                    last = selected;
                }
            }
        }
        self.pieces.extend(last);
    }

    /// A crossing at which one piece ends and one starts.
    fn passes_through(&self, vertex: u32) -> bool {
        self.crossing_index(vertex).is_some_and(|i| self.degree[i] == 1)
    }

    fn round(&mut self, edges: &Edges, contacts: &Contacts, crossings: usize) {
        self.rounded.clear();
        self.rounded.resize(crossings, DVec2::NAN);
        for piece in &self.pieces {
            for vertex in [piece.start, piece.end] {
                let Some([e, f]) = contacts.crossing(vertex) else { continue };
                let place = &mut self.rounded[vertex as usize - self.explicit];
                if place.is_nan() {
                    *place = crossing_point(edges.segment(e), edges.segment(f));
                }
            }
        }
    }
}

/// The ends of a sub-edge of the boundary, directed with the interior to the left.
fn directed(arrangement: &Arrangement, labels: &Labels, sub: u32) -> Option<[u32; 2]> {
    match labels.of(sub) {
        Membership::OnPlus => Some([arrangement.tail(sub), arrangement.head(sub)]),
        Membership::OnMinus => Some([arrangement.head(sub), arrangement.tail(sub)]),
        Membership::In | Membership::Out => None,
    }
}
