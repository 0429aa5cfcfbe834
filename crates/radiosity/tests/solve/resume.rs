//! Interrupt and resume: a stopped run goes on, and ends with the bits of a run that was never stopped.
use crate::build::{cube, room, scene, solved};
use radiosity::{Error, Method, Options, State, solve, solve_from};
use std::ops::ControlFlow;

fn lit_room() -> radiosity::Scene {
    let mut scene = scene(room([0.0; 3], [3.0, 2.0, 1.0], 1, 0.7, 0.0));
    scene.patches[2].emission[0] = 1.0;
    scene
}

#[test]
fn a_run_that_was_stopped_anywhere_ends_with_the_same_bits() {
    let scene = lit_room();
    for method in [Method::Shoot, Method::Cg, Method::Gmres] {
        let options = Options { method, elements: 300, tolerance: 1e-5, ..Options::default() };
        let whole = solved(&scene, &options);
        for stop in [1, 4, 30, 90] {
            let mut state = State::default();
            let mut steps = 0;
            let stopped = solve_from(&scene, &options, &mut state, |_| {
                steps += 1;
                if steps > stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            assert!(stopped.is_ok_and(|solution| !solution.converged || steps <= stop));
            let mut state = State::from_bytes(&state.to_bytes()).expect("a state");
            let resumed =
                solve_from(&scene, &options, &mut state, |_| ControlFlow::Continue(())).expect("light");
            assert_eq!(whole.radiosity, resumed.radiosity, "{method:?} stopped after {stop}");
            assert_eq!((whole.ledger.clone(), whole.bound.clone()), (resumed.ledger, resumed.bound));
        }
    }
}

#[test]
fn a_run_by_hemicubes_resumes_from_its_state() {
    let scene = lit_room();
    let options = Options { hemicube: Some(32), ..Options::mesh(100) };
    let whole = solved(&scene, &options);
    let (mut state, mut shots) = (State::default(), 0);
    let stopped = solve_from(&scene, &options, &mut state, |progress| {
        shots = progress.shots;
        if shots > 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(stopped.is_ok_and(|solution| !solution.converged) && !state.is_empty());
    let resumed = solve_from(&scene, &options, &mut state, |_| ControlFlow::Continue(()));
    assert_eq!(resumed.expect("light").radiosity, whole.radiosity);
}

#[test]
fn a_state_of_another_scene_or_mesh_is_refused() {
    let options = Options::mesh(100);
    let mut state = State::default();
    let go = |scene: &radiosity::Scene, options: &Options, state: &mut State| {
        solve_from(scene, options, state, |_| ControlFlow::Continue(()))
    };
    assert!(go(&lit_room(), &options, &mut state).is_ok());
    let finer = Options { elements: 200, ..options.clone() };
    assert!(matches!(go(&lit_room(), &finer, &mut state), Err(Error::Foreign)));
    assert!(matches!(go(&cube(1, 0.5, 1.0), &options, &mut state), Err(Error::Foreign)));
    let tighter = Options { tolerance: 1e-6, method: Method::Cg, ..options.clone() };
    assert!(go(&lit_room(), &tighter, &mut state).is_ok(), "what was found serves any tolerance and method");
}

#[test]
fn threads_change_no_bit() {
    let scene = lit_room();
    for method in [Method::Shoot, Method::Cg, Method::Gmres, Method::Matrix] {
        let options = Options { method, elements: 300, ..Options::default() };
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| solved(&scene, &options).radiosity)
        };
        assert_eq!(with(1), with(4), "{method:?}");
    }
}

#[test]
fn every_step_has_a_bound_that_holds_and_a_ledger_that_balances() {
    let scene = lit_room();
    for method in [Method::Shoot, Method::Cg, Method::Gmres] {
        let options = Options { method, elements: 120, tolerance: 1e-7, spread: 1e-9, ..Options::default() };
        let mut steps = 0;
        let solution = solve(&scene, &options, |progress| {
            steps += 1;
            let ledger = progress.ledger;
            let sum = ledger.absorbed[0] + ledger.escaped[0] + ledger.unshot[0] + ledger.defect[0];
            assert!((sum / ledger.emitted[0] - 1.0).abs() < 1e-12, "{method:?}: {ledger:?}");
            assert!(ledger.defect[0].abs() < 1e-9 * ledger.emitted[0]);
            ControlFlow::Continue(())
        });
        assert!(steps > 3 && solution.is_ok_and(|solution| solution.converged));
    }
}

#[test]
fn the_bound_holds_at_every_shot() {
    let scene = lit_room();
    // With the front at the mesh's cells from the start nothing but the shots changes the discrete system.
    let options = Options {
        method: Method::Shoot,
        elements: 60,
        tolerance: 1e-12,
        spread: 1e-12,
        ..Options::default()
    };
    let end = solved(&scene, &options);
    let mut previous = f64::INFINITY;
    let watched = solve(&scene, &options, |progress| {
        if progress.shots > 60 {
            let now = progress.solution();
            let error =
                now.radiosity.iter().zip(&end.radiosity).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(error <= progress.bound[0] * (1.0 + 1e-6) + 1e-11, "{error} {}", progress.bound[0]);
            previous = previous.min(progress.bound[0]);
        }
        ControlFlow::Continue(())
    });
    assert!(watched.is_ok() && previous < 1e-9);
}

#[test]
fn the_ambient_term_is_what_is_missing_of_a_furnace() {
    // In a closed room of one reflectance all unshot power ends as absorbed, evenly: Σ A (1 − ρ) H.
    let scene = cube(1, 0.8, 1.0);
    let whole = solved(&scene, &Options { tolerance: 1e-9, ..Options::mesh(100) });
    let stopped = solve(&scene, &Options::mesh(100), |progress| {
        if progress.shots >= 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let stopped = stopped.expect("light");
    let power = |solution: &radiosity::Solution| {
        (0..solution.mesh.elements.len()).map(|e| solution.mesh.area(e) * solution.irradiance[e]).sum::<f64>()
    };
    assert!(power(&stopped) < 0.5 * power(&whole));
    assert!((power(&stopped.with_ambient()) / power(&whole) - 1.0).abs() < 0.02);
    assert!(whole.ambient()[0] < 1e-6);
}
