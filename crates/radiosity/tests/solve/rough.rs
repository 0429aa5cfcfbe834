//! Form factors that are taken roughly: less work, and no more error than the bound says.
use crate::build::{patch, room, scene, solved};
use radiosity::formfactor::PlanarPolygon;
use radiosity::{Error, Method, Options, Quality, Scene, State, solve_from};
use std::ops::ControlFlow;

/// A room with a lamp, a board in the middle, and small plates above the board and below it.
fn plates(reflectance: f64) -> Scene {
    let mut patches = room([0.0; 3], [4.0, 4.0, 3.0], 1, reflectance, 0.0);
    patches[5].emission[0] = 1.0;
    let level = |[x, y, z]: [f64; 3], half: f64, looks_up: bool| {
        let mut corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[along, across]| [x + half * along, y + half * across, z]);
        if !looks_up {
            corners.reverse();
        }
        patch("plate", &corners, reflectance, 0.0)
    };
    for looks_up in [true, false] {
        patches.push(level([2.0, 2.0, 1.0], 1.0, looks_up));
        let [low, high] = if looks_up { [1.1, 1.3] } else { [0.7, 0.9] };
        for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (i, j))) {
            let height = if (i + j) % 2 == 0 { low } else { high };
            patches.push(level([1.2 + 0.2 * f64::from(i), 1.2 + 0.2 * f64::from(j), height], 0.03, looks_up));
        }
    }
    scene(patches)
}

fn draft(rough: f64) -> Options {
    Options { method: Method::Mesh, elements: 400, rough, gather: false, ..Quality::Draft.options() }
}

#[test]
fn what_is_taken_roughly_is_within_the_bound() {
    for reflectance in [0.1, 0.5, 0.85] {
        let scene = plates(reflectance);
        let exact = solved(&scene, &draft(0.0));
        for share in [1e-4, 3e-3, 0.03] {
            let rough = solved(&scene, &draft(share));
            let off =
                exact.radiosity.iter().zip(&rough.radiosity).map(|(exact, rough)| (exact - rough).abs());
            let off = off.fold(0.0, f64::max);
            assert!(off > 0.0 || share < 1e-3);
            assert!(off <= exact.bound[0] + rough.bound[0], "{reflectance} {share}: {off:e}");
            let [of_exact, of_rough] =
                [&exact, &rough].map(|solution| solution.irradiance.iter().sum::<f64>());
            assert!(
                (of_rough / of_exact - 1.0).abs() < share / 4.0,
                "{reflectance} {share}: {of_rough} {of_exact}"
            );
            assert!(exact.closure.is_some() && rough.closure.is_none());
        }
    }
}

#[test]
fn a_rough_run_resumes_with_the_same_bits_and_an_exact_one_finds_its_own() {
    let scene = plates(0.5);
    let [exact, whole] = [0.0, 3e-3].map(|share| solved(&scene, &draft(share)));
    for stop in [1, 20, 60] {
        let (mut state, mut steps) = (State::default(), 0);
        let stopped = solve_from(&scene, &draft(3e-3), &mut state, |_| {
            steps += 1;
            if steps > stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(stopped.is_ok_and(|solution| !solution.converged));
        let mut state = State::from_bytes(&state.to_bytes()).expect("a state");
        for (share, expected) in [(3e-3, &whole), (0.0, &exact)] {
            let resumed = solve_from(&scene, &draft(share), &mut state, |_| ControlFlow::Continue(()));
            assert_eq!(resumed.expect("light").radiosity, expected.radiosity, "{share} stopped after {stop}");
        }
        let finer = Options { elements: 2000, ..draft(3e-3) };
        let foreign = solve_from(&scene, &finer, &mut state, |_| ControlFlow::Continue(()));
        assert!(matches!(foreign, Err(Error::Foreign)));
    }
}

#[test]
fn the_unit_of_length_changes_nothing() {
    let scene = plates(0.5);
    let one = solved(&scene, &draft(3e-3));
    for unit in [2f64.powi(-90), 2f64.powi(90)] {
        let mut scaled = scene.clone();
        for patch in &mut scaled.patches {
            let loops = patch.polygon.loops();
            let loops = loops.map(|points| points.iter().map(|point| unit * *point).collect::<Vec<_>>());
            patch.polygon = PlanarPolygon::new(loops).expect("planar");
        }
        assert_eq!(solved(&scaled, &draft(3e-3)).radiosity, one.radiosity, "{unit:e}");
    }
}

#[test]
fn threads_change_no_bit() {
    let scene = plates(0.5);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| solved(&scene, &draft(3e-3)).radiosity)
    };
    assert_eq!(with(1), with(3));
}
