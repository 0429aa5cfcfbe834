//! Extreme scenes, each with the outcome that is promised for it.
use crate::build::{cube, patch, room, scene, solved};
use radiosity::formfactor::PlanarPolygon;
use radiosity::glam::DVec3;
use radiosity::{Error, Method, Options, Scene, Solution, solve};
use std::ops::ControlFlow;

/// The ways that [`Method::Auto`] chooses from.
const METHODS: [Method; 2] = [Method::Hierarchical, Method::Mesh];

fn options(elements: usize) -> Options {
    Options { tolerance: 1e-6, ..Options::mesh(elements) }
}

fn by_levels() -> Options {
    Options { method: Method::Hierarchical, ..options(1) }
}

/// A floor of side 4 at z = 0 that looks up, and a lamp of side 1 at z = 2 that looks down.
fn floor_and_lamp() -> Scene {
    scene(vec![
        patch("floor", &[[-2., -2., 0.], [2., -2., 0.], [2., 2., 0.], [-2., 2., 0.]], 0.5, 0.0),
        patch("lamp", &[[-0.5, 0.5, 2.], [0.5, 0.5, 2.], [0.5, -0.5, 2.], [-0.5, -0.5, 2.]], 0.5, 10.0),
    ])
}

/// The same scene, its vertices moved.
fn moved(scene: &Scene, place: impl Fn(DVec3) -> DVec3) -> Scene {
    let mut moved = scene.clone();
    for patch in &mut moved.patches {
        let loops = patch.polygon.loops().map(|points| points.iter().map(|&p| place(p)).collect::<Vec<_>>());
        patch.polygon = PlanarPolygon::new(loops.collect::<Vec<_>>()).expect("planar");
    }
    moved
}

/// Mean irradiance of a patch.
fn mean(solution: &Solution, patch: usize) -> f64 {
    let patches = solution.mesh.elements.last().map_or(0, |element| element.patch + 1);
    solution.patch_means(&solution.irradiance, patches)[patch][0]
}

#[test]
fn sizes_from_1e_minus_9_to_1e9_live_in_one_scene() {
    let mut mixed = floor_and_lamp();
    let square = |side: f64, z: f64| [[-side, -side, z], [side, -side, z], [side, side, z], [-side, side, z]];
    let reference = mean(&solved(&floor_and_lamp(), &options(400)), 0);
    mixed.patches.push(patch("speck", &square(1e-9, 1e-3), 0.5, 0.0));
    mixed.patches.push(patch("world", &square(1e9, -1.0), 0.5, 0.0));
    // The world gets no more of the elements than half, and half its share of the light: the floor's light stays right. The light on
    // the world, all under one of its elements, is not resolved; the power still adds up.
    let solution = solved(&mixed, &options(400));
    assert!(solution.radiosity.iter().all(|b| b.is_finite() && *b >= 0.0));
    assert!(
        solution.converged && solution.shots < 1000,
        "a speck without power waits for its turn: {}",
        solution.shots
    );
    assert!(solution.ledger.defect[0].abs() < 1e-9 * solution.ledger.emitted[0]);
    assert!((mean(&solution, 0) / reference - 1.0).abs() < 0.05, "{} {reference}", mean(&solution, 0));
    let speck = mean(&solution, 2);
    // Straight under the lamp: the form factor of a coaxial square of half-width 1/2 at height 2 - 1e-3, as measured on the
    // floor's middle.
    assert!((speck / (10.0 * 0.075_2) - 1.0).abs() < 0.1, "{speck}");
}

#[test]
fn a_scene_far_from_the_origin_looks_as_at_the_origin() {
    let away = moved(&floor_and_lamp(), |p| p + DVec3::new(1e6, -1e6, 1e6));
    for method in METHODS {
        let [near, far] =
            [&floor_and_lamp(), &away].map(|scene| solved(scene, &Options { method, ..options(300) }));
        assert_eq!(near.mesh.elements.len(), far.mesh.elements.len());
        for (a, b) in near.irradiance.iter().zip(&far.irradiance) {
            assert!((a - b).abs() < 1e-8 * 10.0, "{method:?}: {a} {b}");
        }
    }
}

