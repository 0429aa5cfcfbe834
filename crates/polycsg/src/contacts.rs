//! Stage 3: where edges meet, exactly, sorted along each edge.
//!
//! Four orientation signs tell how two edges meet; everything else follows from them and from comparisons:
//!
//! ```text
//!  crossing          touch             shared end       overlap = two touches or shared ends
//!      \ f            f                  |f              ____f____
//!   ----x---- e   ----+---- e        e---+              e----+====+
//!        \
//! ```
//!
//! Each point where something meets is a node. A crossing is a node of its own, known as the pair of edges; an
//! explicit vertex becomes a node when anything touches it. A node has a contact on each edge that it lies inside of,
//! an explicit one also on the edge that starts there. Two crossings at one point always share an edge pairwise, so
//! that equality along each edge is all that is needed to unify them.

use crate::Error;
use crate::chains::Chains;
use crate::edges::Edges;
use crate::predicates::{
    Area, Clear, Parameter, Segment, Side, crossing_order, doubled_area, is_inside, lexicographic,
    point_crossing_order, side_of,
};
use crate::slabs::Slabs;
use crate::strips::Strips;
use crate::suspects::Suspects;
use crate::truth::index;
use crate::union_find::UnionFind;
use std::cmp::Ordering;

/// No edge, no node.
const NONE: u32 = u32::MAX;

/// How long boxes of chains are looked at before [`Slabs`] are built: up to so many pairs of edges for each edge and for
/// each node found, and up to so many blocks of boxes for each edge.
///
/// Where edges do cross, boxes are quicker: among many long edges in all directions about 4 pairs make a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patience {
    pub(crate) pairs: usize,
    pub(crate) pairs_per_edge: usize,
    pub(crate) pairs_per_node: usize,
    pub(crate) blocks_per_edge: usize,
    /// The most contacts to be found at all, counted as [`Csg::evaluate_within`](crate::Csg::evaluate_within) does.
    pub(crate) contacts: usize,
}

#[cfg(any(test, fuzzing))]
impl Patience {
    /// Slabs at once.
    pub(crate) const NONE: Patience =
        Patience { pairs: 0, pairs_per_edge: 0, pairs_per_node: 0, blocks_per_edge: 0, contacts: usize::MAX };
}

impl Default for Patience {
    fn default() -> Patience {
        Patience {
            pairs: 1000,
            pairs_per_edge: 12,
            pairs_per_node: 8,
            blocks_per_edge: 32,
            contacts: usize::MAX,
        }
    }
}

/// What meets an edge in a contact: a kind in the top bits, and the id of an edge or vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Partner(u32);

/// The kinds of [`Partner`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Met {
    /// An edge that crosses from the left to the right.
    FromLeft(u32),
    /// An edge that crosses from the right to the left.
    FromRight(u32),
    /// A vertex inside the edge.
    Vertex(u32),
    /// The edge's own start.
    Start,
}

impl Partner {
    const ID: u32 = (1 << 30) - 1;
    const FROM_RIGHT: u32 = 1 << 30;
    const VERTEX: u32 = 2 << 30;
    const START: Partner = Partner(3 << 30);

    fn crossing(edge: u32, from_left: bool) -> Partner {
        Partner(edge | if from_left { 0 } else { Partner::FROM_RIGHT })
    }

    pub(crate) fn vertex(vertex: u32) -> Partner {
        Partner(vertex | Partner::VERTEX)
    }

    #[inline]
    pub(crate) fn met(self) -> Met {
        let id = self.0 & Partner::ID;
        match self.0 >> 30 {
            0 => Met::FromLeft(id),
            1 => Met::FromRight(id),
            2 => Met::Vertex(id),
            _ => Met::Start,
        }
    }
}

/// A node on an edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    at: Parameter,
    pub(crate) edge: u32,
    pub(crate) node: u32,
    pub(crate) partner: Partner,
}

