//! Solving by levels.
use crate::build::{cube, patch, polygon, room, scene, solved};
use radiosity::glam::DVec3;
use radiosity::{Error, Method, Options, Patch, Scene, State, solve, solve_from};
use std::ops::ControlFlow;

pub(crate) fn options(error: f64) -> Options {
    Options { method: Method::Hierarchical, error, ..Options::default() }
}

/// A room with a lamp below the ceiling, and a block on the floor.
pub(crate) fn furnished() -> Scene {
    let mut patches = room([0.0; 3], [3.0, 2.0, 2.0], 1, 0.7, 0.0);
    let lamp = [[1.2, 0.8, 1.9], [1.2, 1.2, 1.9], [1.6, 1.2, 1.9], [1.6, 0.8, 1.9]];
    patches.push(patch("lamp", &lamp, 0.0, 10.0));
    let mut block = room([0.4, 0.5, 0.0], [1.0, 1.1, 0.8], 1, 0.5, 0.0);
    block.retain(|side| side.polygon.normal().z > -0.5 || side.name.starts_with("upper2"));
    patches.extend(block.into_iter().map(turned_inside_out));
    scene(patches)
}

pub(crate) fn turned_inside_out(mut side: Patch) -> Patch {
    let mut corners: Vec<[f64; 3]> = side.polygon.loops().flatten().map(DVec3::to_array).collect();
    corners.reverse();
    side.polygon = polygon(&corners);
    side.name.insert_str(0, "block-");
    side
}

#[test]
fn a_furnace_is_1_whatever_it_reflects() {
    for reflectance in [0.5, 0.99, 0.999_999, 1.0 - 1e-9, 1.0 - 1e-12] {
        let solution =
            solved(&cube(1, reflectance, 1.0 - reflectance), &Options { tolerance: 1e-10, ..options(0.01) });
        for b in &solution.radiosity {
            assert!((b - 1.0).abs() < 1e-9, "{reflectance}: {b}");
        }
        assert!(solution.converged, "{reflectance}");
    }
}

/// Two unit squares face each other at distance 1: H = E F / (1 - rho F) in the mean but for what varies, and exactly E F where
/// nothing is reflected.
#[test]
fn a_square_receives_what_the_closed_form_says() {
    let floor = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    let mut ceiling = floor.map(|[x, y, _]| [x, y, 1.0]);
    ceiling.reverse();
    let lit = scene(vec![patch("floor", &floor, 0.5, 0.0), patch("ceiling", &ceiling, 0.0, 1.0)]);
    for (error, off) in [(0.1, 2e-2), (0.01, 2e-3), (0.001, 2e-4)] {
        let solution = solved(&lit, &options(error));
        let found = solution.patch_means(&solution.irradiance, 2)[0][0];
        let true_error = (found / 0.199_824_895_698_387_4 - 1.0).abs();
        assert!(true_error < off, "{true_error} at {error}");
        let estimate = solution.patch_estimate(0)[0];
        assert!(estimate <= error * 3.0 * found && estimate >= 0.0, "{estimate}");
    }
}

/// A floor and a wall on its edge: five points of each miss light.
#[test]
fn squares_that_touch_receive_what_the_closed_form_says_however_coarse_they_are() {
    let floor = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    let wall = [[0., 0., 0.], [0., 1., 0.], [0., 1., 1.], [0., 0., 1.]];
    let lit = scene(vec![patch("floor", &floor, 0.5, 0.0), patch("wall", &wall, 0.0, 1.0)]);
    for error in [0.3, 0.03] {
        let solution = solved(&lit, &options(error));
        let found = solution.patch_means(&solution.irradiance, 2)[0][0];
        let true_error = (found / 0.200_043_776_075_403_2 - 1.0).abs();
        assert!(true_error < 1e-3 && true_error * found < solution.patch_estimate(0)[0], "{true_error}");
    }
}

#[test]
fn all_power_is_accounted_for_and_the_finer_solution_is_within_the_estimates() {
    let scene = furnished();
    let [coarse, fine] = [0.03, 0.003].map(|error| solved(&scene, &options(error)));
    for solution in [&coarse, &fine] {
        let ledger = &solution.ledger;
        let spent = ledger.absorbed[0] + ledger.escaped[0] + ledger.unshot[0];
        assert!((spent / ledger.emitted[0] - 1.0).abs() < 1e-12, "{ledger:?}");
        assert!(ledger.escaped[0].abs() < 1e-2 * ledger.emitted[0], "{ledger:?}");
        assert!(solution.converged && solution.bound[0] > 0.0);
        assert!(solution.irradiance.iter().all(|h| *h >= 0.0));
    }
    let count = scene.patches.len();
    let [means, finer] = [&coarse, &fine].map(|solution| solution.patch_means(&solution.irradiance, count));
    for index in 0..count {
        let off = (means[index][0] - finer[index][0]).abs();
        let allowed = coarse.patch_estimate(index)[0] + fine.patch_estimate(index)[0];
        assert!(off <= allowed, "{}: {off} {allowed}", scene.patches[index].name);
    }
    let area: f64 = (0..fine.mesh.elements.len()).map(|element| fine.mesh.area(element)).sum();
    let whole: f64 = scene.patches.iter().map(|patch| patch.polygon.area()).sum();
    assert!((area / whole - 1.0).abs() < 1e-12);
}

