//! Whether edges of two features have a point in common, by their signs alone: far cheaper than evaluating both.
use crate::column::features::{Bounds, meet};
use exactfloat::orient2d;
use polycsg::DVec2;

/// So many comparisons for each edge, and the question is left open.
const MOST_PER_EDGE: usize = 64;

struct Edge {
    bounds: Bounds,
    ends: [DVec2; 2],
}

/// Whether edges of two sets of rings meet within a window; none, if that cannot be told here.
pub(crate) fn edges_meet<'r>(
    one: impl Iterator<Item = &'r [DVec2]>,
    other: impl Iterator<Item = &'r [DVec2]>,
    window: &Bounds,
) -> Option<bool> {
    let (one, other) = (edges_near(one, window), edges_near(other, window));
    let mut left = MOST_PER_EDGE * (one.len() + other.len());
    let (mut i, mut j) = (0, 0);
    while i < one.len() && j < other.len() {
        // Each edge is compared with those of the other side that start no further left, as far as it reaches.
        let is_first = one[i].bounds[0].x <= other[j].bounds[0].x;
        let (edge, rest) = if is_first { (&one[i], &other[j..]) } else { (&other[j], &one[i..]) };
        for candidate in rest.iter().take_while(|it| it.bounds[0].x <= edge.bounds[1].x) {
            left = left.checked_sub(1)?;
            if meet(&edge.bounds, &candidate.bounds) && have_a_point(edge.ends, candidate.ends) {
                return Some(true);
            }
        }
        if is_first { i += 1 } else { j += 1 }
    }
    Some(false)
}

/// The edges whose boxes meet a window, from the left to the right.
fn edges_near<'r>(rings: impl Iterator<Item = &'r [DVec2]>, window: &Bounds) -> Vec<Edge> {
    let edges = rings.flat_map(|ring| ring.iter().zip(ring.iter().skip(1).chain(ring.first())));
    let edges = edges.filter(|(a, b)| a != b);
    let edges = edges.map(|(&a, &b)| Edge { bounds: [a.min(b), a.max(b)], ends: [a, b] });
    let mut near: Vec<Edge> = edges.filter(|edge| meet(&edge.bounds, window)).collect();
    near.sort_unstable_by(|a, b| a.bounds[0].x.total_cmp(&b.bounds[0].x));
    near
}

/// Whether two edges have a point in common, whose boxes do.
fn have_a_point(s: [DVec2; 2], t: [DVec2; 2]) -> bool {
    !are_apart(s, t) && !are_apart(t, s)
}

/// Whether both ends of an edge lie strictly to one side of a line.
fn are_apart([a, b]: [DVec2; 2], ends: [DVec2; 2]) -> bool {
    let [one, other] = ends.map(|end| orient2d(a.to_array(), b.to_array(), end.to_array()));
    (one > 0.0 && other > 0.0) || (one < 0.0 && other < 0.0)
}