#[test]
fn slivers_of_aspect_1e8_receive_and_send() {
    let mut slivers = floor_and_lamp();
    for k in 0..4 {
        let x = f64::from(k) * 0.3 - 0.5;
        let corners = [[x, -1., 1.], [x + 2e-8, -1., 1.], [x + 2e-8, 1., 1.], [x, 1., 1.]];
        slivers.patches.push(patch(format!("sliver-{k}"), &corners, 0.5, 0.0));
    }
    for method in METHODS {
        let [with, without] =
            [&slivers, &floor_and_lamp()].map(|scene| solved(scene, &Options { method, ..options(300) }));
        assert!((2..6).all(|sliver| mean(&with, sliver) > 0.0));
        let change = (mean(&with, 0) / mean(&without, 0) - 1.0).abs();
        assert!(change < 1e-6, "{method:?}: they hide next to nothing: {change}");
    }
}

#[test]
fn duplicated_and_overlapping_faces_are_refused_by_name() {
    let refused = |scene: &Scene| solve(scene, &by_levels(), |_| ControlFlow::Continue(())).unwrap_err();
    let overlapping = |corners: &[[f64; 3]]| {
        let mut scene = floor_and_lamp();
        scene.patches.push(patch("other", corners, 0.5, 0.0));
        scene
    };
    let same = overlapping(&[[-2., -2., 0.], [2., -2., 0.], [2., 2., 0.], [-2., 2., 0.]]);
    let part = overlapping(&[[1., 1., 0.], [3., 1., 0.], [3., 3., 0.], [1., 3., 0.]]);
    for scene in [same, part] {
        let error = refused(&scene);
        assert!(
            matches!(&error, Error::Overlap { first, second, .. } if first == "floor" && second == "other"),
            "{error}"
        );
    }
    let beside = overlapping(&[[2., 2., 0.], [3., 2., 0.], [3., 3., 0.], [2., 3., 0.]]);
    let back = overlapping(&[[-2., 2., 0.], [2., 2., 0.], [2., -2., 0.], [-2., -2., 0.]]);
    for (scene, options) in
        [(&beside, options(50)), (&beside, by_levels()), (&back, options(50)), (&back, by_levels())]
    {
        assert!(solve(scene, &options, |_| ControlFlow::Continue(())).is_ok());
    }
}

#[test]
fn t_junctions_and_touching_edges_let_no_light_through() {
    // A closed cube whose top is cut in 3 × 3 and whose bottom in 2 × 2: no vertex of the one meets an edge's middle alike.
    let whole = cube(1, 0.5, 1.0);
    let mut patches = room([0.0; 3], [1.0; 3], 3, 0.5, 1.0);
    patches.retain(|patch| patch.name.starts_with("upper2"));
    patches
        .extend(room([0.0; 3], [1.0; 3], 2, 0.5, 1.0).into_iter().filter(|p| p.name.starts_with("lower2")));
    patches.extend(whole.patches.iter().filter(|p| !p.name.contains("r2-")).cloned());
    let closed = scene(patches);
    let solution = solved(&closed, &options(200));
    assert!(solution.closure.unwrap() < 1e-12, "{:?}", solution.closure);
    assert!(solution.radiosity.iter().all(|b| (b - 2.0).abs() < 1e-4));
    let solution = solved(&closed, &by_levels());
    assert!(solution.radiosity.iter().all(|b| (b - 2.0).abs() < 1e-4));
}

#[test]
fn emission_may_be_1e_minus_30_or_1e30() {
    let shine = |method: Method, emission: f64| {
        let mut scene = floor_and_lamp();
        scene.patches[1].emission[0] = emission;
        solved(&scene, &Options { method, ..options(200) })
    };
    for method in METHODS {
        let one = shine(method, 1.0);
        for power in [1e-30, 1e30] {
            let other = shine(method, power);
            assert!(other.converged);
            for (a, b) in one.irradiance.iter().zip(&other.irradiance) {
                assert!((a * power - b).abs() <= 1e-5 * b.abs(), "{method:?}: {a} {b}");
            }
        }
    }
}

