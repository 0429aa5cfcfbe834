//! Stage 4: the arrangement, which is the rings cut into sub-edges at the nodes, and the half-edges around each junction.
//!
//! ```text
//!            h1                  A sub-edge runs along one ring from one contact to the next; sub-edge i starts in contact i.
//!             |   h0             Half-edges leave their node: half-edge 2a runs along sub-edge a, 2a + 1 against it.
//!             |  /               The sector between h[k] and h[k + 1], counter-clockwise, lies to the left of h[k]
//!     h2 -----v                  and to the right of h[k + 1]. Sorted by angle from just above straight down, so that
//!              \                 at the lexicographically smallest point of a component the outer sector lies right
//!               h3               of h[0].
//! ```
//!
//! The end of an open ring counts as one more sub-edge, which has no half-edges.
//!
//! A node where just two edges cross needs no list: the two sub-edges that start there tell everything. All other nodes are
//! junctions. Overlapping sub-edges leave a junction in one direction. The one with the smallest id is their representative:
//! only this one is walked and labelled.

mod junctions;
pub(crate) mod labels;

use crate::base::meter::{Meter, Refusal};
use crate::base::parts::Numbered;
use crate::base::{id::index, threads::Threads};
use crate::contacts::contact::{Contact, Partner, PartnerKind};
use crate::contacts::{Contacts, Place};
use crate::edges::Edges;
use crate::predicates::{Compass, Segment, Side, lexicographic, turn};
use std::{cmp::Ordering, ops::Range};

/// No sub-edge, no node.
const NONE: u32 = u32::MAX;

/// What is found at a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Node {
    /// Two edges cross: the other of the two sub-edges that start there.
    Crossing(u32),
    /// Anything else, by its number.
    Junction(u32),
}

/// See the module's page.
#[derive(Debug, Default)]
pub(crate) struct Arrangement {
    sub_edges: Vec<SubEdge>,
    /// Per ring its first sub-edge.
    first: Vec<u32>,
    /// Per node the two sub-edges that start there, or `NONE` and a junction.
    starting: Vec<[u32; 2]>,
    /// Per junction where its half-edges start in `around`.
    starts: Vec<u32>,
    around: Vec<u32>,
    /// Per sub-edge its representative and the next that coincides; empty where none do.
    representatives: Vec<u32>,
    next: Vec<u32>,
    /// The half-edges that leave one junction, each behind its [`Compass`] in the higher bits.
    leaving: Vec<u64>,
}

/// Where a sub-edge starts.
#[derive(Clone, Copy, Debug)]
struct SubEdge {
    edge: u32,
    node: u32,
    partner: Partner,
}

impl SubEdge {
    /// How many half-edges of its ring there are where it starts.
    fn half_edges(self) -> u32 {
        if matches!(self.partner.kind(), PartnerKind::First | PartnerKind::End) { 1 } else { 2 }
    }
}

