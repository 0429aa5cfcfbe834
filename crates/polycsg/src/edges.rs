//! Stage 1: all operands' rings as one array of directed edges.

use crate::csg::{Csg, Token};
use crate::predicates::{Segment, lexicographic, rightward};
use crate::rings::Rings;
use crate::truth::{Truth, index};
use glam::DVec2;
use std::cmp::Ordering;

/// Edges and explicit vertices under one numbering: edge `e` starts in vertex `e`.
///
/// The rings lie one after the other; a vertex that starts no edge (the end of an open edge) is its own head.
#[derive(Debug, Default)]
pub(crate) struct Edges {
    points: Vec<DVec2>,
    head: Vec<u32>,
    ring: Vec<u32>,
    /// The counter that the edge changes, or none.
    counter: Vec<u32>,
    /// The edge's number within its operand, in the order given.
    source: Vec<u32>,
    rings: Vec<Ring>,
    /// The next edge with the same ends, per edge; empty when there is none at all.
    next_same: Vec<u32>,
    follows: Vec<bool>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring {
    pub(crate) operand: u32,
    /// The counter that its edges change; none for an open edge.
    counter: Option<u32>,
}

/// The counter of an open edge.
const NO_COUNTER: u32 = u32::MAX;

/// No further edge.
const END: u32 = u32::MAX;

/// Up to so many rings keep their order; more are sorted so that what lies close in the plane lies close in memory.
const FEW_RINGS: usize = 64;

/// A ring by its first point.
struct Place {
    point: DVec2,
    operand: u32,
    ring: u32,
}

impl Place {
    fn of_all(rings: &Rings, operand: usize) -> impl Iterator<Item = Place> + '_ {
        let place = move |(i, ring): (usize, &[DVec2])| {
            ring.first().map(|&point| Place { point, operand: index(operand), ring: index(i) })
        };
        rings.iter().enumerate().filter_map(place)
    }
}

/// Sorts by columns of about as many rings as there are columns, up and down in turn.
fn sort_by_place(places: &mut [Place]) {
    places.sort_unstable_by(|a, b| {
        a.point.x.total_cmp(&b.point.x).then((a.operand, a.ring).cmp(&(b.operand, b.ring)))
    });
    let column = places.len().isqrt().max(1);
    for (i, places) in places.chunks_mut(column).enumerate() {
        places.sort_unstable_by(|a, b| {
            let upward = a.point.y.total_cmp(&b.point.y).then((a.operand, a.ring).cmp(&(b.operand, b.ring)));
            if i % 2 == 0 { upward } else { upward.reverse() }
        });
    }
}

impl Edges {
    /// Reads the operands. Repeated points are dropped, and rings that have fewer than three others left.
    pub(crate) fn collect(&mut self, csg: &Csg<'_>, truth: &Truth) {
        self.clear();
        let leaves = csg.postfix().iter().filter(|token| !matches!(token, Token::Operator(..)));
        let rings = leaves.clone().map(|leaf| leaf.rings().map_or(0, Rings::len)).sum::<usize>();
        let scattered = rings > FEW_RINGS;
        let mut places = Vec::new();
        for (operand, leaf) in leaves.clone().enumerate() {
            match (leaf, leaf.rings()) {
                (Token::Edge(edge), _) => self.add_open_edge(*edge, index(operand)),
                (_, Some(rings)) if scattered => places.extend(Place::of_all(rings, operand)),
                (_, Some(rings)) => self.add_rings(rings, index(operand), truth.counter(operand)),
                _ => {}
            }
        }
        if scattered {
            let leaves: Vec<Option<&Rings>> = leaves.map(Token::rings).collect();
            sort_by_place(&mut places);
            for place in places {
                let about = Ring { operand: place.operand, counter: truth.counter(place.operand as usize) };
                if let Some(rings) = leaves[place.operand as usize] {
                    self.add_ring(rings.ring(place.ring as usize), rings.start(place.ring as usize), about);
                }
            }
        }
    }

    fn clear(&mut self) {
        self.points.clear();
        self.head.clear();
        self.ring.clear();
        self.source.clear();
        self.counter.clear();
        self.rings.clear();
        self.next_same.clear();
        self.follows.clear();
    }

    fn add_rings(&mut self, rings: &Rings, operand: u32, counter: Option<u32>) {
        for (i, ring) in rings.iter().enumerate() {
            self.add_ring(ring, rings.start(i), Ring { operand, counter });
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
        self.counter.resize(self.points.len(), about.counter.unwrap_or(NO_COUNTER));
        self.rings.push(about);
    }

    fn add_open_edge(&mut self, edge: Segment, operand: u32) {
        let start = index(self.points.len());
        self.points.extend(edge);
        self.head.extend([start + 1, start + 1]);
        self.source.extend([0, 0]);
        self.ring.extend([index(self.rings.len()); 2]);
        self.counter.extend([NO_COUNTER; 2]);
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

    /// The order of two edges by their ends, whatever their directions.
    pub(crate) fn compare(&self, e: u32, f: u32) -> Ordering {
        let (s, t) = (rightward(self.segment(e)), rightward(self.segment(f)));
        lexicographic(s[0], t[0]).then_with(|| lexicographic(s[1], t[1]))
    }

    /// Lets the first edge of each pair stand for the second too, which has the same ends.
    pub(crate) fn unite(&mut self, same: &[[u32; 2]]) {
        self.next_same.resize(if same.is_empty() { 0 } else { self.len() }, END);
        for &[stands, follows] in same {
            self.next_same[follows as usize] = self.next_same[stands as usize];
            self.next_same[stands as usize] = follows;
        }
        self.follows.clear();
        self.follows.resize(self.next_same.len(), false);
        same.iter().for_each(|&[_, follows]| self.follows[follows as usize] = true);
    }

    /// Whether another edge stands for this one.
    pub(crate) fn follows(&self, edge: u32) -> bool {
        self.follows.get(edge as usize).is_some_and(|&follows| follows)
    }

    /// Whether two edges with the same ends have the same direction.
    pub(crate) fn is_along(&self, e: u32, f: u32) -> bool {
        self.point(e) == self.point(f)
    }

    /// An edge that stands for itself, and all that have the same ends.
    #[inline]
    fn same(&self, edge: u32) -> impl Iterator<Item = u32> + '_ {
        let next = |&e: &u32| self.next_same.get(e as usize).copied().filter(|&n| n != END);
        std::iter::successors(Some(edge), next)
    }

    /// Moves the walk from the right of an edge, and of all that it stands for, to the left; or, against the edge, back.
    #[inline]
    pub(crate) fn cross(&self, edge: u32, along: bool, truth: &mut Truth) {
        for other in self.same(edge) {
            let counter = self.counter[other as usize];
            if counter != NO_COUNTER {
                let other_along = along == (other == edge || self.is_along(other, edge));
                truth.cross(counter, if other_along { 1 } else { -1 });
            }
        }
    }

    #[inline]
    pub(crate) fn source(&self, edge: u32) -> u32 {
        self.source[edge as usize]
    }
}
