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

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct Mending {
    fragments: Vec<Fragment>,
    conflicts: Vec<[u32; 2]>,
    /// The cuts, sorted by piece.
    cuts: Vec<CutAt>,
}

struct Repair<'a> {
    edges: &'a Edges,
    contacts: &'a Contacts,
    selection: &'a Selection,
}

/// Puts the pieces into an outline: no two of its edges meet but in their ends.
pub(crate) fn mend(
    edges: &Edges,
    contacts: &Contacts,
    selection: &Selection,
    strips: &mut Strips,
    mending: &mut Mending,
    outline: &mut Outline,
) {
    let repair = Repair { edges, contacts, selection };
    mending.cuts.clear();
    loop {
        repair.cut_up(&mending.cuts, &mut mending.fragments);
        let may_coincide = find_conflicts(&mending.fragments, strips, &mut mending.conflicts);
        if mending.conflicts.is_empty() {
            return outline.build(mending.fragments.iter().map(|f| f.segment), may_coincide);
        }
        if !repair.add_cuts(mending) {
            return outline.build(cut_verticals(&mending.fragments).iter().copied(), true);
        }
    }
}

/// Finds the pairs of fragments, one at least with a rounded end, that meet otherwise than in common ends; returns
/// whether any have both ends in common.
fn find_conflicts(fragments: &[Fragment], strips: &mut Strips, conflicts: &mut Vec<[u32; 2]>) -> bool {
    conflicts.clear();
    let mut coincide = false;
    if fragments.iter().any(|f| f.moved) {
        strips.build(fragments.iter().enumerate().map(|(i, f)| (index(i), f.segment)));
        strips.pairs(|i, j| {
            let (f, g) = (&fragments[i as usize], &fragments[j as usize]);
            if (f.moved || g.moved) && f.piece != g.piece {
                match meeting(f.segment, g.segment) {
                    Meeting::Apart => {}
                    Meeting::Coincide => coincide = true,
                    Meeting::Conflict => conflicts.push([i, j]),
                }
            }
        });
    }
    coincide
}

/// What two fragments have in common: single ends or nothing, both ends, or anything else.
enum Meeting {
    Apart,
    Coincide,
    Conflict,
}

fn meeting(s: Segment, t: Segment) -> Meeting {
    if (s[0] == t[0] && s[1] == t[1]) || (s[0] == t[1] && s[1] == t[0]) {
        return Meeting::Coincide;
    }
    let (p, q) = (side(s[0], s[1], t[0]), side(s[0], s[1], t[1]));
    if p == q && p != Side::On {
        return Meeting::Apart;
    }
    let (r, o) = (side(t[0], t[1], s[0]), side(t[0], t[1], s[1]));
    let touches = |side: Side, segment: Segment, point: DVec2| side == Side::On && is_inside(segment, point);
    let touch = touches(p, s, t[0]) || touches(q, s, t[1]) || touches(r, t, s[0]) || touches(o, t, s[1]);
    let cross = p == q.reversed() && p != Side::On && r == o.reversed() && r != Side::On;
    if touch || cross { Meeting::Conflict } else { Meeting::Apart }
}

impl Repair<'_> {
    /// All fragments of all pieces.
    fn cut_up(&self, mut cuts: &[CutAt], fragments: &mut Vec<Fragment>) {
        fragments.clear();
        for (i, &piece) in self.selection.pieces().iter().enumerate() {
            let id = index(i);
            let own = cuts.iter().take_while(|cut| cut.0 == id).count();
            self.fragment(id, piece, &cuts[..own], fragments);
            cuts = &cuts[own..];
        }
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
    fn add_cuts(&self, mending: &mut Mending) -> bool {
        let mut added: Vec<CutAt> = Vec::new();
        for &[i, j] in &mending.conflicts {
            let (f, g) = (&mending.fragments[i as usize], &mending.fragments[j as usize]);
            for (fragment, vertex) in [(f, g.ends[0]), (f, g.ends[1]), (g, f.ends[0]), (g, f.ends[1])] {
                if self.is_strictly_between(fragment.ends, vertex) {
                    added.push((fragment.piece, vertex));
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
