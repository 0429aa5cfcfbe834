//! Laws of the solver.
use super::options::{Method, Options};
use super::progress::{Moment, Progress};
use super::{final_gather::gather, rough::Rough, run::Run, shoot::shoot};
use super::{solution::Solution, state::State};
use super::{solve, solve_from};
use crate::error::Error;
use crate::mesh::{plan::Plan, subdivide::Subdivision};
use crate::scene::sky::{Sky, SkyKind};
use crate::scene::{Scene, patch::Patch};
use formfactor::PlanarPolygon;
use glam::DVec3;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// A patch of one band.
fn patch(name: &str, corners: &[[f64; 3]], reflectance: f64, emission: f64) -> Patch {
    let corners: Vec<DVec3> = corners.iter().map(|&corner| corner.into()).collect();
    Patch::new(name, PlanarPolygon::new([corners]).unwrap(), vec![reflectance], vec![emission])
}

/// A closed room of 3 × 2 × 1, its faces seen from inside.
fn room(reflectance: f64, emission: f64) -> Scene {
    let v = |i: usize| [[0., 3.][i & 1], [0., 2.][i >> 1 & 1], [0., 1.][i >> 2]];
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let wall =
        |(k, face): (usize, &[usize; 4])| patch(&format!("wall-{k}"), &face.map(v), reflectance, emission);
    Scene { patches: faces.iter().enumerate().map(wall).collect(), bands: 1, ..Scene::default() }
}

fn quick(scene: &Scene, options: Options) -> Solution {
    solve(scene, &options, |_| ControlFlow::Continue(())).unwrap()
}

fn options(elements: usize, tolerance: f64) -> Options {
    Options { tolerance, ..Options::mesh(elements) }
}

#[test]
fn a_furnace_is_uniform() {
    // E + ρB = B with E = 1 - ρ: the exact solution is B = 1 (emission is radiance, E = πL).
    for reflectance in [0.0, 0.5, 0.9] {
        let scene = room(reflectance, (1.0 - reflectance) / std::f64::consts::PI);
        let solution = quick(&scene, options(300, 1e-8));
        assert!(solution.converged);
        assert!(solution.closure.unwrap() < 1e-12);
        for b in &solution.radiosity {
            assert!((b - 1.0).abs() <= solution.bound[0] + 1e-12, "{b}");
        }
        assert!(solution.bound[0] < 1e-5, "{:?}", solution.bound);
    }
}

/// To know whether a room is closed takes the columns of all its patches: white ones shoot first, and those that a sky lights only shoot.
#[test]
fn white_rooms_shoot_before_all_columns_are_found() {
    let mut lit = room(0.95, 0.0);
    lit.patches[2].emission[0] = 5.0;
    let mut open = room(0.95, 0.0);
    open.patches.remove(1);
    open.asset.up = DVec3::Z;
    open.sky = Some(Sky { radiance: vec![1.0], kind: SkyKind::Uniform });
    for (scene, is_lit) in [(lit, false), (open, true)] {
        let (mut is_prepared, mut shoots) = (false, false);
        let solution = solve(&scene, &options(200, 1e-6), |progress| {
            shoots |= matches!(progress.moment, Moment::Shot(..));
            is_prepared |= !shoots;
            if progress.shots == 1 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!((solution.unwrap().shots, is_prepared), (1, is_lit));
    }
}

#[test]
fn the_ledger_balances_at_every_stop() {
    let mut scene = room(0.8, 0.0);
    scene.patches[2].emission[0] = 5.0;
    for max_shots in [0, 1, 7, 1000] {
        let solution = quick(&scene, Options { max_shots, ..options(200, 1e-6) });
        let ledger = &solution.ledger;
        assert!((ledger.emitted[0] - 15.0 * std::f64::consts::PI).abs() < 1e-12);
        assert!(ledger.defect[0].abs() < 1e-12 * ledger.emitted[0]);
        let sum = ledger.absorbed[0] + ledger.escaped[0] + ledger.unshot[0];
        assert!((sum / ledger.emitted[0] - 1.0).abs() < 1e-12);
        assert!(ledger.escaped[0].abs() < 0.02 * ledger.emitted[0], "closed: {ledger:?}");
    }
}

#[test]
fn light_scales_with_the_emission_bit_for_bit() {
    let mut scene = room(0.6, 0.0);
    scene.patches[0].emission[0] = 1.0;
    let one = quick(&scene, options(200, 1e-4));
    for scale in [2f64.powi(-99), 2f64.powi(99)] {
        scene.patches[0].emission[0] = scale;
        let other = quick(&scene, options(200, 1e-4));
        let scaled: Vec<_> = one.radiosity.iter().map(|b| b * scale).collect();
        assert_eq!(scaled, other.radiosity);
    }
}

#[test]
fn threads_change_nothing() {
    let mut scene = room(0.6, 0.0);
    scene.patches[0].emission[0] = 1.0;
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| quick(&scene, options(200, 1e-4)).vertex_irradiance())
    };
    assert_eq!(with(1), with(3));
}

