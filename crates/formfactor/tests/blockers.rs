//! What may hide a polygon is all that may hide its parts: behind it a part has the form factor that it has behind everything.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod boards;
use boards::{Pose, board, corner, part, polygon, pose};
use formfactor::{Blockers, DVec3, DifferentialArea, Enclosure, PlanarPolygon};
use proptest::prelude::*;

const TOLERANCE: f64 = 1e-11;

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
        pose in pose(),
        is_bent in any::<bool>(), at in prop::array::uniform2(-1.5..1.5), tilt in prop::array::uniform2(-0.8..0.8), depth in 1usize..6,
    ) {
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