#[test]
fn hardly_anything_shines_below_what_stands_on_the_floor() {
    let scene = furnished();
    let solution = solved(&scene, &options(0.01));
    let lit = solution.irradiance.iter().copied().fold(0.0, f64::max);
    let mut count = 0;
    for (index, element) in solution.mesh.elements.iter().enumerate() {
        let place = solution.mesh.centroid(index);
        let is_below = place.x > 0.4 && place.x < 1.0 && place.y > 0.5 && place.y < 1.1;
        if scene.patches[element.patch].name == "lower2-0-0" && is_below {
            count += 1;
            assert!(solution.irradiance[index] < 1e-3 * lit, "{place}: {}", solution.irradiance[index]);
        }
    }
    assert!(count > 0);
}

#[test]
fn a_run_that_was_stopped_anywhere_ends_with_the_same_bits() {
    let scene = furnished();
    let whole = solved(&scene, &options(0.03));
    for stop in [0, 1, 5, 12] {
        let mut state = State::default();
        let mut steps = 0;
        let stopped = solve_from(&scene, &options(0.03), &mut state, |progress| {
            steps += 1;
            assert_eq!(progress.solution().mesh.elements.len(), progress.solution().irradiance.len());
            if steps > stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(stopped.is_ok_and(|solution| !solution.converged));
        let mut state = State::from_bytes(&state.to_bytes()).expect("a state");
        let resumed =
            solve_from(&scene, &options(0.03), &mut state, |_| ControlFlow::Continue(())).expect("light");
        assert_eq!(whole.radiosity, resumed.radiosity, "stopped after {stop}");
        assert_eq!((&whole.ledger, &whole.estimate), (&resumed.ledger, &resumed.estimate));
    }
    let mut state = State::default();
    let go = |scene: &Scene, error, state: &mut State| {
        solve_from(scene, &options(error), state, |_| ControlFlow::Continue(()))
    };
    assert!(go(&scene, 0.1, &mut state).is_ok());
    assert!(matches!(go(&cube(1, 0.5, 1.0), 0.1, &mut state), Err(Error::Foreign)));
    let finer = go(&scene, 0.03, &mut state).expect("what was found serves any error");
    assert_eq!(finer.radiosity, whole.radiosity);
}

#[test]
fn threads_change_no_bit() {
    let scene = furnished();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| solved(&scene, &options(0.03)).radiosity)
    };
    assert_eq!(with(1), with(4));
}

#[test]
fn a_closed_room_that_reflects_all_light_is_refused_by_name() {
    let mut lit = scene(room([0.0; 3], [1.0; 3], 1, 1.0, 0.0));
    let refused = |scene: &Scene| solve(scene, &options(0.1), |_| ControlFlow::Continue(())).err();
    assert!(refused(&lit).is_none(), "what is dark may reflect as it likes");
    lit.patches[3].emission[0] = 1.0;
    let error = refused(&lit).expect("no solution");
    assert!(matches!(&error, Error::Endless { room, patches: 6, .. } if room == "lower0-0-0"), "{error}");
    lit.patches.remove(5);
    assert!(refused(&lit).is_none(), "an open room lets its light out");
}

#[test]
fn a_dark_scene_is_dark() {
    let solution = solved(&cube(1, 0.5, 0.0), &options(0.01));
    assert!(solution.converged && solution.radiosity.iter().all(|b| *b == 0.0));
    assert!(solution.estimate.is_some_and(|estimate| estimate.iter().all(|e| *e == 0.0)));
}

/// Six walls see each other with nothing in between; what stands in the way of a lamp is counted, and what faces away is no transfer.
#[test]
fn transfers_are_counted_by_how_they_were_found() {
    let transfers = |scene: &Scene| solved(scene, &options(0.1)).transfers.expect("it is by levels");
    let room = transfers(&cube(1, 0.5, 1.0));
    assert!(room.open >= 15 && [room.none, room.clusters, room.occluded] == [0; 3], "{room:?}");
    let plate = |name: &str, z: f64| {
        patch(name, &[[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]], 0.5, 1.0)
    };
    let stacked = transfers(&scene(vec![plate("one", 0.0), plate("two", 1.0), plate("three", 2.0)]));
    assert_eq!(stacked, radiosity::Transfers { none: 3, ..Default::default() });
    let furnished = transfers(&furnished());
    assert!(furnished.none > 0 && furnished.open > 0 && furnished.occluded > 0, "{furnished:?}");
}
