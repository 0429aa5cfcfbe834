//! Stage 7: makes the rounded pieces meet in shared points only.
//!
//! Rounding moves crossings by half an ulp, which may carry a vertex over a piece, or a piece onto another. Where that
//! happened, both pieces are cut at the *exact* abscissae of each other's ends and the cut points are rounded:
//!
//! ```text
//!   exact              rounded: they cross       cut at a, b; rounded again
//!   ----__             -------                   ------+---+
//!     a   ---b           \/                            a   b     weakly ordered on each vertical, so no crossing
//!   --------             -/\----                 ------+---+
//! ```
//!
//! Why this ends, and ends well. Exactly, pieces meet only in common vertices, so between two cuts at equal abscissae
//! two fragments keep one order; rounding each coordinate to nearest is monotone, so they keep it weakly at both
//! ends: they may share ends or coincide, never cross. When two fragments still conflict, some end of one lies
//! strictly inside the abscissae of the other, so a cut is added; there are finitely many (piece, vertex) pairs.
//! Only fragments that rounding made vertical escape this argument: they can overlap on their one abscissa, and are cut
//! at the points that lie on them, which moves nothing.

use crate::contacts::{Contacts, Place};
use crate::edges::Edges;
use crate::outline::Outline;
use crate::predicates::{Ratio, Segment, Side, crossing_ratio, is_inside, lexicographic, rightward, side};
use crate::select::{End, Piece, Selection};
use crate::slabs::Slabs;
use crate::suspects::Suspects;
use crate::truth::index;
use glam::DVec2;
use std::cmp::Ordering;
use std::ops::Range;

/// An exact abscissa: that of a vertex.
#[derive(Clone, Debug)]
struct Abscissa {
    vertex: u32,
    rounded: f64,
}

/// A part of one edge between neighbouring vertices of the boundary, in the boundary's direction. Vertices are slots,
/// or nodes counted behind the slots.
#[derive(Clone, Copy, Debug)]
struct Part {
    start: u32,
    end: u32,
    edge: u32,
}

/// A piece of a part between neighbouring cuts, rounded.
#[derive(Clone, Copy, Debug)]
struct Fragment {
    segment: Segment,
    part: u32,
    edge: u32,
    /// The vertices whose abscissae its ends have.
    ends: [u32; 2],
    /// Whether an end is a rounded point.
    moved: bool,
}

/// A cut of a part at a vertex's abscissa.
type CutAt = (u32, u32);

/// Fragments with the same ends, as a span of `alike`, and whether any has a rounded end.
#[derive(Clone, Debug)]
struct Class {
    members: Range<usize>,
    moved: bool,
}

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct Mending {
    parts: Vec<Part>,
    fragments: Vec<Fragment>,
    /// The fragments that are not empty, by their ends, and the spans of those with the same ends.
    alike: Vec<u32>,
    classes: Vec<Class>,
    /// Pairs of classes.
    conflicts: Vec<[u32; 2]>,
    /// The cuts, sorted by part.
    cuts: Vec<CutAt>,
    /// The suspected edges, sorted.
    edges: Vec<u32>,
    /// How many vertices were put into edges since the count was set to 0.
    pub(crate) mended: usize,
}

/// What the stage looks at.
#[derive(Clone, Copy)]
pub(crate) struct Rounded<'a> {
    pub(crate) edges: &'a Edges,
    pub(crate) contacts: &'a Contacts,
    pub(crate) selection: &'a Selection,
}

/// Whether rounding left every piece where it was, as seen from the others: of the suspected pairs of edges, which are
/// the only ones that can, no two fragments meet but in a vertex of both.
pub(crate) fn is_sound(
    rounded: Rounded<'_>,
    suspects: &Suspects,
    slabs: &mut Slabs,
    mending: &mut Mending,
) -> bool {
    if suspects.all() {
        return rounded.is_sound_throughout(slabs, mending);
    }
    let sound = suspects.pairs().is_empty() || are_all_sound(rounded, suspects, mending);
    debug_assert!(!sound || rounded.is_sound_throughout(slabs, mending));
    sound
}

