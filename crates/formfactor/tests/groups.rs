//! Points that look at a polygon together see what each sees alone.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod boards;
use boards::{board, corner, part, polygon, pose};
use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
use proptest::prelude::*;

/// Its vertices, and a place among these.
fn places(polygon: &PlanarPolygon) -> Vec<DVec3> {
    let mut places: Vec<DVec3> = polygon.loops().flatten().copied().collect();
    places.push(places.iter().sum::<DVec3>() / places.len() as f64);
    places
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn points_together_see_what_each_sees_alone(
        boards in prop::collection::vec(board(), 0..25), pose in pose(), is_bent in any::<bool>(), is_even in any::<bool>(),
        middle in prop::array::uniform2(-1.5..1.5), offsets in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 1..9),
        spread in prop_oneof![Just(0.0), Just(1e-9), Just(0.1), Just(2.0)],
        low in prop::array::uniform2(-2.0..0.0), high in prop::array::uniform2(0.1..2.0),
        tolerance in prop_oneof![Just(1e-11), Just(1e-6), Just(1e-3)],
    ) {
        let corners = [[-2.0, -2.0], [2.0, 2.0]];
        let whole = if is_bent { corner(&pose, corners) } else { part(&pose, corners) };
        let boards = boards.iter().filter_map(|board| polygon(&pose, board));
        let room = Enclosure::new(std::iter::once(whole.clone()).chain(boards).collect());
        let point = |offset: &[f64; 3]| {
            let offset = DVec3::from(*offset);
            // All on one floor that looks up, or anywhere that looks anywhere.
            let flat = if is_even { DVec3::new(1.0, 1.0, 0.0) } else { DVec3::ONE };
            let normal = if is_even { DVec3::Z } else { (offset * 2.0 + DVec3::Z).normalize() };
            let at = DVec3::new(middle[0], middle[1], 0.0) + offset * spread * flat;
            DifferentialArea::new(pose.place(at), pose.turn * normal).unwrap()
        };
        let points: Vec<DifferentialArea> = offsets.iter().map(point).collect();
        let piece = if is_bent { corner(&pose, [low, high]) } else { part(&pose, [low, high]) };
        for id in 0..room.polygons().len() {
            for (from, found) in points.iter().zip(room.form_factors(&points, id)) {
                let alone = room.form_factor(from, id);
                let allowed = alone.error_bound + found.error_bound;
                prop_assert!((found.value - alone.value).abs() <= allowed, "{id}: {found:?} is not {alone:?}");
            }
        }
        for there in room.polygons().iter().flat_map(places) {
            let each: Vec<bool> = points.iter().map(|from| room.sees(from, there)).collect();
            prop_assert_eq!(room.each_sees(&points, there), each);
        }
        for (from, found) in points.iter().zip(room.form_factors_within(&points, 0, &piece, tolerance)) {
            let alone = room.form_factor_to_part(from, 0, &piece);
            let allowed = alone.error_bound + found.error_bound;
            prop_assert!((found.value - alone.value).abs() <= allowed, "{found:?} is not {alone:?}");
        }
    }
}