/// The watcher is asked within a shot too: what it ends there has the light of the shots before, and goes on to the same bits.
#[test]
fn a_run_that_is_stopped_within_a_shot_goes_on_to_the_same_bits() {
    let mut scene = room(0.6, 0.0);
    scene.patches[0].emission[0] = 1.0;
    let options = options(200, 1e-4);
    let whole = quick(&scene, options.clone());
    for last in [0, 1, 2] {
        let (mut state, mut stands) = (State::default(), None);
        let stopped = solve_from(&scene, &options, &mut state, |progress| {
            let within = stands.is_some() && progress.moment == Moment::Preparation && progress.shots == last;
            stands = Some(progress.solution().irradiance);
            if within { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let stopped = stopped.unwrap();
        assert!(!stopped.converged && stopped.shots == last, "{}", stopped.shots);
        assert_eq!(Some(stopped.irradiance), stands);
        let again = solve_from(&scene, &options, &mut state, |_| ControlFlow::Continue(())).unwrap();
        assert_eq!(again.radiosity, whole.radiosity);
        assert_eq!(again.vertex_irradiance(), whole.vertex_irradiance());
    }
}

/// All light is found, but not all that is shown: the run has not converged, and goes on to the same bits.
#[test]
fn a_run_that_is_stopped_within_the_final_gather_goes_on_to_the_same_bits() {
    let mut scene = room(0.6, 0.0);
    scene.patches[0].emission[0] = 1.0;
    let options = options(200, 1e-4);
    let mut reports = 0;
    let whole = solve(&scene, &options, |_| {
        reports += 1;
        ControlFlow::Continue(())
    });
    let whole = whole.unwrap();
    let (mut state, mut left) = (State::default(), reports - 2);
    let stopped = solve_from(&scene, &options, &mut state, |_| {
        left -= 1;
        if left <= 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let stopped = stopped.unwrap();
    assert!(!stopped.converged && stopped.shots == whole.shots);
    let again = solve_from(&scene, &options, &mut state, |_| ControlFlow::Continue(())).unwrap();
    assert!(again.converged);
    assert_eq!(again.vertex_irradiance(), whole.vertex_irradiance());
}

/// Half of the time is left to the gather: what was found until then is shown.
#[test]
fn what_was_found_until_the_time_is_up_is_gathered() {
    let mut scene = room(0.6, 0.0);
    scene.patches[0].emission[0] = 1.0;
    let timed = Options { max_seconds: Some(0.0), ..options(200, 1e-4) };
    let solution = quick(&scene, timed.clone());
    assert!(!solution.converged && solution.shots == 0 && solution.fine.is_some());
    let without = quick(&scene, Options { gather: false, ..timed });
    assert!(!without.converged && without.fine.is_none());
}

/// Six tenths of the time are gone: too much for finding light, but there is time to gather what was found, also where that is all.
#[test]
fn a_gather_has_the_rest_of_the_time() {
    let mut scene = room(0.6, 0.0);
    scene.patches[0].emission[0] = 1.0;
    let options = Options { max_seconds: Some(1e5), ..options(200, 1e-4) };
    let start = Instant::now().checked_sub(Duration::from_secs(60_000)).unwrap();
    let subdivision = Subdivision::new(&scene, &Plan::even(&scene, 200)).unwrap();
    for is_asked in [true, false] {
        let (mut state, mut watch) = (State::default(), |_: &Progress<'_>| ControlFlow::Continue(()));
        let mut run = Run::new(&scene, &options, start, &subdivision, &mut state, &mut watch).unwrap();
        assert!(!is_asked || run.report().is_break());
        assert!(run.turn_to_gather(true) && run.report().is_continue());
    }
}

/// After one shot most of the light of a bright room is still to be shot: it is shown where it would go.
#[test]
fn what_did_not_shoot_in_time_is_shown() {
    let mut scene = room(0.8, 0.0);
    scene.patches[0].emission[0] = 1.0;
    let (options, subdivision) =
        (options(600, 1e-4), Subdivision::new(&scene, &Plan::even(&scene, 600)).unwrap());
    let (mut state, mut watch) = (State::default(), |_: &Progress<'_>| ControlFlow::Continue(()));
    let mut run = Run::new(&scene, &options, Instant::now(), &subdivision, &mut state, &mut watch).unwrap();
    let count = run.factors.receivers.len();
    let mut rough = Rough::among(&scene, count, 1e-9).unwrap();
    rough.limits = vec![0.0; count];
    run.factors.take_roughly(rough);
    shoot(&mut run, 1).unwrap();
    let fine = gather(&scene, &mut run).unwrap().unwrap();
    let corner = |element: usize| fine.mesh.elements[element].corners.iter().map(|at| fine.vertices[*at]);
    let mean = |element: usize| corner(element).sum::<f64>() / 3.0;
    let shown: f64 = (0..fine.mesh.elements.len()).map(|at| fine.mesh.area(at) * mean(at)).sum();
    let received: f64 = run.light.total(&run.light.irradiance).iter().sum();
    let sent: f64 = run.light.total(&run.light.radiosity).iter().sum();
    assert!(received < 0.8 * sent, "{received} of {sent}");
    assert!((shown - sent).abs() < 0.03 * sent, "{shown} of {sent}");
}

#[test]
fn what_is_cut_among_very_many_patches_takes_no_more_than_its_time() {
    let tile = |k: i32| {
        let x = f64::from(k);
        patch("tile", &[[x, 0., 0.], [x + 0.5, 0., 0.], [x + 0.5, 1., 0.], [x, 1., 0.]], 0.5, 1.0)
    };
    let scene = Scene { patches: (0..10_001).map(tile).collect(), bands: 1, ..Scene::default() };
    let options = Options { max_seconds: Some(0.0), ..Options::default() };
    let run = solve(&scene, &options, |_| ControlFlow::Continue(()));
    assert!(matches!(run, Err(Error::Time)));
}

#[test]
fn a_dark_scene_is_dark_at_once() {
    let solution = quick(&room(0.5, 0.0), options(100, 1e-4));
    assert!(solution.converged && solution.shots == 0);
    assert!(solution.radiosity.iter().all(|&b| b == 0.0));
}

#[test]
fn light_does_not_pass_a_wall() {
    let mut scene = room(0.5, 0.0);
    scene.patches[4].emission[0] = 1.0;
    let middle = [[1.5, 0., 0.], [1.5, 0., 1.], [1.5, 2., 1.], [1.5, 2., 0.]];
    let mut back = middle;
    back.reverse();
    scene.patches.extend([patch("west", &middle, 0.5, 0.0), patch("east", &back, 0.5, 0.0)]);
    let solution = quick(&scene, options(300, 1e-6));
    let lit = solution.irradiance.iter().copied().fold(0.0, f64::max);
    for (element, &h) in solution.irradiance.iter().enumerate() {
        let patch = &scene.patches[solution.mesh.elements[element].patch];
        let dark = solution.mesh.centroid(element).x > 1.5 || patch.name == east(&scene);
        assert!(!dark || h < 1e-12 * lit, "element {element} of {} receives {h} of {lit}", patch.name);
    }
    let vertices = solution.vertex_radiosity();
    for (vertex, &b) in solution.mesh.vertices.iter().zip(&vertices) {
        assert!(vertex.x <= 1.5 + 1e-12 || b < 1e-12 * lit, "the vertex at {vertex} shows {b} of {lit}");
    }
}

/// The name of the separating wall's patch that faces away from the light.
fn east(scene: &Scene) -> &str {
    let away = scene.patches[6..].iter().find(|patch| patch.polygon.normal().x > 0.0);
    &away.unwrap().name
}

#[test]
fn what_has_no_solution_is_refused_by_name() {
    let check = |scene: &Scene| solve(scene, &Options::default(), |_| ControlFlow::Continue(())).unwrap_err();
    assert!(matches!(check(&Scene::default()), Error::NoPatches));
    for reflectance in [1.1, -0.1, f64::NAN] {
        let mut scene = room(0.5, 1.0);
        scene.patches[3].reflectance[0] = reflectance;
        assert!(matches!(check(&scene), Error::Reflectance { patch, .. } if patch == "wall-3"));
    }
    for emission in [-1.0, f64::NAN, f64::INFINITY] {
        let mut scene = room(0.5, 1.0);
        scene.patches[1].emission[0] = emission;
        assert!(matches!(check(&scene), Error::Emission { patch, .. } if patch == "wall-1"));
    }
    let mut scene = room(0.5, 1.0);
    scene.patches[1].emission.push(0.0);
    assert!(matches!(check(&scene), Error::Bands { found: 2, expected: 1, .. }));
}

/// A worker panics while it finds the factors to one patch: the light so far, and all factors so far, are kept, and a run
/// that goes on from them ends with the bits of one that nothing happened to.
#[test]
fn a_panic_of_a_worker_loses_nothing() {
    let mut scene = room(0.6, 0.0);
    scene.patches[0].emission[0] = 1.0;
    for method in [Method::Shoot, Method::Cg, Method::Gmres, Method::Matrix] {
        let options = Options { method, ..options(200, 1e-4) };
        let whole = quick(&scene, options.clone());
        let mut state = State::default();
        state.trap = Some(3);
        let mut shots = 0;
        let broken = solve_from(&scene, &options, &mut state, |progress| {
            shots = progress.shots;
            ControlFlow::Continue(())
        });
        let broken = broken.unwrap();
        let fault = broken.fault.as_ref().map(ToString::to_string).unwrap();
        assert!(fault.contains(&scene.patches[3].name) && fault.contains("injected"), "{fault}");
        assert!(!broken.converged && !state.is_empty(), "{method:?}");
        assert_eq!(broken.shots, shots);
        if method == Method::Shoot {
            let received: f64 = broken.irradiance.iter().sum();
            assert!(broken.shots > 0 && received > 0.0 && broken.ledger.defect[0].abs() < 1e-12);
        }
        let mut state = State::from_bytes(&state.to_bytes()).unwrap();
        let again = solve_from(&scene, &options, &mut state, |_| ControlFlow::Continue(())).unwrap();
        assert!(again.converged && again.fault.is_none());
        assert_eq!(again.radiosity, whole.radiosity, "{method:?}");
    }
}

/// The rooms of a wall between two, with every wall in so many parts along both sides.
fn two_rooms(parts: u32) -> Scene {
    let [x, y, z] = DVec3::AXES;
    let side = |from: DVec3, [along, up]: [DVec3; 2], emission: f64| {
        let at = |k: u32| f64::from(k) / f64::from(parts);
        let part = move |i: u32, j: u32| {
            let place = |i: u32, j: u32| (from + along * at(i) + up * at(j)).to_array();
            let corners = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
            patch("part", &corners, 0.5, emission)
        };
        (0..parts).flat_map(move |i| (0..parts).map(move |j| part(i, j))).collect::<Vec<Patch>>()
    };
    let room = |from: DVec3, lamp: f64| {
        let to = from + x + y + z;
        let faces = [
            (from, [x, y], 0.0),
            (to, [-y, -x], lamp),
            (from, [y, z], 0.0),
            (to, [-z, -y], 0.0),
            (from, [z, x], 0.0),
            (to, [-x, -z], 0.0),
        ];
        faces.into_iter().flat_map(|(from, ways, emission)| side(from, ways, emission)).collect::<Vec<_>>()
    };
    let patches = room(DVec3::ZERO, 1.0).into_iter().chain(room(x, 0.0)).collect();
    Scene { patches, bands: 1, ..Scene::default() }
}

#[test]
fn walls_in_many_parts_are_as_bright_as_whole_ones_and_dark_rooms_are_dark() {
    let by_levels = Options { method: Method::Hierarchical, error: 0.03, ..Options::default() };
    let [whole, parts] = [1, 6].map(|parts| {
        let scene = two_rooms(parts);
        let solution = quick(&scene, by_levels.clone());
        let means = solution.patch_means(&solution.irradiance, scene.patches.len());
        let of_face = means.chunks(scene.patches.len() / 12);
        of_face
            .map(|all| all.iter().map(|mean| mean[0]).sum::<f64>() / all.len() as f64)
            .collect::<Vec<f64>>()
    });
    for (one, other) in whole.iter().zip(&parts).take(6) {
        assert!((one - other).abs() < 0.02 * one, "{one} {other}");
    }
    assert_eq!(whole[6..], [0.0; 6]);
    assert_eq!(parts[6..], [0.0; 6]);
}
