//! Convex pieces of polygons that meet in whole edges.
//!
//! ```text
//!     o---------------o     A triangulation adds no vertex, and what it adds in edges is taken out again where both
//!     | \           / |     sides together are convex. So two pieces have a whole edge in common, a vertex or nothing:
//!     |  o---------o  |     seen from anywhere, an edge between two of them is hidden by both, whatever is rounded.
//!     |  |         |  |
//!     o--o         o--o
//! ```
use super::loops::leaf;
use crate::numeric::predicates::turn_in_plane;
use glam::DVec2;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// A piece has no more corners.
pub(crate) const MOST: usize = 8;

/// An edge by the bits of its ends.
type Link = [[u64; 2]; 2];

/// A corner is clear if it turns by more than this sine: far more than vertices that stand for others nearby may change. It chooses among
/// pieces, and decides nothing of what they are.
const CLEAR: f64 = 1e-6;

/// Convex pieces of what is inside an odd number of loops, counter-clockwise; all corners are clear but for those of triangles.
///
/// Takes O(n log n) for n vertices.
pub(crate) fn convex_pieces(loops: &[Vec<DVec2>]) -> Vec<Vec<DVec2>> {
    let triangles = leaf(loops).evaluate().triangulate();
    let mut pieces: Vec<Vec<DVec2>> = triangles.iter().map(|triangle| triangle.to_vec()).collect();
    let mut owners: BTreeMap<Link, usize> = BTreeMap::new();
    for (index, piece) in pieces.iter().enumerate() {
        owners.extend(edges(piece).map(|edge| (edge, index)));
    }
    let inner: Vec<Link> = owners.keys().filter(|[a, b]| a < b).copied().collect();
    for [a, b] in inner {
        let (Some(&one), Some(&other)) = (owners.get(&[a, b]), owners.get(&[b, a])) else { continue };
        if let Some(joined) = join(&pieces[one], &pieces[other], [a, b]) {
            owners.extend(edges(&joined).map(|edge| (edge, one)));
            pieces[one] = joined;
            pieces[other].clear();
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

fn bits(point: DVec2) -> [u64; 2] {
    point.to_array().map(f64::to_bits)
}

fn edges(piece: &[DVec2]) -> impl Iterator<Item = Link> + '_ {
    piece.iter().zip(piece.iter().cycle().skip(1)).map(|(a, b)| [bits(*a), bits(*b)])
}

/// Two pieces as one if that is convex: the first has the edge from `a` to `b`, the other one that from `b` to `a`.
fn join(one: &[DVec2], other: &[DVec2], [a, b]: Link) -> Option<Vec<DVec2>> {
    let count = one.len() + other.len() - 2;
    if count > MOST {
        return None;
    }
    // From b around the first to a, and what the other one has between a and b.
    let from = |piece: &[DVec2], first| piece.iter().position(|p| bits(*p) == first);
    let (of_one, of_other) = (from(one, b)?, from(other, a)?);
    let first = one.iter().cycle().skip(of_one).take(one.len());
    let second = other.iter().cycle().skip(of_other + 1).take(other.len() - 2);
    let joined: Vec<DVec2> = first.chain(second).copied().collect();
    (is_clear(&joined, 0) && is_clear(&joined, one.len() - 1)).then_some(joined)
}

/// Whether all corners of a counter-clockwise ring turn clearly to the left.
pub(crate) fn is_clearly_convex(ring: &[DVec2]) -> bool {
    (0..ring.len()).all(|corner| is_clear(ring, corner))
}

/// The corners of a convex ring that do not lie straight between their neighbours.
pub(crate) fn bends(ring: &[DVec2]) -> impl Iterator<Item = usize> + '_ {
    let next = |corner: usize| ring[corner % ring.len()];
    let is_bend = move |corner: &usize| {
        turn_in_plane(next(corner + ring.len() - 1), next(*corner), next(corner + 1)) != Ordering::Equal
    };
    (0..ring.len()).filter(is_bend)
}

fn is_clear(ring: &[DVec2], corner: usize) -> bool {
    let [before, here, after] = [ring.len() - 1, 0, 1].map(|step| ring[(corner + step) % ring.len()]);
    let [u, v] = [here - before, after - here];
    u.perp_dot(v) > CLEAR * u.length() * v.length()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(piece: &[DVec2]) -> f64 {
        let next = piece.iter().cycle().skip(1);
        piece.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() / 2.0
    }

    fn square(low: f64, high: f64) -> Vec<DVec2> {
        [[low, low], [high, low], [high, high], [low, high]].map(DVec2::from).to_vec()
    }

    #[test]
    fn pieces_cover_the_polygon_and_meet_in_whole_edges() {
        let comb: Vec<DVec2> = (0..40)
            .map(|i| DVec2::new(f64::from((i + 1) / 2), if i % 4 < 2 { 1.0 } else { 2.0 }))
            .chain([DVec2::new(20.0, 0.0), DVec2::new(0.0, 0.0)])
            .rev()
            .collect();
        for (loops, covered) in
            [(vec![square(0.0, 3.0), square(1.0, 2.0)], 8.0), (vec![comb.clone()], area(&comb))]
        {
            let pieces = convex_pieces(&loops);
            let sum: f64 = pieces.iter().map(|piece| area(piece)).sum();
            assert!((sum - covered).abs() < 1e-12);
            assert!(pieces.iter().all(|piece| piece.len() <= MOST));
            let mut sides: Vec<Link> = pieces.iter().flat_map(|piece| edges(piece)).collect();
            sides.sort_unstable();
            let rim = sides.iter().filter(|[a, b]| sides.binary_search(&[*b, *a]).is_err()).count();
            assert_eq!(rim, loops.iter().map(Vec::len).sum::<usize>());
        }
    }

    #[test]
    fn a_frame_has_four_pieces() {
        assert_eq!(convex_pieces(&[square(0.0, 3.0), square(1.0, 2.0)]).len(), 4);
    }
}