/// All contacts, sorted by edge and along it, and the nodes.
#[derive(Debug, Default)]
pub(crate) struct Contacts {
    found: Vec<Contact>,
    sorted: Vec<Contact>,
    starts: Vec<u32>,
    /// Per node the two edges that cross there, or a vertex and `NONE`.
    nodes: Vec<[u32; 2]>,
    classes: UnionFind,
    /// Per vertex its node; empty as long as no vertex has one.
    node_of_vertex: Vec<u32>,
    rings: UnionFind,
    /// Whether any two nodes lie in one point, or any node is a vertex.
    degenerate: bool,
}

impl Contacts {
    /// Finds the contacts of all pairs of edges: of those whose chains' boxes meet, or, where that turns out to be far
    /// more than what meets, of those that [`Slabs`] finds.
    ///
    /// # Errors
    /// [`Error::TooManyContacts`], by the limit that `patience` has.
    pub(crate) fn find(
        &mut self,
        edges: &Edges,
        chains: &Chains,
        strips: &Strips,
        slabs: &mut Slabs,
        suspects: &mut Suspects,
        patience: Patience,
    ) -> Result<(), Error> {
        let most = patience.contacts;
        self.start(edges, chains, suspects);
        let is_done = self.find_by_boxes(edges, chains, strips, suspects, patience);
        if !is_done && self.found.len() <= most {
            self.start(edges, chains, suspects);
            suspects.give_up();
            self.find_by_slabs(edges, chains, slabs, suspects, most)?;
        }
        if self.found.len() > most {
            return Err(Error::TooManyContacts { limit: most });
        }
        self.bucket(edges.len());
        self.sort(edges, suspects);
        Ok(())
    }

    fn start(&mut self, edges: &Edges, chains: &Chains, suspects: &mut Suspects) {
        self.found.clear();
        self.nodes.clear();
        self.classes.reset(0);
        self.node_of_vertex.clear();
        self.rings.reset(edges.rings().len());
        self.degenerate = false;
        suspects.start(chains.size());
    }

    /// Returns false, with some contacts found, when it would take too long or they are too many.
    fn find_by_boxes(
        &mut self,
        edges: &Edges,
        chains: &Chains,
        strips: &Strips,
        suspects: &mut Suspects,
        patience: Patience,
    ) -> bool {
        let Patience { pairs, pairs_per_edge, pairs_per_node, blocks_per_edge, contacts } = patience;
        let most = pairs + pairs_per_edge * edges.len();
        let mut met = 0;
        strips.pairs_within(pairs + blocks_per_edge * edges.len(), |a, b| {
            let (a, b) = (chains.chain(a), chains.chain(b));
            a.meet(b, edges.points(), |e, f| {
                met += 1;
                self.meet(edges, e.min(f), e.max(f), suspects);
            });
            met < most + pairs_per_node * self.nodes.len() && self.found.len() <= contacts
        })
    }

    fn find_by_slabs(
        &mut self,
        edges: &Edges,
        chains: &Chains,
        slabs: &mut Slabs,
        suspects: &mut Suspects,
        most: usize,
    ) -> Result<(), Error> {
        slabs.build(edges.points().iter().copied(), chains.edges().map(|edge| (edge, [edge, edge + 1])));
        for place in slabs.places() {
            let mut vertices = place.filter(|&slot| edges.ring(slot).end != slot);
            let first = vertices.next();
            vertices.for_each(|vertex| first.into_iter().for_each(|first| self.join(edges, first, vertex)));
        }
        slabs.copies().for_each(|[e, f]| self.meet(edges, e, f, suspects));
        let are_few = slabs.pairs_within(most, |e, f| {
            if self.found.len() <= most {
                self.meet(edges, e.min(f), e.max(f), suspects);
            }
        });
        if are_few { Ok(()) } else { Err(Error::TooManyContacts { limit: most }) }
    }

    /// The contacts by edge and in order along it, each node once on each edge.
    pub(crate) fn sorted(&self) -> &[Contact] {
        &self.sorted
    }

