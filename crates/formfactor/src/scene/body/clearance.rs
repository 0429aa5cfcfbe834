//! Whether something touches the front of a face: where nothing does, all points just before the face are on one side of everything.
//!
//! Decided exactly, piece by convex piece. What touches the face in a point, or along its boundary, does not touch its front; what touches
//! it where two of its own pieces meet is taken to do so.
use crate::numeric::predicates::{turn, turn_in_plane};
use crate::shapes::{extent::Extent, polygon::PlanarPolygon};
use glam::DVec3;
use std::cmp::Ordering;

/// Whether a polygon does not touch the front of a face along a line. Both lie on their planes exactly.
pub(super) fn is_clear(face: &PlanarPolygon, other: &PlanarPolygon) -> bool {
    let is_behind = other.points().iter().all(|p| face.plane().side_of(*p).is_le());
    let pieces_are_clear = || {
        face.convex_pieces().all(|piece| other.convex_pieces().all(|cut| is_apart([face, other], piece, cut)))
    };
    is_behind || pieces_are_clear()
}

/// Whether a convex piece of the other polygon does not touch the front of a convex piece of the face.
fn is_apart([face, other]: [&PlanarPolygon; 2], piece: &[DVec3], cut: &[DVec3]) -> bool {
    let heights = sides(face, cut);
    if !heights.contains(&Ordering::Greater) || Extent::around(piece).misses(&Extent::around(cut)) {
        return true;
    }
    if !heights.contains(&Ordering::Less) {
        return match level(cut, &heights)[..] {
            [a, b] => is_beside(face, piece, [a, b]),
            ref level => level.len() < 2,
        };
    }
    let across = sides(other, piece);
    if !(across.contains(&Ordering::Greater) && across.contains(&Ordering::Less)) {
        return match level(piece, &across)[..] {
            [a, b] if !is_of(face, [a, b]) => Extent::around(&[a, b]).misses(&Extent::around(cut)),
            _ => true,
        };
    }
    are_in_order(rising(cut, &heights), rising(piece, &across))
}

fn sides(plane: &PlanarPolygon, points: &[DVec3]) -> Vec<Ordering> {
    points.iter().map(|p| plane.plane().side_of(*p)).collect()
}

/// The points that are on the plane.
fn level(points: &[DVec3], sides: &[Ordering]) -> Vec<DVec3> {
    points.iter().zip(sides).filter(|(_, side)| side.is_eq()).map(|(p, _)| *p).collect()
}

/// Whether two points are the ends of an edge of a polygon's boundary, and not of a line between its pieces.
fn is_of(polygon: &PlanarPolygon, [a, b]: [DVec3; 2]) -> bool {
    polygon.is_convex() || polygon.edges().any(|(c, d)| [c, d] == [a, b] || [d, c] == [a, b])
}

/// Whether a segment in the plane of a face passes beside a convex piece, or along the face's boundary.
fn is_beside(face: &PlanarPolygon, piece: &[DVec3], ends: [DVec3; 2]) -> bool {
    let flat = |p: DVec3| face.flat(p);
    let next = || piece.iter().cycle().skip(1);
    let side = |[a, b]: [DVec3; 2], p: DVec3| turn_in_plane(flat(a), flat(b), flat(p));
    let is_outside = |(a, b): (&DVec3, &DVec3)| {
        let turns = ends.map(|end| side([*a, *b], end));
        let is_own = turns != [Ordering::Equal; 2] || is_of(face, [*a, *b]);
        turns.iter().all(|turn| turn.is_le()) && is_own
    };
    if piece.iter().zip(next()).any(is_outside) {
        return true;
    }
    let turns: Vec<Ordering> = piece.iter().map(|p| side(ends, *p)).collect();
    let on_line = level(piece, &turns);
    let is_own = on_line.len() < 2 || is_of(face, [on_line[0], on_line[1]]);
    is_own && (turns.iter().all(|turn| turn.is_le()) || turns.iter().all(|turn| turn.is_ge()))
}

/// The two edges of a convex polygon that pass a plane, each from on it or behind it to before it.
fn rising(points: &[DVec3], sides: &[Ordering]) -> Vec<[DVec3; 2]> {
    let count = points.len();
    let pair = |i: usize| [i, (i + 1) % count];
    let passes = |[i, j]: &[usize; 2]| sides[*i].is_gt() != sides[*j].is_gt();
    let turned = |[i, j]: [usize; 2]| if sides[i].is_gt() { [j, i] } else { [i, j] };
    (0..count).map(pair).filter(passes).map(turned).map(|ends| ends.map(|i| points[i])).collect()
}

/// Whether the line that two planes share passes one polygon and then the other, by the edges where it enters and leaves each.
///
/// ```text
///        a    b      An edge of one and an edge of the other, both rising from the other's plane, turn about each other one way or the
///   -----●----●---   other, as one meets the line before the other or behind it.
/// ```
fn are_in_order(one: Vec<[DVec3; 2]>, other: Vec<[DVec3; 2]>) -> bool {
    let turns = || one.iter().flat_map(|[a, b]| other.iter().map(|[c, d]| turn(*a, *b, *c, *d)));
    turns().all(Ordering::is_le) || turns().all(Ordering::is_ge)
}
