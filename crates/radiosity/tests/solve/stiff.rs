//! Closed rooms that reflect almost all light.
use crate::build::{cube, room, scene, solved};
use radiosity::{Error, Method, Options, Scene, Solution, solve};
use std::ops::ControlFlow;

/// One element per patch or two, and a tight tolerance.
fn options(method: Method, elements: usize) -> Options {
    Options { method, elements, tolerance: 1e-10, ..Options::default() }
}

#[test]
fn a_furnace_is_1_whatever_it_reflects() {
    for method in [Method::Mesh, Method::Cg, Method::Gmres, Method::Matrix] {
        for reflectance in [0.5, 0.9, 0.99, 0.9999, 0.999_999, 1.0 - 1e-9, 1.0 - 1e-12] {
            // E = 1 - rho and B = E + rho B: B = 1.
            let solution = solved(&cube(1, reflectance, 1.0 - reflectance), &options(method, 200));
            for b in &solution.radiosity {
                assert!((b - 1.0).abs() < 1e-9, "{method:?} {reflectance}: {b}");
            }
            assert!(solution.converged, "{method:?} {reflectance}");
            assert!(solution.closure.unwrap() < 1e-12);
            if reflectance > 0.9 {
                assert!(solution.scaling.unwrap() < 0.2, "{method:?}: {:?}", solution.scaling);
            }
        }
    }
}

/// The cube of 6 × 6 patches a face with one that emits, to 1e-8.
fn one_lamp(reflectance: f64, method: Method) -> Solution {
    let mut scene = cube(6, reflectance, 0.0);
    scene.patches[7].emission[0] = 1.0;
    solved(&scene, &Options { tolerance: 1e-8, ..options(method, 1) })
}

#[test]
fn one_lamp_in_a_stiff_room_takes_few_products_and_all_its_power_is_absorbed() {
    for (reflectance, most) in [(0.9, 18), (0.99, 20), (0.999_999, 25)] {
        let solution = one_lamp(reflectance, Method::Mesh);
        assert!(solution.converged && solution.shots == 0);
        assert!(solution.products <= most, "{} products at {reflectance}", solution.products);
        let ledger = &solution.ledger;
        assert!((ledger.absorbed[0] / ledger.emitted[0] - 1.0).abs() < 1e-6, "{ledger:?}");
        assert!(ledger.escaped[0].abs() < 1e-8 * ledger.emitted[0], "{ledger:?}");
    }
}

#[test]
fn the_full_matrix_and_gmres_agree_to_the_bound() {
    for reflectance in [0.5, 0.99, 0.999_999] {
        let [matrix, gmres] = [Method::Matrix, Method::Gmres].map(|method| one_lamp(reflectance, method));
        let bound = matrix.bound[0] + gmres.bound[0];
        for (a, b) in matrix.radiosity.iter().zip(&gmres.radiosity) {
            assert!((a - b).abs() <= bound + 1e-12 * a, "{a} {b} ± {bound} at {reflectance}");
        }
    }
}

#[test]
fn shooting_and_gmres_solve_the_same_system() {
    let [shot, gmres] = [Method::Shoot, Method::Gmres].map(|method| one_lamp(0.7, method));
    assert!(shot.shots > 0 && shot.products == 0 && gmres.products > 0);
    let bound = shot.bound[0] + gmres.bound[0];
    for (a, b) in shot.radiosity.iter().zip(&gmres.radiosity) {
        assert!((a - b).abs() <= bound + 1e-12, "{a} {b} ± {bound}");
    }
}

#[test]
fn a_closed_room_that_reflects_all_light_is_refused_by_name() {
    let mut scene = scene(room([0.0; 3], [1.0; 3], 1, 1.0, 0.0));
    scene.patches.extend(room([5.0; 3], [6.0; 3], 1, 0.5, 1.0));
    scene.patches[6..].iter_mut().for_each(|patch| patch.name.insert_str(0, "other-"));
    let refused =
        |scene: &Scene, method| solve(scene, &options(method, 50), |_| ControlFlow::Continue(())).err();
    for method in
        [Method::Hierarchical, Method::Mesh, Method::Shoot, Method::Cg, Method::Gmres, Method::Matrix]
    {
        assert!(refused(&scene, method).is_none(), "what is dark may reflect as it likes");
        let mut lit = scene.clone();
        lit.patches[3].emission[0] = 1.0;
        let error = refused(&lit, method).expect("no solution");
        assert!(matches!(&error, Error::Endless { room, patches: 6, .. } if room == "lower0-0-0"), "{error}");
        lit.patches.remove(5);
        assert!(refused(&lit, method).is_none(), "an open room lets its light out");
    }
}
