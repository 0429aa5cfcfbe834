//! What may hide a polygon is all that may hide its parts: behind it a part has the form factor that it has behind everything.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::glam::DQuat;
use formfactor::{Blockers, DVec3, DifferentialArea, Enclosure, PlanarPolygon};
use proptest::prelude::*;

const TOLERANCE: f64 = 1e-11;

/// A triangle, a quadrangle or a frame anywhere between the floor and the lamp: its middle, two half axes, and which of the three it is.
type Board = ([f64; 3], [[f64; 3]; 2], usize);

fn board() -> impl Strategy<Value = Board> {
    let free = prop::array::uniform3(-1.0..1.0);
    let even = prop::array::uniform3((-2i32..=2).prop_map(|half| f64::from(half) / 2.0));
    let axis = prop_oneof![free, even];
    (prop::array::uniform3(-1.5..1.5), prop::array::uniform2(axis), 0usize..3)
}

fn polygon(pose: &Pose, (middle, axes, kind): &Board) -> Option<PlanarPolygon> {
    let [u, v] = axes.map(DVec3::from);
    let middle = DVec3::from(*middle) + DVec3::Z * 2.0;
    let ring = |size: f64| {
        let [u, v] = [u * size, v * size];
        [middle - u - v, middle + u - v, middle + u + v, middle - u + v].map(|corner| pose.place(corner))
    };
    let loops = match kind {
        0 => vec![ring(1.0)[..3].to_vec()],
        1 => vec![ring(1.0).to_vec()],
        _ => vec![ring(1.0).to_vec(), ring(-0.5).iter().rev().copied().collect()],
    };
    PlanarPolygon::new(loops).ok()
}

/// How all is turned and enlarged: what lies in a plane does so but for roundings.
struct Pose {
    turn: DQuat,
    size: f64,
}

impl Pose {
    fn place(&self, point: DVec3) -> DVec3 {
        self.turn * point * self.size
    }
}

/// A rectangle of the lamp, which faces down, between two corners.
fn part(pose: &Pose, [low, high]: [[f64; 2]; 2]) -> PlanarPolygon {
    let corners = [[low[0], low[1]], [low[0], high[1]], [high[0], high[1]], [high[0], low[1]]];
    on_lamp(pose, corners.to_vec())
}

/// That without a quarter: it is not convex.
fn corner(pose: &Pose, [low, high]: [[f64; 2]; 2]) -> PlanarPolygon {
    let [x, y] = [0, 1].map(|axis| low[axis].midpoint(high[axis]));
    let [[left, near], [right, far]] = [low, high];
    on_lamp(pose, vec![[left, near], [left, far], [x, far], [x, y], [right, y], [right, near]])
}

fn on_lamp(pose: &Pose, corners: Vec<[f64; 2]>) -> PlanarPolygon {
    let corners: Vec<DVec3> = corners.into_iter().map(|[x, y]| pose.place(DVec3::new(x, y, 4.0))).collect();
    PlanarPolygon::new([corners]).unwrap()
}

fn halves([low, high]: [[f64; 2]; 2], depth: usize) -> [[[f64; 2]; 2]; 2] {
    let (axis, mut first_high, mut second_low) = (depth % 2, high, low);
    let middle = low[axis].midpoint(high[axis]);
    first_high[axis] = middle;
    second_low[axis] = middle;
    [[low, first_high], [second_low, high]]
}

/// Looks at all parts down to some depth, and returns the sum over the smallest, and of all bounds.
fn look(
    (pose, room): (&Pose, &Enclosure),
    from: &DifferentialArea,
    (corners, depth): ([[f64; 2]; 2], usize),
    blockers: &Blockers,
) -> Result<[f64; 2], TestCaseError> {
    let behind = |part: &PlanarPolygon, blockers: &Blockers| {
        let (behind, own) = room.form_factor_behind(from, 0, part, blockers, TOLERANCE);
        let alone = room.form_factor_to_part(from, 0, part);
        let off = (behind.value - alone.value).abs();
        prop_assert!(off <= behind.error_bound + alone.error_bound, "{behind:?} is not {alone:?}");
        prop_assert!(own.ids().iter().all(|id| blockers.ids().contains(id)));
        Ok((behind, own))
    };
    behind(&corner(pose, corners), blockers)?;
    let part = part(pose, corners);
    let (alone, own) = behind(&part, blockers)?;
    behind(&part, &own)?;
    let Some(named) = room.blockers_of_part(from, 0, &part, blockers) else {
        prop_assert!(alone.value <= alone.error_bound, "{alone:?} is hidden");
        return Ok([0.0, 0.0]);
    };
    // The exact route names all that it was given, so that neither has to contain the other: each is enough.
    behind(&part, &named)?;
    if depth == 0 {
        return Ok([alone.value, alone.error_bound]);
    }
    // By turns behind what the form factor names and behind what is named alone.
    let next = if depth % 2 == 0 { &own } else { &named };
    let [one, other] = halves(corners, depth).map(|half| look((pose, room), from, (half, depth - 1), next));
    let ([one, one_bound], [other, other_bound]) = (one?, other?);
    Ok([one + other, one_bound + other_bound])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn parts_are_hidden_by_what_may_hide_the_whole(
        boards in prop::collection::vec(board(), 0..25),
        turn in prop_oneof![Just([0.0; 3]), prop::array::uniform3(-3.0..3.0)], size in prop_oneof![Just(1.0), Just(1e-6), Just(39.37), Just(1e5)],
        is_bent in any::<bool>(), at in prop::array::uniform2(-1.5..1.5), tilt in prop::array::uniform2(-0.8..0.8), depth in 1usize..6,
    ) {
        let pose = Pose { turn: DQuat::from_scaled_axis(turn.into()), size };
        let corners = [[-2.0, -2.0], [2.0, 2.0]];
        let whole = if is_bent { corner(&pose, corners) } else { part(&pose, corners) };
        let boards = boards.iter().filter_map(|board| polygon(&pose, board));
        let room = Enclosure::new(std::iter::once(whole.clone()).chain(boards).collect());
        let normal = pose.turn * DVec3::new(tilt[0], tilt[1], 1.0);
        let from = DifferentialArea::new(pose.place(DVec3::new(at[0], at[1], 0.0)), normal).unwrap();
        let (all, blockers) = room.form_factor_and_blockers(&from, 0, &whole, TOLERANCE);
        prop_assert_eq!(all, room.form_factor_within(&from, 0, &whole, TOLERANCE));
        // Of one that is not convex the quarters that it has.
        let (start, depth) = if is_bent { ([[-2.0, -2.0], [0.0, 2.0]], depth - 1) } else { (corners, depth) };
        let [sum, bound] = look((&pose, &room), &from, (start, depth), &blockers)?;
        let rest = if is_bent { all.value - sum } else { (sum - all.value).abs() };
        prop_assert!(rest >= -bound - all.error_bound - 1e-14);
        prop_assert!(is_bent || rest <= bound + all.error_bound + 1e-14, "{sum} is not {all:?}");
    }
}
