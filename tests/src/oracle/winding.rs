//! Winding numbers just left and just right of a piece's midpoint.
use super::cut::{Edge, Homogeneous, cross, dot};
use crate::exact::Exact;

/// What surrounds a midpoint.
pub(super) struct Around {
    /// For each operand the winding numbers just left and just right.
    pub(super) windings: Vec<[i32; 2]>,
    /// True when no earlier edge runs through the midpoint.
    pub(super) is_first: bool,
}

/// Counts, for the points infinitely near to `middle` on the left and on the right of edge `own`, the edges that a ray
/// towards +x meets: +1 for one that goes up, -1 for one that goes down.
///
/// A midpoint lies on no contact, so each edge either avoids it or runs straight through it along `own`.
pub(super) fn around<T: Exact>(
    middle: &Homogeneous<T>,
    own: usize,
    edges: &[Edge<T>],
    operands: usize,
) -> Around {
    let direction = &edges[own].span;
    // The left point is higher than the midpoint when the edge runs to the right, the right point is lower.
    let rise = sign(&direction[0]);
    let mut found = Around { windings: vec![[0; 2]; operands], is_first: true };
    for (index, edge) in edges.iter().enumerate() {
        let levels =
            [&edge.start, &edge.end].map(|p| sign(&(p[1].clone() * middle.w.clone() - middle.y.clone())));
        if levels[0] * levels[1] > 0 {
            continue;
        }
        let turn = turn(edge, middle);
        let along = sign(&dot(&edge.span, direction));
        let runs_through = turn == 0 && contains(edge, middle);
        found.is_first &= !(runs_through && index < own);
        let turns = if runs_through { [along, -along] } else { [turn, turn] };
        for (side, rise) in [rise, -rise].into_iter().enumerate() {
            found.windings[edge.operand][side] += crossing(levels, rise, turns[side]);
        }
    }
    found
}

/// What one edge adds: `levels` are its ends' heights against the midpoint, `rise` the side point's, `turn` is positive
/// when the side point lies left of the edge.
pub(super) fn crossing(levels: [i32; 2], rise: i32, turn: i32) -> i32 {
    let is_below = levels.map(|level| level < 0 || (level == 0 && rise >= 0));
    match is_below {
        [true, false] if turn > 0 => 1,
        [false, true] if turn < 0 => -1,
        _ => 0,
    }
}

pub(super) fn turn<T: Exact>(edge: &Edge<T>, point: &Homogeneous<T>) -> i32 {
    let offset = [
        point.x.clone() - edge.start[0].clone() * point.w.clone(),
        point.y.clone() - edge.start[1].clone() * point.w.clone(),
    ];
    sign(&cross(&edge.span, &offset))
}

/// For a point on the edge's line: true when it lies between the ends.
pub(super) fn contains<T: Exact>(edge: &Edge<T>, point: &Homogeneous<T>) -> bool {
    let between = |axis: usize, value: &T| {
        let (a, b) = (edge.start[axis].clone() * point.w.clone(), edge.end[axis].clone() * point.w.clone());
        if a <= b { a <= *value && *value <= b } else { b <= *value && *value <= a }
    };
    between(0, &point.x) && between(1, &point.y)
}

pub(super) fn sign<T: Exact>(value: &T) -> i32 {
    i32::from(value.is_positive()) - i32::from(value.is_negative())
}
