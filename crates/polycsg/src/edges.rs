//! Stage 1: all operands' rings as one array of directed edges.

use crate::csg::{Csg, Token};
use crate::predicates::Segment;
use crate::rings::Rings;
use crate::truth::{Truth, index};
use glam::DVec2;

/// Edges and explicit vertices under one numbering: edge `e` starts in vertex `e`.
///
/// The rings lie one after the other; a vertex that starts no edge (the end of an open edge) is its own head.
#[derive(Debug, Default)]
pub(crate) struct Edges {
    points: Vec<DVec2>,
    head: Vec<u32>,
    ring: Vec<u32>,
    /// The edge's number within its operand, in the order given.
    source: Vec<u32>,
    rings: Vec<Ring>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring {
    pub(crate) operand: u32,
    /// The counter that its edges change; none for an open edge.
    pub(crate) counter: Option<u32>,
}

impl Edges {
    /// Reads the operands. Repeated points are dropped, and rings that have fewer than three others left.
    pub(crate) fn collect(&mut self, csg: &Csg<'_>, truth: &Truth) {
        self.points.clear();
        self.head.clear();
        self.ring.clear();
        self.source.clear();
        self.rings.clear();
        let leaves = csg.postfix().iter().filter(|token| !matches!(token, Token::Operator(..)));
        for (operand, leaf) in leaves.enumerate() {
            let counter = truth.counter(operand);
            match leaf {
                Token::Region(region) => self.add_rings(region.rings_of(), index(operand), counter),
                Token::Rings(rings, _) => self.add_rings(rings, index(operand), counter),
                Token::Edge(edge) => self.add_open_edge(*edge, index(operand)),
                Token::Operator(..) => {}
            }
        }
    }

    fn add_rings(&mut self, rings: &Rings, operand: u32, counter: Option<u32>) {
        let mut source = 0;
        for ring in rings.iter() {
            self.add_ring(ring, source, Ring { operand, counter });
            source += ring.len();
        }
    }

    fn add_ring(&mut self, ring: &[DVec2], source: usize, about: Ring) {
        let start = self.points.len();
        for (i, &point) in ring.iter().enumerate() {
            let next = if i + 1 == ring.len() { ring[0] } else { ring[i + 1] };
            if point != next {
                self.points.push(point);
                self.head.push(index(self.points.len()));
                self.source.push(index(source + i));
            }
        }
        if self.points.len() < start + 3 {
            self.points.truncate(start);
            self.head.truncate(start);
            self.source.truncate(start);
            return;
        }
        let end = self.points.len() - 1;
        self.head[end] = index(start);
        self.ring.resize(self.points.len(), index(self.rings.len()));
        self.rings.push(about);
    }

    fn add_open_edge(&mut self, edge: Segment, operand: u32) {
        let start = index(self.points.len());
        self.points.extend(edge);
        self.head.extend([start + 1, start + 1]);
        self.source.extend([0, 0]);
        self.ring.extend([index(self.rings.len()); 2]);
        self.rings.push(Ring { operand, counter: None });
    }

    /// The number of edges, and of explicit vertices.
    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.points.len()
    }

    #[inline]
    pub(crate) fn point(&self, vertex: u32) -> DVec2 {
        self.points[vertex as usize]
    }

    #[inline]
    pub(crate) fn head(&self, edge: u32) -> u32 {
        self.head[edge as usize]
    }

    /// Whether vertex `edge` starts an edge at all.
    #[inline]
    pub(crate) fn is_edge(&self, edge: u32) -> bool {
        self.head(edge) != edge
    }

    /// All edges, by id.
    pub(crate) fn ids(&self) -> impl Iterator<Item = u32> + Clone + '_ {
        (0..index(self.len())).filter(|&e| self.is_edge(e))
    }

    #[inline]
    pub(crate) fn segment(&self, edge: u32) -> Segment {
        [self.point(edge), self.point(self.head(edge))]
    }

    #[inline]
    pub(crate) fn ring_of(&self, edge: u32) -> u32 {
        self.ring[edge as usize]
    }

    #[inline]
    pub(crate) fn ring(&self, edge: u32) -> Ring {
        self.rings[self.ring[edge as usize] as usize]
    }

    pub(crate) fn rings(&self) -> &[Ring] {
        &self.rings
    }

    #[inline]
    pub(crate) fn source(&self, edge: u32) -> u32 {
        self.source[edge as usize]
    }
}
