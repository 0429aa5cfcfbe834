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

use crate::contacts::Contacts;
use crate::edges::Edges;
use crate::outline::Outline;
use crate::predicates::{Ratio, Segment, Side, crossing_ratio, is_inside, lexicographic, rightward, side};
use crate::select::{Piece, Selection};
use crate::strips::Strips;
use crate::truth::index;
use glam::DVec2;
use std::cmp::Ordering;

/// An exact abscissa: that of a vertex.
#[derive(Clone, Debug)]
struct Abscissa {
    vertex: u32,
    rounded: f64,
}

/// A part of a piece between neighbouring cuts, rounded.
#[derive(Clone, Copy, Debug)]
struct Fragment {
    segment: Segment,
    piece: u32,
    /// The vertices whose abscissae its ends have.
    ends: [u32; 2],
    /// Whether an end is a rounded point.
    moved: bool,
}

/// A cut of a piece at a vertex's abscissa.
type CutAt = (u32, u32);

struct Repair<'a> {
    edges: &'a Edges,
    contacts: &'a Contacts,
    selection: &'a Selection,
    /// The cuts, sorted by piece.
    cuts: Vec<CutAt>,
}

/// The pieces as an outline: no two edges meet but in their ends.
pub(crate) fn mend(
    edges: &Edges,
    contacts: &Contacts,
    selection: &Selection,
    strips: &mut Strips,
) -> Outline {
    let mut repair = Repair { edges, contacts, selection, cuts: Vec::new() };
    loop {
        let fragments = repair.fragments();
        let conflicts = find_conflicts(&fragments, strips);
        if conflicts.is_empty() {
            return Outline::of(&fragments.iter().map(|f| f.segment).collect::<Vec<_>>());
        }
        if !repair.add_cuts(&fragments, &conflicts) {
            return Outline::of(&cut_verticals(&fragments));
        }
    }
}

/// The pairs of fragments, one at least with a rounded end, that meet otherwise than in common ends.
fn find_conflicts(fragments: &[Fragment], strips: &mut Strips) -> Vec<[u32; 2]> {
    let mut conflicts = Vec::new();
    if fragments.iter().any(|f| f.moved) {
        strips.build(fragments.iter().enumerate().map(|(i, f)| (index(i), f.segment)));
        strips.pairs(|i, j| {
            let (f, g) = (&fragments[i as usize], &fragments[j as usize]);
            if (f.moved || g.moved) && f.piece != g.piece && conflict(f.segment, g.segment) {
                conflicts.push([i, j]);
            }
        });
    }
    conflicts
}

/// Whether two segments have a point in common that is not an end of both, unless they coincide.
fn conflict(s: Segment, t: Segment) -> bool {
    let on_inside = |s: Segment, p: DVec2| is_inside(s, p) && side(s[0], s[1], p) == Side::On;
    let coincide = (s[0] == t[0] && s[1] == t[1]) || (s[0] == t[1] && s[1] == t[0]);
    if coincide {
        return false;
    }
    let touch = on_inside(s, t[0]) || on_inside(s, t[1]) || on_inside(t, s[0]) || on_inside(t, s[1]);
    touch || {
        let (p, q) = (side(s[0], s[1], t[0]), side(s[0], s[1], t[1]));
        let (r, o) = (side(t[0], t[1], s[0]), side(t[0], t[1], s[1]));
        p == q.reversed() && p != Side::On && r == o.reversed() && r != Side::On
    }
}

impl Repair<'_> {
    fn fragments(&self) -> Vec<Fragment> {
        let mut fragments = Vec::with_capacity(self.selection.pieces().len() + self.cuts.len());
        let mut cuts = self.cuts.as_slice();
        for (i, &piece) in self.selection.pieces().iter().enumerate() {
            let id = index(i);
            let own = cuts.iter().take_while(|cut| cut.0 == id).count();
            self.fragment(id, piece, &cuts[..own], &mut fragments);
            cuts = &cuts[own..];
        }
        fragments
    }

    fn fragment(&self, id: u32, piece: Piece, cuts: &[CutAt], fragments: &mut Vec<Fragment>) {
        let mut from = (piece.start, self.selection.point(self.edges, piece.start));
        let mut moved = self.selection.is_crossing(piece.start);
        for vertex in self.ordered(piece, cuts) {
            let to = (vertex, self.cut_point(piece, vertex));
            fragments.push(Fragment {
                segment: [from.1, to.1],
                piece: id,
                ends: [from.0, vertex],
                moved: true,
            });
            (from, moved) = (to, true);
        }
        let moved = moved || self.selection.is_crossing(piece.end);
        let end = self.selection.point(self.edges, piece.end);
        fragments.push(Fragment { segment: [from.1, end], piece: id, ends: [from.0, piece.end], moved });
    }

    /// The vertices at whose abscissae a piece is cut, in order along it, equal abscissae once.
    fn ordered(&self, piece: Piece, cuts: &[CutAt]) -> Vec<u32> {
        if cuts.is_empty() {
            return Vec::new();
        }
        let mut vertices: Vec<u32> = cuts.iter().map(|cut| cut.1).collect();
        vertices.sort_by(|&a, &b| self.compare_abscissae(a, b));
        vertices.dedup_by(|a, b| self.compare_abscissae(*a, *b) == Ordering::Equal);
        if self.compare_abscissae(piece.start, piece.end) == Ordering::Greater {
            vertices.reverse();
        }
        vertices
    }

    fn abscissa(&self, vertex: u32) -> Abscissa {
        Abscissa { vertex, rounded: self.selection.point(self.edges, vertex).x }
    }

    /// The exact x of a vertex.
    fn exact_abscissa(&self, vertex: u32) -> Ratio {
        match self.contacts.crossing(vertex) {
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

    /// The point of the piece's edge at a vertex's abscissa, rounded.
    fn cut_point(&self, piece: Piece, vertex: u32) -> DVec2 {
        let y = self.exact_abscissa(vertex).ordinate_on(self.edges.segment(piece.edge));
        DVec2::new(self.abscissa(vertex).rounded, y.to_f64())
    }

    /// Cuts the pieces of conflicting fragments at each other's ends; whether that added any cut.
    fn add_cuts(&mut self, fragments: &[Fragment], conflicts: &[[u32; 2]]) -> bool {
        let mut added: Vec<CutAt> = Vec::new();
        for &[i, j] in conflicts {
            let (f, g) = (&fragments[i as usize], &fragments[j as usize]);
            for (fragment, vertex) in [(f, g.ends[0]), (f, g.ends[1]), (g, f.ends[0]), (g, f.ends[1])] {
                if self.is_strictly_between(fragment.ends, vertex) {
                    added.push((fragment.piece, vertex));
                }
            }
        }
        self.cuts.extend_from_slice(&added);
        self.cuts.sort_unstable();
        self.cuts.dedup();
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
