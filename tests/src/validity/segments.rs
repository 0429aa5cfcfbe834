//! Sets of directed segments: whether they meet, and whether they bound a set to their left.
use crate::exact::{Exact, Grid};
use glam::DVec2;
use num_bigint::BigInt;

/// Bits up to which an orientation of doubled coordinates fits an `i128`.
pub(super) const SMALL_BITS: i64 = 60;

/// The first two segments that touch anywhere but in a shared end, or that overlap, or one that has no length.
pub fn first_contact(segments: &[[DVec2; 2]]) -> Option<(usize, usize)> {
    let grid = Grid::of(segments.iter().flatten());
    if grid.bits <= SMALL_BITS {
        contact_on(segments, |p| [grid.small_steps(p.x), grid.small_steps(p.y)])
    } else {
        contact_on::<BigInt>(segments, |p| [grid.steps(p.x), grid.steps(p.y)])
    }
}

/// True when the segments are the whole boundary of a set to their left: they meet nowhere but in shared ends, and the
/// winding number is 1 just left and 0 just right of each of them.
pub fn is_bounding(segments: &[[DVec2; 2]]) -> bool {
    if first_contact(segments).is_some() {
        return false;
    }
    let grid = Grid::of(segments.iter().flatten());
    if grid.bits <= SMALL_BITS {
        bound_left(segments, |p| [grid.small_steps(p.x), grid.small_steps(p.y)])
    } else {
        bound_left::<BigInt>(segments, |p| [grid.steps(p.x), grid.steps(p.y)])
    }
}

fn bound_left<T: Exact>(segments: &[[DVec2; 2]], steps: impl Fn(&DVec2) -> [T; 2]) -> bool {
    let twice = |p: &DVec2| steps(p).map(|v| v * T::from(2));
    let doubled: Vec<[[T; 2]; 2]> = segments.iter().map(|s| s.each_ref().map(twice)).collect();
    (0..doubled.len()).all(|own| bounds_left(own, &doubled))
}

/// Winding numbers beside the middle of a segment, by a ray towards +x from just above it.
fn bounds_left<T: Exact>(own: usize, segments: &[[[T; 2]; 2]]) -> bool {
    let [p, q] = &segments[own];
    let half = |axis: usize| (p[axis].clone() + q[axis].clone()) / T::from(2);
    let middle = [half(0), half(1)];
    let others = segments.iter().enumerate().filter(|(index, _)| *index != own);
    let winding: i32 = others.map(|(_, s)| crossing(&middle, s)).sum();
    if p[0] < q[0] {
        // Above is left; the ray meets the segment itself when it climbs.
        winding + i32::from(p[1] < q[1]) == 1
    } else {
        // Above, or beside a vertical one, is right; the ray meets the segment itself when it falls.
        winding - i32::from(p[1] > q[1]) == 0
    }
}

/// +1 when the ray meets a rising segment, -1 for a falling one.
fn crossing<T: Exact>(from: &[T; 2], segment: &[[T; 2]; 2]) -> i32 {
    let [a, b] = segment;
    let (is_a_below, is_b_below) = (a[1] <= from[1], b[1] <= from[1]);
    if is_a_below == is_b_below {
        return 0;
    }
    let turn = turn(a, b, from);
    i32::from(is_a_below && turn.is_positive()) - i32::from(is_b_below && turn.is_negative())
}

pub(super) fn contact_on<T: Exact>(
    segments: &[[DVec2; 2]],
    steps: impl Fn(&DVec2) -> [T; 2],
) -> Option<(usize, usize)> {
    let low = |i: usize| segments[i][0].min(segments[i][1]);
    let high = |i: usize| segments[i][0].max(segments[i][1]);
    let mut order: Vec<usize> = (0..segments.len()).collect();
    order.sort_by(|&i, &j| low(i).x.total_cmp(&low(j).x));
    for (place, &i) in order.iter().enumerate() {
        if segments[i][0] == segments[i][1] {
            return Some((i, i));
        }
        let near = order[place + 1..].iter().take_while(|&&j| low(j).x <= high(i).x);
        for &j in near.filter(|&&j| low(j).y <= high(i).y && low(i).y <= high(j).y) {
            if touch(&segments[i].map(|p| steps(&p)), &segments[j].map(|p| steps(&p))) {
                return Some((i, j));
            }
        }
    }
    None
}

/// True when two segments share any point but one end of each.
fn touch<T: Exact>(s: &[[T; 2]; 2], t: &[[T; 2]; 2]) -> bool {
    let shared = s.iter().flat_map(|p| t.iter().map(move |q| p == q)).filter(|&is_same| is_same).count();
    match shared {
        0 => cross_or_touch(s, t),
        1 => fold_back(s, t),
        _ => true,
    }
}

fn cross_or_touch<T: Exact>(s: &[[T; 2]; 2], t: &[[T; 2]; 2]) -> bool {
    let sides = |l: &[[T; 2]; 2], m: &[[T; 2]; 2]| [0, 1].map(|i| turn(&l[0], &l[1], &m[i]).signum());
    let (of_t, of_s) = (sides(s, t), sides(t, s));
    let is_apart = |signs: &[T; 2]| !signs[0].is_zero() && signs[0] == signs[1];
    if of_t.iter().all(T::is_zero) { overlap_on_a_line(s, t) } else { !is_apart(&of_t) && !is_apart(&of_s) }
}

fn overlap_on_a_line<T: Exact>(s: &[[T; 2]; 2], t: &[[T; 2]; 2]) -> bool {
    (0..2).all(|axis| {
        let range = |l: &[[T; 2]; 2]| {
            let (a, b) = (l[0][axis].clone(), l[1][axis].clone());
            if a <= b { (a, b) } else { (b, a) }
        };
        let ((low, high), (other_low, other_high)) = (range(s), range(t));
        low <= other_high && other_low <= high
    })
}

/// With one end shared: true when the segments leave it in the same direction.
fn fold_back<T: Exact>(s: &[[T; 2]; 2], t: &[[T; 2]; 2]) -> bool {
    let (p, q) = (usize::from(s[0] != t[0] && s[0] != t[1]), usize::from(t[0] != s[0] && t[0] != s[1]));
    let (hub, a, b) = (&s[p], &s[1 - p], &t[1 - q]);
    let along = (0..2)
        .fold(T::zero(), |sum, k| sum + (a[k].clone() - hub[k].clone()) * (b[k].clone() - hub[k].clone()));
    turn(hub, a, b).is_zero() && along.is_positive()
}

/// Positive when c lies left of the line from a to b.
pub(super) fn turn<T: Exact>(a: &[T; 2], b: &[T; 2], c: &[T; 2]) -> T {
    let minus = |p: &T, q: &T| p.clone() - q.clone();
    minus(&b[0], &a[0]) * minus(&c[1], &a[1]) - minus(&b[1], &a[1]) * minus(&c[0], &a[0])
}