impl Arrangement {
    /// Cuts all rings at their contacts.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn split(
        &mut self,
        edges: &Edges,
        contacts: &Contacts,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.cut(edges, contacts, meter)?;
        self.find_starting(contacts, meter)?;
        self.gather(edges, meter)?;
        debug_assert!(self.check(edges));
        Ok(())
    }

    fn cut(&mut self, edges: &Edges, contacts: &Contacts, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.sub_edges.clear();
        let sub_edge = |&Contact { edge, node, partner, .. }: &Contact| SubEdge {
            edge,
            node: contacts.node(node),
            partner,
        };
        let threads = Threads::for_edges(edges.len());
        threads.list(contacts.sorted().len(), &mut self.sub_edges, |part, sub_edges| {
            meter.extend(sub_edges, contacts.sorted()[part].iter().map(sub_edge))
        })?;
        self.first.clear();
        let mut sub_edge = 0;
        meter.for_each(edges.rings(), |ring| {
            self.first.push(index(sub_edge));
            let end = ring.end + u32::from(ring.is_open);
            sub_edge += self.sub_edges[sub_edge..].partition_point(|sub_edge| sub_edge.edge < end);
        })?;
        self.first.push(index(sub_edge));
        Ok(())
    }

    /// Finds the sub-edges that start in each node, and counts them where that is a junction.
    fn find_starting(&mut self, contacts: &Contacts, meter: &Meter<'_>) -> Result<(), Refusal> {
        let junctions = self.number_junctions(contacts, meter)?;
        self.starts.clear();
        self.starts.resize(junctions + 2, 0);
        meter.for_each(Numbered(&self.sub_edges), |(i, sub_edge)| {
            let starting = &mut self.starting[sub_edge.node as usize];
            match *starting {
                [NONE, NONE] => starting[0] = i,
                [NONE, junction] => self.starts[junction as usize + 2] += sub_edge.half_edges(),
                [_, _] => starting[1] = i,
            }
        })?;
        for junction in 2..self.starts.len() {
            self.starts[junction] += self.starts[junction - 1];
        }
        Ok(())
    }

    /// Numbers the nodes that are vertices or several crossings in one point; returns how many there are.
    fn number_junctions(&mut self, contacts: &Contacts, meter: &Meter<'_>) -> Result<usize, Refusal> {
        meter.fill(&mut self.starting, [NONE; 2], contacts.node_count())?;
        if !contacts.degenerate() {
            return Ok(0);
        }
        meter.for_each(0..index(contacts.node_count()), |node| {
            let representative = contacts.node(node);
            if representative != node || matches!(contacts.place(node), Place::Vertex(_)) {
                self.starting[representative as usize][1] = 0;
            }
        })?;
        let junctions = self.starting.iter_mut().filter(|starting| starting[1] != NONE);
        Ok((0..).zip(junctions).map(|(junction, starting)| starting[1] = junction).count())
    }

    pub(crate) fn len(&self) -> usize {
        self.sub_edges.len()
    }

    /// The sub-edges of a ring; none if nothing meets it.
    #[inline]
    pub(crate) fn of_ring(&self, ring: u32) -> Range<u32> {
        self.first[ring as usize]..self.first[ring as usize + 1]
    }

    /// The sub-edge that starts where this one ends.
    #[inline]
    pub(crate) fn following(&self, edges: &Edges, sub_edge: u32) -> u32 {
        let ring = edges.ring_of(self.edge(sub_edge));
        if sub_edge + 1 == self.first[ring as usize + 1] { self.first[ring as usize] } else { sub_edge + 1 }
    }

    /// The sub-edge that ends where this one starts.
    #[inline]
    pub(crate) fn previous(&self, edges: &Edges, sub_edge: u32) -> u32 {
        let ring = edges.ring_of(self.edge(sub_edge));
        if sub_edge == self.first[ring as usize] { self.first[ring as usize + 1] - 1 } else { sub_edge - 1 }
    }

    /// The edge on which a sub-edge starts.
    #[inline]
    pub(crate) fn edge(&self, sub_edge: u32) -> u32 {
        self.sub_edges[sub_edge as usize].edge
    }

    /// The node in which a sub-edge starts.
    #[inline]
    pub(crate) fn node(&self, sub_edge: u32) -> u32 {
        self.sub_edges[sub_edge as usize].node
    }

    /// Whether a sub-edge starts in the start of its edge.
    #[inline]
    pub(crate) fn starts_edge(&self, sub_edge: u32) -> bool {
        self.sub_edges[sub_edge as usize].partner.is_end()
    }

    /// Whether the edge that crosses where a sub-edge starts comes from the left.
    #[inline]
    pub(crate) fn crossed_from_left(&self, sub_edge: u32) -> bool {
        matches!(self.sub_edges[sub_edge as usize].partner.kind(), PartnerKind::FromLeft(_))
    }

    /// What is found where a sub-edge starts.
    #[inline]
    pub(crate) fn met(&self, sub_edge: u32) -> Node {
        match self.starting[self.node(sub_edge) as usize] {
            [NONE, junction] => Node::Junction(junction),
            [a, b] => Node::Crossing(if a == sub_edge { b } else { a }),
        }
    }

    /// What is found at a node, and one of the sub-edges that start there.
    pub(crate) fn junction_at(&self, node: u32) -> Option<u32> {
        match self.starting[node as usize] {
            [NONE, junction] => Some(junction),
            _ => None,
        }
    }

    pub(crate) fn junction_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The sub-edge that contains a vertex of a ring, or starts in it: the last that starts at or before it.
    pub(crate) fn sub_edge_at(&self, edges: &Edges, vertex: u32) -> Option<u32> {
        let sub_edges = self.of_ring(edges.ring_of(vertex));
        let after = |sub_edge: u32| {
            self.edge(sub_edge) > vertex || (self.edge(sub_edge) == vertex && !self.starts_edge(sub_edge))
        };
        self.last_before(sub_edges, after)
    }

    /// Of a ring's sub-edges the last before the first for which `after` holds, going round.
    pub(crate) fn last_before(&self, sub_edges: Range<u32>, after: impl Fn(u32) -> bool) -> Option<u32> {
        let slice = &self.sub_edges[sub_edges.start as usize..sub_edges.end as usize];
        let mut low = 0;
        let mut high = slice.len();
        while low < high {
            let middle = (low + high) / 2;
            if after(sub_edges.start + index(middle)) { high = middle } else { low = middle + 1 }
        }
        if slice.is_empty() {
            None
        } else {
            Some(if low == 0 { sub_edges.end - 1 } else { sub_edges.start + index(low) - 1 })
        }
    }

    /// Whether any sub-edges overlap.
    #[inline]
    pub(crate) fn overlaps(&self) -> bool {
        !self.next.is_empty()
    }

    /// The representative of all sub-edges that overlap this one.
    #[inline]
    pub(crate) fn representative(&self, sub_edge: u32) -> u32 {
        self.representatives.get(sub_edge as usize).copied().unwrap_or(sub_edge)
    }

    /// A representative, and all that overlap it.
    #[inline]
    pub(crate) fn overlapping(&self, sub_edge: u32) -> impl Iterator<Item = u32> + '_ {
        let next = |&a: &u32| self.next.get(a as usize).copied().filter(|&n| n != NONE);
        std::iter::successors(Some(sub_edge), next)
    }

    /// Whether one of several overlapping sub-edges runs in the direction of another: whether they start in one node or, for
    /// loops, leave it in one direction.
    #[inline]
    pub(crate) fn is_along(&self, edges: &Edges, sub_edge: u32, other: u32) -> bool {
        sub_edge == other || {
            let forward = |sub_edge: u32| {
                let [a, b] = self.direction(edges, 2 * sub_edge);
                lexicographic(a, b) == Ordering::Less
            };
            forward(sub_edge) == forward(other)
        }
    }

    /// The places in [`around`](Arrangement::around) of a junction's half-edges.
    #[inline]
    pub(crate) fn span(&self, junction: u32) -> Range<u32> {
        self.starts[junction as usize]..self.starts[junction as usize + 1]
    }

    #[inline]
    pub(crate) fn around(&self, place: u32) -> u32 {
        self.around[place as usize]
    }

    /// The edge along which a half-edge leaves its node, directed as it.
    #[inline]
    pub(crate) fn direction(&self, edges: &Edges, half_edge: u32) -> Segment {
        let sub_edge = half_edge >> 1;
        if half_edge & 1 == 0 {
            return edges.segment(self.edge(sub_edge));
        }
        let end = self.following(edges, sub_edge);
        let edge = self.edge(end);
        let edge = if self.starts_edge(end) { edges.ring(edge).previous(edge) } else { edge };
        let [a, b] = edges.segment(edge);
        [b, a]
    }

    /// The laws: sub-edges of a crossing know one another, and angles increase around each junction.
    fn check(&self, edges: &Edges) -> bool {
        let crossings = (0..index(self.len())).all(|sub_edge| match self.met(sub_edge) {
            Node::Crossing(other) => other != NONE && self.met(other) == Node::Crossing(sub_edge),
            Node::Junction(_) => true,
        });
        let junctions = (0..index(self.junction_count())).all(|junction| {
            let directions: Vec<Segment> =
                self.span(junction).map(|place| self.direction(edges, self.around(place))).collect();
            let order = |g: Segment, h: Segment| Compass::of(g).cmp(&Compass::of(h)).then(by_turn(g, h));
            directions.windows(2).all(|pair| order(pair[0], pair[1]) != Ordering::Greater)
        });
        crossings && junctions
    }
}

/// The order counter-clockwise of two directions within a quadrant.
#[inline]
fn by_turn(g: Segment, h: Segment) -> Ordering {
    match turn(g, h) {
        Side::Left => Ordering::Less,
        Side::On => Ordering::Equal,
        Side::Right => Ordering::Greater,
    }
}
