//! What may hide a polygon is all that may hide its parts: behind it a part has the form factor that it has behind everything.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{Blockers, DVec3, DifferentialArea, Enclosure, PlanarPolygon};
use proptest::prelude::*;

const TOLERANCE: f64 = 1e-11;

/// A quadrangle or a triangle anywhere between the floor and the lamp: its middle, two half axes, and whether it is a triangle.
type Board = ([f64; 3], [[f64; 3]; 2], bool);

fn board() -> impl Strategy<Value = Board> {
    let free = prop::array::uniform3(-1.0..1.0);
    let even = prop::array::uniform3((-2i32..=2).prop_map(|half| f64::from(half) / 2.0));
    let axis = prop_oneof![free, even];
    (prop::array::uniform3(-1.5..1.5), prop::array::uniform2(axis), any::<bool>())
}

fn polygon((middle, axes, is_triangle): &Board) -> Option<PlanarPolygon> {
    let [u, v] = axes.map(DVec3::from);
    let middle = DVec3::from(*middle) + DVec3::Z * 2.0;
    let corners = [middle - u - v, middle + u - v, middle + u + v, middle - u + v];
    let count = if *is_triangle { 3 } else { 4 };
    PlanarPolygon::new([corners[..count].to_vec()]).ok()
}

/// A rectangle of the lamp, which faces down, between two corners.
fn part([low, high]: [[f64; 2]; 2]) -> PlanarPolygon {
    let corners = [[low[0], low[1]], [low[0], high[1]], [high[0], high[1]], [high[0], low[1]]];
    PlanarPolygon::new([corners.map(|[x, y]| [x, y, 4.0])]).unwrap()
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
    room: &Enclosure,
    from: &DifferentialArea,
    (corners, depth): ([[f64; 2]; 2], usize),
    blockers: &Blockers,
) -> Result<[f64; 2], TestCaseError> {
    let part = part(corners);
    let alone = room.form_factor_to_part(from, 0, &part);
    let (behind, own) = room.form_factor_behind(from, 0, &part, blockers, TOLERANCE);
    let off = (behind.value - alone.value).abs();
    prop_assert!(off <= behind.error_bound + alone.error_bound, "{behind:?} is not {alone:?}");
    prop_assert!(own.ids().iter().all(|id| blockers.ids().contains(id)));
    let Some(named) = room.blockers_of_part(from, 0, &part, blockers) else {
        prop_assert!(alone.value <= alone.error_bound, "{alone:?} is hidden");
        return Ok([0.0, 0.0]);
    };
    prop_assert!(behind.value == 0.0 || own.ids().iter().all(|id| named.ids().contains(id)));
    if depth == 0 {
        return Ok([behind.value, behind.error_bound]);
    }
    // By turns behind what the form factor names and behind what is named alone.
    let next = if depth % 2 == 0 && behind.value > 0.0 { &own } else { &named };
    let [one, other] = halves(corners, depth).map(|half| look(room, from, (half, depth - 1), next));
    let ([one, one_bound], [other, other_bound]) = (one?, other?);
    Ok([one + other, one_bound + other_bound])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn parts_are_hidden_by_what_may_hide_the_whole(
        boards in prop::collection::vec(board(), 0..25),
        at in prop::array::uniform2(-1.5..1.5), tilt in prop::array::uniform2(-0.8..0.8), depth in 1usize..6,
    ) {
        let whole = [[-2.0, -2.0], [2.0, 2.0]];
        let boards = boards.iter().filter_map(polygon);
        let room = Enclosure::new(std::iter::once(part(whole)).chain(boards).collect());
        let normal = DVec3::new(tilt[0], tilt[1], 1.0);
        let from = DifferentialArea::new(DVec3::new(at[0], at[1], 0.0), normal).unwrap();
        let (all, blockers) = room.form_factor_and_blockers(&from, 0, &part(whole), TOLERANCE);
        prop_assert_eq!(all, room.form_factor_within(&from, 0, &part(whole), TOLERANCE));
        if all.value > 0.0 {
            let [sum, bound] = look(&room, &from, (whole, depth), &blockers)?;
            prop_assert!((sum - all.value).abs() <= bound + all.error_bound + 1e-14, "{sum} is not {all:?}");
        }
    }
}