    pub(crate) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The one node that stands for all at its point.
    #[inline]
    pub(crate) fn node(&self, node: u32) -> u32 {
        self.classes.find(node)
    }

    /// The two edges that cross at a node that stands for all at its point, or a vertex there.
    #[inline]
    pub(crate) fn place(&self, node: u32) -> Place {
        match self.nodes[node as usize] {
            [vertex, NONE] => Place::Vertex(vertex),
            [e, f] => Place::Crossing(e, f),
        }
    }

    /// Whether there are nodes other than crossings of two edges.
    pub(crate) fn degenerate(&self) -> bool {
        self.degenerate
    }

    /// The node at a vertex, if it has one.
    pub(crate) fn node_at(&self, vertex: u32) -> Option<u32> {
        let node = self.node_of_vertex.get(vertex as usize).copied().filter(|&node| node != NONE)?;
        Some(self.node(node))
    }

    /// The connected component of a ring, named by one of its rings.
    pub(crate) fn component(&self, ring: u32) -> u32 {
        self.rings.find(ring)
    }

    #[inline]
    fn meet(&mut self, edges: &Edges, e: u32, f: u32, suspects: &mut Suspects) {
        let (s, t) = (edges.segment(e), edges.segment(f));
        if f == e + 1 && suspects.margins().are_steep([s, t], doubled_area(s[0], s[1], t[1])) {
            return; // neighbours that meet in their common end alone
        }
        let ends_of_f = [doubled_area(s[0], s[1], t[0]), doubled_area(s[0], s[1], t[1])];
        if suspects.margins().are_apart(s, ends_of_f) {
            return;
        }
        let ends_of_e = [doubled_area(t[0], t[1], s[0]), doubled_area(t[0], t[1], s[1])];
        match suspects.margins().relation([s, t], ends_of_f, ends_of_e) {
            Clear::Apart => {}
            Clear::CrossFromLeft => self.cross(edges, [e, f], ends_of_f, ends_of_e, true),
            Clear::CrossFromRight => self.cross(edges, [e, f], ends_of_f, ends_of_e, false),
            Clear::Unclear => self.meet_closely(edges, [e, f], ends_of_f, ends_of_e, suspects),
        }
    }

    fn cross(
        &mut self,
        edges: &Edges,
        [e, f]: [u32; 2],
        ends_of_f: [Area; 2],
        ends_of_e: [Area; 2],
        from_left: bool,
    ) {
        let node = self.classes.push();
        self.nodes.push([e, f]);
        let at = Parameter::of_crossing(ends_of_e[0], ends_of_e[1]);
        self.found.push(Contact { at, edge: e, node, partner: Partner::crossing(f, from_left) });
        // Seen along f, e comes from the other side.
        let at = Parameter::of_crossing(ends_of_f[0], ends_of_f[1]);
        self.found.push(Contact { at, edge: f, node, partner: Partner::crossing(e, !from_left) });
        self.rings.join(edges.ring_of(e), edges.ring_of(f));
    }

    /// As [`meet`](Contacts::meet), for edges that are not clear of one another or have an end in common.
    fn meet_closely(
        &mut self,
        edges: &Edges,
        [e, f]: [u32; 2],
        ends_of_f: [Area; 2],
        ends_of_e: [Area; 2],
        suspects: &mut Suspects,
    ) {
        let (s, t) = (edges.segment(e), edges.segment(f));
        if let Some(corner) = Corner::of(s, t) {
            let area = doubled_area(corner.common, corner.end_of_s, corner.end_of_t);
            if side_of(area, corner.common, corner.end_of_s, corner.end_of_t) != Side::On
                || corner.is_straight()
            {
                return self.share(edges, [e, f], &corner, area, suspects);
            }
        }
        let sides_of = |line: Segment, areas: [Area; 2], ends: Segment| {
            [0, 1].map(|i| side_of(areas[i], line[0], line[1], ends[i]))
        };
        let ([p0, p1], [q0, q1]) = (sides_of(s, ends_of_f, t), sides_of(t, ends_of_e, s));
        let on_one_side = |a: Side, b: Side| a == b && a != Side::On;
        if on_one_side(p0, p1) || on_one_side(q0, q1) {
            return suspects.add(e, f);
        }
        if ![p0, p1, q0, q1].contains(&Side::On) {
            suspects.add(e, f);
            return self.cross(edges, [e, f], ends_of_f, ends_of_e, p0 == Side::Left);
        }
        self.touch(edges, [e, f], [p0, p1, q0, q1]);
        let line_up = [p0, p1, q0, q1] == [Side::On; 4];
        let steep =
            ends_of_f.iter().chain(&ends_of_e).any(|&area| suspects.margins().are_steep([s, t], area));
        if !line_up && !steep {
            suspects.add(e, f);
        }
    }