fn are_all_sound(rounded: Rounded<'_>, suspects: &Suspects, mending: &mut Mending) -> bool {
    mending.edges.clear();
    mending.edges.extend(suspects.pairs().iter().flatten());
    mending.edges.sort_unstable();
    mending.edges.dedup();
    rounded.list_parts(Some(&mending.edges), &mut mending.parts);
    mending.parts.sort_unstable_by_key(|part| part.edge);
    rounded.cut_up(&mending.parts, &[], &mut mending.fragments);
    let fragments = &mending.fragments;
    let of_edge = |edge: u32| {
        let start = fragments.partition_point(|f| f.edge < edge);
        let count = fragments[start..].partition_point(|f| f.edge == edge);
        &fragments[start..start + count]
    };
    let collapsed = fragments.iter().any(|f| f.segment[0] == f.segment[1]);
    let sound = |&[e, f]: &[u32; 2]| {
        of_edge(e).iter().all(|f0| of_edge(f).iter().all(|f1| !(f0.moved || f1.moved) || are_sound(f0, f1)))
    };
    !collapsed && suspects.pairs().iter().all(sound)
}

/// Whether two fragments of different edges meet in common vertices only.
fn are_sound(f: &Fragment, g: &Fragment) -> bool {
    let same_point = |i: usize, j: usize| f.segment[i] == g.segment[j];
    let same_vertex = |i: usize, j: usize| f.ends[i] == g.ends[j];
    let ends_agree =
        [(0, 0), (0, 1), (1, 0), (1, 1)].iter().all(|&(i, j)| same_point(i, j) == same_vertex(i, j));
    let common_ends = g.segment.iter().filter(|p| f.segment.contains(p)).count();
    ends_agree && common_ends < 2 && !in_conflict([f.segment, g.segment])
}

/// Puts the pieces into an outline: no two of its edges meet but in their ends.
pub(crate) fn mend(rounded: Rounded<'_>, slabs: &mut Slabs, mending: &mut Mending, outline: &mut Outline) {
    mending.cuts.clear();
    rounded.list_parts(None, &mut mending.parts);
    loop {
        rounded.cut_up(&mending.parts, &mending.cuts, &mut mending.fragments);
        mending.find_conflicts(slabs);
        mending.mended = mending.cuts.len();
        if mending.conflicts.is_empty() {
            let may_coincide = mending.classes.len() < mending.alike.len();
            return outline.build(mending.fragments.iter().map(|f| f.segment), may_coincide);
        }
        if !rounded.add_cuts(mending) {
            let segments = cut_verticals(&mending.fragments);
            mending.mended += segments.len() - mending.fragments.len();
            return outline.build(segments.iter().copied(), true);
        }
    }
}

impl Mending {
    /// Groups the fragments with the same ends; those that rounding shrank to a point are left out.
    ///
    /// Where hundreds of edges pass through nearly one point, most fragments there are alike.
    fn find_alike(&mut self) {
        let Mending { fragments, alike, classes, .. } = self;
        alike.clear();
        alike.extend((0..index(fragments.len())).filter(|&i| {
            let [a, b] = fragments[i as usize].segment;
            a != b
        }));
        let compare = |i: u32, j: u32| {
            let (s, t) = (rightward(fragments[i as usize].segment), rightward(fragments[j as usize].segment));
            lexicographic(s[0], t[0]).then_with(|| lexicographic(s[1], t[1]))
        };
        alike.sort_unstable_by(|&i, &j| compare(i, j).then(i.cmp(&j)));
        classes.clear();
        let mut start = 0;
        for class in alike.chunk_by(|&i, &j| compare(i, j) == Ordering::Equal) {
            let end = start + class.len();
            let moved = class.iter().any(|&i| fragments[i as usize].moved);
            classes.push(Class { members: start..end, moved });
            start = end;
        }
    }