#[test]
fn the_unit_of_power_changes_no_bit() {
    let shine = |method: Method, emission: f64| {
        let mut lit = cube(1, 0.5, 0.0);
        lit.patches[0].emission[0] = emission;
        let solution = solved(&lit, &Options { method, ..options(60) });
        assert!(solution.converged, "{method:?} {emission}");
        solution.radiosity
    };
    for method in [Method::Shoot, Method::Matrix, Method::Cg, Method::Gmres, Method::Hierarchical] {
        let one = shine(method, 1.0);
        // Their squares are beyond the range of doubles.
        for unit in [2f64.powi(-700), 2f64.powi(700)] {
            let scaled: Vec<f64> = one.iter().map(|b| b * unit).collect();
            assert_eq!(shine(method, unit), scaled, "{method:?}");
        }
    }
}

#[test]
fn light_beyond_the_range_is_refused_by_name() {
    let refused = |scene: &Scene| solve(scene, &options(50), |_| ControlFlow::Continue(())).unwrap_err();
    let mut bright = floor_and_lamp();
    bright.patches[1].emission[0] = 1e300;
    assert!(matches!(refused(&bright), Error::Bright { patch, band: 0, value: 1e300 } if patch == "lamp"));
    let mut wide = moved(&floor_and_lamp(), |p| 1e50 * p);
    wide.patches[1].emission[0] = 1e200;
    assert!(matches!(refused(&wide), Error::Bright { .. }));
    wide.patches[1].emission[0] = 1e180;
    for method in METHODS {
        let solution = solved(&wide, &Options { method, ..options(50) });
        assert!(solution.converged && solution.ledger.emitted[0].is_finite());
        assert!(solution.radiosity.iter().all(|b| b.is_finite()));
    }
}

#[test]
fn a_faint_band_is_solved_beside_a_strong_one() {
    let mut mixed = floor_and_lamp();
    mixed.bands = 2;
    for patch in &mut mixed.patches {
        patch.reflectance = vec![0.5; 2];
        patch.emission = vec![1e30 * patch.emission[0], patch.emission[0]];
    }
    for method in METHODS {
        let [both, faint] =
            [&mixed, &floor_and_lamp()].map(|scene| solved(scene, &Options { method, ..options(200) }));
        assert!(both.converged);
        let enough = both.bound[1] + faint.bound[0] + 1e-12;
        for (bands, alone) in both.irradiance.chunks(2).zip(&faint.irradiance) {
            assert!((bands[1] - alone).abs() <= enough, "{method:?}: {bands:?} {alone}");
            assert!((bands[0] / 1e30 - alone).abs() <= enough, "{method:?}: {bands:?} {alone}");
        }
    }
}

#[test]
fn ten_thousand_occluders_before_a_lamp_hide_their_share() {
    let mut scene = floor_and_lamp();
    // A lattice of 100 × 100 squares right under the lamp, each covering a quarter of its cell.
    for k in 0..10_000 {
        let (x, y) = (f64::from(k % 100) * 0.01 - 0.5, f64::from(k / 100) * 0.01 - 0.5);
        let (z, side) = (1.999, 0.005);
        let corners = [[x, y, z], [x + side, y, z], [x + side, y + side, z], [x, y + side, z]];
        scene.patches.push(patch(format!("blind-{k}"), &corners, 0.0, 0.0));
    }
    scene.patches.swap(2, 0);
    scene.patches.swap(0, 2);
    let quick = Options { tolerance: 1e-2, ..options(40) };
    let open = mean(&solved(&floor_and_lamp(), &quick), 0);
    let hidden = mean(&solved(&scene, &quick), 0);
    assert!((hidden / open - 0.75).abs() < 0.02, "{}", hidden / open);
}

#[test]
fn a_flipped_patch_receives_nothing_and_still_hides() {
    let mut flipped = floor_and_lamp();
    let down = [[-2., 2., 1.], [2., 2., 1.], [2., -2., 1.], [-2., -2., 1.]];
    flipped.patches.push(patch("flipped", &down, 0.5, 0.0));
    for method in METHODS {
        let [with, without] =
            [&flipped, &floor_and_lamp()].map(|scene| solved(scene, &Options { method, ..options(200) }));
        assert_eq!(mean(&with, 2), 0.0);
        assert!(mean(&with, 0) < mean(&without, 0));
    }
}

#[test]
fn zero_area_and_non_planar_faces_are_refused_as_polygons() {
    let line = [[0., 0., 0.], [1., 0., 0.], [2., 0., 0.]];
    let bent = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.1], [0., 1., 0.]];
    for corners in [&line[..], &bent[..]] {
        assert!(PlanarPolygon::new([corners]).is_err());
    }
}