    /// Two edges that have an end in common, and nothing else.
    fn share(
        &mut self,
        edges: &Edges,
        [e, f]: [u32; 2],
        corner: &Corner,
        area: Area,
        suspects: &mut Suspects,
    ) {
        let (s, t) = (edges.segment(e), edges.segment(f));
        if !corner.is_straight() && !suspects.margins().are_steep([s, t], area) {
            suspects.add(e, f);
        }
        let v = if s[0] == corner.common { e } else { edges.head(e) };
        let w = if t[0] == corner.common { f } else { edges.head(f) };
        if v != w {
            self.join(edges, v, w);
        }
    }

    /// Contacts at ends: `sides` are those of f's ends against e and of e's ends against f.
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
            self.found.push(Contact { at, edge, node, partner: Partner::vertex(vertex) });
            self.rings.join(edges.ring_of(edge), edges.ring_of(vertex));
        }
    }

    /// Makes two vertices at one point one node.
    fn join(&mut self, edges: &Edges, v: u32, w: u32) {
        let (a, b) = (self.make_node(edges, v), self.make_node(edges, w));
        self.classes.join(a, b);
        self.rings.join(edges.ring_of(v), edges.ring_of(w));
    }

    fn make_node(&mut self, edges: &Edges, vertex: u32) -> u32 {
        if !self.degenerate {
            self.degenerate = true;
            self.node_of_vertex.resize(edges.len(), NONE);
        }
        if self.node_of_vertex[vertex as usize] == NONE {
            let node = self.classes.push();
            self.node_of_vertex[vertex as usize] = node;
            self.nodes.push([vertex, NONE]);
            self.found.push(Contact { at: Parameter::START, edge: vertex, node, partner: Partner::START });
        }
        self.node_of_vertex[vertex as usize]
    }

    /// Moves the contacts near their edges' places (a counting sort by some leading bits of the edge).
    fn bucket(&mut self, edge_count: usize) {
        let shift = (edge_count / (self.found.len() + 1)).max(1).ilog2();
        self.starts.clear();
        self.starts.resize((edge_count >> shift) + 3, 0);
        for contact in &self.found {
            self.starts[(contact.edge >> shift) as usize + 2] += 1;
        }
        for bucket in 2..self.starts.len() {
            self.starts[bucket] += self.starts[bucket - 1];
        }
        self.sorted.clear();
        self.sorted.resize(self.found.len(), Contact::NOWHERE);
        for &contact in &self.found {
            let at = &mut self.starts[(contact.edge >> shift) as usize + 1];
            self.sorted[*at as usize] = contact;
            *at += 1;
        }
        self.starts.pop();
    }

    fn sort(&mut self, edges: &Edges, suspects: &mut Suspects) {
        let mut start = 0;
        for i in 1..self.starts.len() {
            let end = self.starts[i] as usize;
            if end > start + 1 {
                self.sorted[start..end].sort_unstable_by(|a, b| order(edges, a, b));
            }
            start = end;
        }
        self.unify(edges, suspects);
        self.prefer_vertices();
    }

    /// Unifies what lies in one place of an edge.
    fn unify(&mut self, edges: &Edges, suspects: &mut Suspects) {
        let mut kept = 0;
        for i in 0..self.sorted.len() {
            let contact = self.sorted[i];
            let same = kept > 0 && order(edges, &self.sorted[kept - 1], &contact) == Ordering::Equal;
            if same {
                self.degenerate = true;
                self.classes.join(self.sorted[kept - 1].node, contact.node);
            } else {
                self.sorted[kept] = contact;
                kept += 1;
            }
        }
        self.sorted.truncate(kept);
        for on_edge in self.sorted.chunk_by(|a, b| a.edge == b.edge) {
            suspects.look_along(edges, on_edge);
        }
    }

    /// Lets a vertex, where there is one, tell the place of a node.
    fn prefer_vertices(&mut self) {
        if !self.degenerate {
            return;
        }
        for node in 0..self.nodes.len() {
            let stands = self.classes.find(index(node)) as usize;
            if self.nodes[node][1] == NONE && self.nodes[stands][1] != NONE {
                self.nodes[stands] = self.nodes[node];
            }
        }
    }
}

