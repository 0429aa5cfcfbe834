//! Whether a raw ring is simple, so that it winds once at most, as a region does.

use crate::predicates::{Segment, Side, is_inside, lexicographic, side};
use glam::DVec2;

/// Of longer rings not all edges are compared with all.
const SHORT: usize = 16;

/// 1 for a simple ring that runs counter-clockwise, -1 for one that runs clockwise; none for a ring that touches or
/// overlaps itself, or is long and winding. The ring has its first point once more at the end.
pub(crate) fn winds_once(closed: &[DVec2]) -> Option<i32> {
    winds_around_middle(closed).or_else(|| winds_once_compared(closed))
}

/// The same for rings that can be seen whole from their middle alone, as most small ones: all edges turn one way around it,
/// once around, so that they cross the horizontal line through it twice.
fn winds_around_middle(closed: &[DVec2]) -> Option<i32> {
    let count = closed.len().checked_sub(1).filter(|&count| count > 0)?;
    let middle = closed[..count].iter().sum::<DVec2>() / count as f64;
    if !middle.is_finite() {
        return None;
    }
    let way = side(closed[0], closed[1], middle);
    let (mut is_above, mut crossings) = (closed[0].y > middle.y, 0);
    let turns = closed.windows(2).all(|ends| {
        let was_above = std::mem::replace(&mut is_above, ends[1].y > middle.y);
        crossings += u32::from(was_above != is_above);
        side(ends[0], ends[1], middle) == way
    });
    direction_of(way).filter(|_| turns && crossings == 2)
}

fn winds_once_compared(closed: &[DVec2]) -> Option<i32> {
    let mut edges = [[DVec2::ZERO; 2]; SHORT];
    let mut count = 0;
    for ends in closed.windows(2).filter(|ends| ends[0] != ends[1]) {
        *edges.get_mut(count)? = [ends[0], ends[1]];
        count += 1;
    }
    let edges = &edges[..count];
    if count < 3 || !(0..count).all(|i| goes_on(edges[i], edges[(i + 1) % count])) {
        return None;
    }
    let neighbours = |i: usize, j: usize| j == i + 1 || (i == 0 && j + 1 == count);
    let clear = |i: usize, j: usize| neighbours(i, j) || are_apart(edges[i], edges[j]);
    (0..count).all(|i| (i + 1..count).all(|j| clear(i, j))).then(|| direction(edges))?
}

/// Whether an edge does not turn back into the one before it.
fn goes_on([a, b]: Segment, [_, c]: Segment) -> bool {
    side(a, b, c) != Side::On || is_inside([a, c], b)
}

/// Whether two edges have no common point: if they have none, one lies on one side of the other's line, or both on one line.
fn are_apart(s: Segment, t: Segment) -> bool {
    let boxes_miss = |s: Segment, t: Segment| s[0].max(s[1]).cmplt(t[0].min(t[1])).any();
    let on_one_side = |[a, b]: Segment, t: Segment| {
        let first = side(a, b, t[0]);
        first != Side::On && first == side(a, b, t[1])
    };
    boxes_miss(s, t) || boxes_miss(t, s) || on_one_side(s, t) || on_one_side(t, s)
}

/// The turn at the lexicographically smallest point is that of the whole ring.
fn direction(edges: &[Segment]) -> Option<i32> {
    let smallest = (0..edges.len()).min_by(|&i, &j| lexicographic(edges[i][0], edges[j][0]))?;
    let before = edges[smallest.checked_sub(1).unwrap_or(edges.len() - 1)][0];
    direction_of(side(before, edges[smallest][0], edges[smallest][1]))
}

fn direction_of(turn: Side) -> Option<i32> {
    match turn {
        Side::Left => Some(1),
        Side::Right => Some(-1),
        Side::On => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn winds(ring: &[[f64; 2]]) -> Option<i32> {
        let mut closed: Vec<DVec2> = ring.iter().copied().map(DVec2::from).collect();
        closed.push(closed[0]);
        winds_once(&closed)
    }

    #[test]
    fn simple_rings_wind_once_in_their_direction() {
        let notched = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.5], [0.0, 2.0]];
        for turn in 0..notched.len() {
            let mut ring = notched;
            ring.rotate_left(turn);
            assert_eq!(winds(&ring), Some(1));
            ring.reverse();
            assert_eq!(winds(&ring), Some(-1));
        }
        assert_eq!(winds(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]), Some(1));
    }

    #[test]
    fn rings_that_meet_themselves_are_left_alone() {
        for ring in [
            &[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]][..], // crosses
            &[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]], // touches an edge
            &[[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]], // touches in a vertex
            &[[0.0, 0.0], [3.0, 0.0], [2.0, 0.0], [2.0, 2.0]],     // a spike
            &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]],
            &[[0.0, 0.0], [1.0, 0.0]],
            &[[0.0, 0.0]],
            &[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [2.0, 0.0], [1.0, 0.0], [0.0, 1.0]], // overlaps
        ] {
            assert_eq!(winds(ring), None, "{ring:?}");
        }
        let around = |count: u32, turns: f64| {
            let point =
                |i| DVec2::from_angle(f64::from(i) * turns * std::f64::consts::TAU / f64::from(count));
            winds(&(0..count).map(|i| point(i).to_array()).collect::<Vec<_>>())
        };
        assert_eq!(around(9, 2.0), None);
        assert_eq!([around(64, 1.0), around(100, -1.0)], [Some(1), Some(-1)]);
    }
}