    fn members(&self, class: u32) -> impl Iterator<Item = &Fragment> + Clone {
        self.alike[self.classes[class as usize].members.clone()].iter().map(|&i| &self.fragments[i as usize])
    }

    /// The first of a class.
    fn one_of(&self, class: usize) -> &Fragment {
        &self.fragments[self.alike[self.classes[class].members.start] as usize]
    }

    /// Finds the pairs of classes, one at least with a rounded end, that meet otherwise than in common ends.
    fn find_conflicts(&mut self, slabs: &mut Slabs) {
        self.find_alike();
        let mut conflicts = std::mem::take(&mut self.conflicts);
        conflicts.clear();
        if self.classes.iter().any(|class| class.moved) {
            let points = (0..self.classes.len()).flat_map(|class| self.one_of(class).segment);
            let classes = 0..index(self.classes.len());
            slabs.build(points, classes.map(|class| (class, [2 * class, 2 * class + 1])));
            slabs.pairs(|i, j| {
                let moved = self.classes[i as usize].moved || self.classes[j as usize].moved;
                let segments = || [i, j].map(|class| self.one_of(class as usize).segment);
                if moved && in_conflict(segments()) {
                    conflicts.push([i, j]);
                }
            });
        }
        self.conflicts = conflicts;
    }
}

/// Whether two segments have more in common than single ends, or nothing.
fn in_conflict([s, t]: [Segment; 2]) -> bool {
    let (p, q) = (side(s[0], s[1], t[0]), side(s[0], s[1], t[1]));
    if p == q && p != Side::On {
        return false;
    }
    let (r, o) = (side(t[0], t[1], s[0]), side(t[0], t[1], s[1]));
    let touches = |side: Side, segment: Segment, point: DVec2| side == Side::On && is_inside(segment, point);
    let touch = touches(p, s, t[0]) || touches(q, s, t[1]) || touches(r, t, s[0]) || touches(o, t, s[1]);
    let cross = p == q.reversed() && p != Side::On && r == o.reversed() && r != Side::On;
    touch || cross
}

