//! Matrices of form factors in closed rooms with what stands in them. `CLOSED_ROOMS=N` takes N rooms of each kind.
use formfactor::{AreaFormFactor, Enclosure, Limits, PlanarPolygon, Tolerance};
use glam::{DAffine3, DMat3, DVec3};
use std::env;
use tests::closed::{KINDS, Room, room};
use tests::light;

fn scene(room: &Room) -> Enclosure {
    let polygons = room.iter().map(|loops| PlanarPolygon::new(loops).expect("a polygon"));
    Enclosure::new(polygons.collect())
}

/// A room turned and moved.
fn placed(room: &Room, place: DAffine3) -> Room {
    let to = |corners: &Vec<DVec3>| corners.iter().map(|p| place.transform_point3(*p)).collect();
    room.iter().map(|loops| loops.iter().map(to).collect()).collect()
}

fn rows(scene: &Enclosure, absolute: f64) -> Vec<Vec<(usize, AreaFormFactor)>> {
    let tolerance = Tolerance { absolute, relative: 0.0, row: f64::INFINITY };
    scene.area_matrix(tolerance, &Limits::default()).expect("a tolerance").expect("no stop")
}

/// What is wrong with the matrix at a tolerance, beside one that is known to much less.
fn complaints(scene: &Enclosure, fine: &[Vec<(usize, AreaFormFactor)>], absolute: f64) -> Vec<String> {
    let mut found = Vec::new();
    for (from, row) in rows(scene, absolute).into_iter().enumerate() {
        for (to, factor) in &row {
            let exact = fine[from].iter().find(|(id, _)| id == to).map_or(Default::default(), |(_, f)| *f);
            let slack = exact.error_estimate + 1e-13;
            let error = (factor.value - exact.value).abs();
            if error > factor.error_estimate + slack || error > absolute + slack {
                found.push(format!("{from} - {to} at {absolute:e}: off by {error:e}, {factor:?}"));
            }
        }
        let sum: f64 = row.iter().map(|(_, factor)| factor.value).sum();
        let allowed: f64 = row.iter().map(|(_, factor)| factor.error_estimate).sum();
        if (sum - 1.0).abs() > allowed + 1e-12 {
            found.push(format!("row {from} at {absolute:e}: {sum}, allowed {allowed:e}"));
        }
    }
    found
}

/// Found wrong by such rooms: a wall that reaches farther than the block that hides some of it, but not with its middle.
#[test]
fn rows_of_closed_rooms_add_to_one_and_entries_are_within_their_estimates() {
    let seeds =
        env::var("CLOSED_ROOMS").ok().map_or(1, |text| text.parse().expect("CLOSED_ROOMS is a number"));
    let mut failures = Vec::new();
    for seed in 0..seeds {
        for (kind, name) in KINDS.iter().enumerate() {
            let scene = scene(&room(kind, seed));
            let fine = rows(&scene, 1e-7);
            let found = [1e-2, 1e-3, 1e-4, 1e-5].map(|absolute| complaints(&scene, &fine, absolute)).concat();
            failures.extend(found.into_iter().map(|complaint| format!("{name} {seed}: {complaint}")));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// What differs by more than both estimates and what rounded corners change between a room and the same one elsewhere.
fn differences(room: &Room, place: DAffine3) -> Vec<String> {
    let [here, there] = [room, &placed(room, place)].map(|room| rows(&scene(room), 1e-3));
    let rounded = 256.0 * f64::EPSILON * place.translation.abs().max_element();
    let mut found = Vec::new();
    for (from, row) in here.iter().enumerate() {
        for (to, factor) in row {
            let other = there[from].iter().find(|(id, _)| id == to).map_or(Default::default(), |(_, f)| *f);
            let slack = factor.error_estimate + other.error_estimate + rounded;
            if (factor.value - other.value).abs() > slack {
                found.push(format!("{from} - {to} at {}: {factor:?}, {other:?}", place.translation));
            }
        }
    }
    found
}

/// Found wrong far from the origin, where roundings are larger than what used to count as touching: lintels over doors, from which walls in
/// their planes were seen as if from inside.
#[test]
fn rooms_that_are_turned_and_far_away_have_the_same_matrix() {
    let doors = (0..2).map(|seed| light::room(2, seed).into_iter().map(|face| face.loops).collect());
    let rooms: Vec<Room> = (0..KINDS.len()).map(|kind| room(kind, 0)).chain(doors).collect();
    let turns = [DMat3::from_rotation_z(0.7), DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.1)];
    let mut failures = Vec::new();
    for (turn, far) in turns.into_iter().zip([5e5, 5e6]) {
        let place = DAffine3::from_mat3_translation(turn, far * DVec3::new(1.0, -0.7, 0.3));
        for (number, room) in rooms.iter().enumerate() {
            let found = differences(room, place);
            failures.extend(found.into_iter().map(|complaint| format!("room {number}: {complaint}")));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Found wrong: a leg of a chair that the floor was said not to see, as points of the leg's plane counted as inside of another leg.
#[test]
fn proven_intervals_far_away_hold_what_is_found_at_the_origin() {
    let place = DAffine3::from_mat3_translation(DMat3::from_rotation_z(0.7), DVec3::new(5e6, 3.5e6, 1.5e6));
    let limits = Limits { per_pair: 3000, ..Limits::default() };
    let mut failures = Vec::new();
    for kind in [2, 5] {
        let room: Room = light::room(kind, 0).into_iter().map(|face| face.loops).collect();
        let [here, there] = [&room, &placed(&room, place)].map(scene);
        for to in 1..room.len() {
            let known = here.area_form_factor(0, to, 1e-6, &limits).expect("a tolerance").expect("no stop");
            let found = there.bounded_area_form_factor(0, to, 1e-3, &limits);
            let found = found.expect("a tolerance").expect("no stop");
            if (found.value - known.value).abs() > found.error_bound + known.error_estimate {
                failures.push(format!("{kind}: 0 - {to}: {found:?}, {known:?}"));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