/// Where a node is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Place {
    Vertex(u32),
    Crossing(u32, u32),
}

impl Contact {
    const NOWHERE: Contact =
        Contact { at: Parameter::START, edge: NONE, node: NONE, partner: Partner::START };

    #[inline]
    pub(crate) fn at(&self) -> Parameter {
        self.at
    }
}

/// Two edges with one end in common.
struct Corner {
    common: glam::DVec2,
    end_of_s: glam::DVec2,
    end_of_t: glam::DVec2,
}

impl Corner {
    fn of(s: Segment, t: Segment) -> Option<Corner> {
        let corner = |i: usize, j: usize| Corner { common: s[i], end_of_s: s[1 - i], end_of_t: t[1 - j] };
        let mut corners = [(1, 0), (0, 1), (0, 0), (1, 1)]
            .into_iter()
            .filter(|&(i, j)| s[i] == t[j])
            .map(|(i, j)| corner(i, j));
        let first = corners.next()?;
        corners.next().is_none().then_some(first)
    }

    /// Whether the other ends lie in opposite quadrants from the common one: then the edges do not overlap, and are
    /// not flat to one another.
    fn is_straight(&self) -> bool {
        let opposite = |a: f64, c: f64, b: f64| (a <= c && c <= b) || (b <= c && c <= a);
        let (c, p, q) = (self.common, self.end_of_s, self.end_of_t);
        opposite(p.x, c.x, q.x) && opposite(p.y, c.y, q.y)
    }
}

/// The order of two contacts by edge and along it: by the parameters where their bounds allow, else exactly.
#[inline]
fn order(edges: &Edges, a: &Contact, b: &Contact) -> Ordering {
    if a.edge != b.edge {
        return a.edge.cmp(&b.edge);
    }
    a.at.certain_order(b.at).unwrap_or_else(|| order_exactly(edges, a, b))
}

#[cold]
fn order_exactly(edges: &Edges, a: &Contact, b: &Contact) -> Ordering {
    let e = edges.segment(a.edge);
    match (a.partner.met(), b.partner.met()) {
        (Met::Start, Met::Start) => Ordering::Equal,
        (Met::Start, _) => Ordering::Less,
        (_, Met::Start) => Ordering::Greater,
        (Met::Vertex(v), Met::Vertex(w)) => {
            let order = lexicographic(edges.point(v), edges.point(w));
            if lexicographic(e[0], e[1]) == Ordering::Less { order } else { order.reverse() }
        }
        (Met::Vertex(v), Met::FromLeft(g) | Met::FromRight(g)) => {
            point_crossing_order(e, edges.point(v), edges.segment(g))
        }
        (Met::FromLeft(g) | Met::FromRight(g), Met::Vertex(v)) => {
            point_crossing_order(e, edges.point(v), edges.segment(g)).reverse()
        }
        (Met::FromLeft(f) | Met::FromRight(f), Met::FromLeft(g) | Met::FromRight(g)) => {
            crossing_order(e, edges.segment(f), edges.segment(g))
        }
    }
}