impl Rounded<'_> {
    /// Whether no two fragments at all meet but in common vertices: the law behind [`is_sound`].
    fn is_sound_throughout(&self, slabs: &mut Slabs, mending: &mut Mending) -> bool {
        let Mending { parts, fragments, .. } = mending;
        self.list_parts(None, parts);
        self.cut_up(parts, &[], fragments);
        if fragments.iter().any(|f| f.segment[0] == f.segment[1]) {
            return false;
        }
        slabs.build(
            fragments.iter().flat_map(|f| f.segment),
            (0..index(fragments.len())).map(|i| (i, [2 * i, 2 * i + 1])),
        );
        let vertex = |end: u32| fragments[end as usize / 2].ends[end as usize % 2];
        let one_vertex = slabs.places().all(|mut place| {
            let first = place.next().map(vertex);
            place.all(|end| Some(vertex(end)) == first)
        });
        let mut sound = one_vertex && slabs.copies().next().is_none();
        if sound {
            slabs.pairs(|i, j| sound = sound && are_sound(&fragments[i as usize], &fragments[j as usize]));
        }
        sound
    }

    /// The parts of all pieces, or of those on some edges.
    fn list_parts(&self, only: Option<&[u32]>, parts: &mut Vec<Part>) {
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

    /// The one id of a vertex that all have who end there.
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

    /// All fragments of all parts.
    fn cut_up(&self, parts: &[Part], mut cuts: &[CutAt], fragments: &mut Vec<Fragment>) {
        fragments.clear();
        for (id, &part) in (0..).zip(parts) {
            let own = cuts.iter().take_while(|cut| cut.0 == id).count();
            self.fragment(id, part, &cuts[..own], fragments);
            cuts = &cuts[own..];
        }
    }

    fn fragment(&self, id: u32, part: Part, cuts: &[CutAt], fragments: &mut Vec<Fragment>) {
        let is_crossing = |vertex: u32| self.crossing(vertex).is_some();
        let mut from = (part.start, self.point(part.start));
        let mut moved = is_crossing(part.start);
        let mut add = |from: (u32, DVec2), to: (u32, DVec2), moved: bool| {
            let segment = [from.1, to.1];
            fragments.push(Fragment { segment, part: id, edge: part.edge, ends: [from.0, to.0], moved });
        };
        for vertex in self.ordered(part, cuts) {
            let to = (vertex, self.cut_point(part, vertex));
            add(from, to, true);
            (from, moved) = (to, true);
        }
        add(from, (part.end, self.point(part.end)), moved || is_crossing(part.end));
    }

    /// The vertices at whose abscissae a part is cut, in order along it, equal abscissae once.
    fn ordered(&self, part: Part, cuts: &[CutAt]) -> Vec<u32> {
        if cuts.is_empty() {
            return Vec::new();
        }
        let mut vertices: Vec<u32> = cuts.iter().map(|cut| cut.1).collect();
        vertices.sort_by(|&a, &b| self.compare_abscissae(a, b));
        vertices.dedup_by(|a, b| self.compare_abscissae(*a, *b) == Ordering::Equal);
        if self.compare_abscissae(part.start, part.end) == Ordering::Greater {
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

    /// The point of the part's edge at a vertex's abscissa, rounded.
    fn cut_point(&self, part: Part, vertex: u32) -> DVec2 {
        let y = self.exact_abscissa(vertex).ordinate_on(self.edges.segment(part.edge));
        DVec2::new(self.abscissa(vertex).rounded, y.to_f64())
    }

    /// Cuts the parts of conflicting fragments at the ends of one of those that they conflict with; whether that added any
    /// cut.
    fn add_cuts(&self, mending: &mut Mending) -> bool {
        let mut added: Vec<CutAt> = Vec::new();
        for &[i, j] in &mending.conflicts {
            for (class, other) in [(i, j), (j, i)] {
                let ends = mending.one_of(other as usize).ends;
                for fragment in mending.members(class) {
                    let inside = ends.into_iter().filter(|&end| self.is_strictly_between(fragment.ends, end));
                    added.extend(inside.map(|end| (fragment.part, end)));
                }
            }
        }
        mending.cuts.extend_from_slice(&added);
        mending.cuts.sort_unstable();
        mending.cuts.dedup();
        !added.is_empty()
    }

    fn is_strictly_between(&self, ends: [u32; 2], vertex: u32) -> bool {
        let (from, to) = (self.compare_abscissae(ends[0], vertex), self.compare_abscissae(vertex, ends[1]));
        from == to && from != Ordering::Equal
    }
}

/// All fragments, those that rounding left vertical cut at the points that lie on them.
fn cut_verticals(fragments: &[Fragment]) -> Vec<Segment> {
    let mut points: Vec<DVec2> = fragments.iter().flat_map(|f| f.segment).collect();
    points.sort_unstable_by(|&a, &b| lexicographic(a, b));
    points.dedup();
    let mut segments = Vec::with_capacity(fragments.len());
    for fragment in fragments {
        let segment = fragment.segment;
        if segment[0].x != segment[1].x {
            segments.push(segment);
            continue;
        }
        let [low, high] = rightward(segment);
        let first = points.partition_point(|&p| lexicographic(p, low) == Ordering::Less);
        let last = points.partition_point(|&p| lexicographic(p, high) == Ordering::Less);
        for pair in points[first..=last].windows(2) {
            segments.push(if segment[0] == low { [pair[0], pair[1]] } else { [pair[1], pair[0]] });
        }
    }
    segments
}
