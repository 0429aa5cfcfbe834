//! Walls that come in tiles are solved for as walls, by levels, and told tile by tile.
use crate::build::{cube, room, scene, solved};
use radiosity::{Camera, Method, Options, Scene, Solution, State, glam::DVec3, solve_from};
use std::ops::ControlFlow;

/// A room with a lamp in the middle of its ceiling, each wall in n × n tiles: a lamp of (n/2)² of them.
fn tiled(n: usize) -> Scene {
    let mut patches = room([0.0; 3], [3.0, 2.0, 1.0], n, 0.7, 0.0);
    let middle = n / 4..n - n / 4;
    for (i, j) in middle.clone().flat_map(|i| middle.clone().map(move |j| (i, j))) {
        let name = format!("upper2-{i}-{j}");
        let tile = patches.iter_mut().find(|patch| patch.name == name).expect("a tile of the ceiling");
        tile.emission[0] = 1.0;
    }
    scene(patches)
}

fn by_levels(error: f64) -> Options {
    Options { method: Method::Hierarchical, error, ..Options::default() }
}

/// 96 tiles, each a patch to be solved for, and 384 of seven plates: four of the latter are one of the former.
#[test]
fn tiles_receive_what_the_room_has_there() {
    let [coarse, fine] = [4, 8].map(tiled);
    let options = by_levels(0.03);
    let [of_coarse, of_fine] = [&coarse, &fine].map(|scene| solved(scene, &options));
    assert!(of_coarse.converged && of_fine.converged);
    // Light goes between pairs of plates, not of tiles, at first.
    let dark_pairs = |solution: &Solution| solution.transfers.expect("by levels").none;
    assert!(dark_pairs(&of_fine) < dark_pairs(&of_coarse) / 10);
    let mut areas = vec![0.0; fine.patches.len()];
    for (index, element) in of_fine.mesh.elements.iter().enumerate() {
        areas[element.patch] += of_fine.mesh.area(index);
    }
    for (patch, area) in fine.patches.iter().zip(&areas) {
        assert!((area / patch.polygon.area() - 1.0).abs() < 1e-8, "{}", patch.name);
    }
    let means = |solution: &Solution, scene: &Scene| {
        solution.patch_means(&solution.irradiance, scene.patches.len()).concat()
    };
    let [coarse_means, fine_means] = [means(&of_coarse, &coarse), means(&of_fine, &fine)];
    for (wall, tile) in (0..6).flat_map(|wall| (0..16).map(move |tile| (wall, tile))) {
        let (i, j) = (tile / 4, tile % 4);
        let parts = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(a, b)| 64 * wall + 8 * (2 * i + a) + 2 * j + b);
        let mean = parts.iter().map(|&part| fine_means[part]).sum::<f64>() / 4.0;
        let right = coarse_means[16 * wall + tile];
        let name = &coarse.patches[16 * wall + tile].name;
        assert!((mean - right).abs() < 0.03 * right, "{name}: {mean} in tiles, {right}");
    }
}

/// In a furnace of emittance 1 and reflectance 1/2 every tile receives 2.
#[test]
fn tiles_of_a_furnace_receive_alike() {
    let scene = cube(8, 0.5, 1.0);
    let solution = solved(&scene, &by_levels(0.1));
    assert!(solution.converged);
    for (patch, mean) in scene.patches.iter().zip(solution.patch_means(&solution.irradiance, 384)) {
        assert!((mean[0] - 2.0).abs() < 1e-12, "{}: {}", patch.name, mean[0]);
    }
}

/// The estimate of every tile is at least what it is off by, against a solution to a tenth of the error.
#[test]
fn estimates_hold_on_tiles() {
    let scene = tiled(8);
    let [rough, right] = [0.1, 0.02].map(|error| solved(&scene, &by_levels(error)));
    let means = |solution: &Solution| solution.patch_means(&solution.irradiance, 384).concat();
    let off = means(&rough).into_iter().zip(means(&right)).map(|(rough, right)| (rough - right).abs());
    let estimates = rough.estimate.as_ref().expect("by levels");
    let low = off.zip(estimates).filter(|(off, estimate)| off > estimate).count();
    assert!(low <= 384 / 20, "{low} of 384 are off by more");
}

#[test]
fn light_on_tiles_has_the_same_bits_on_any_number_of_threads_and_when_it_is_resumed() {
    let (scene, options) = (tiled(8), by_levels(0.1));
    let whole = solved(&scene, &options);
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    assert_eq!(alone.install(|| solved(&scene, &options)).irradiance, whole.irradiance);
    let (mut state, mut steps) = (State::default(), 0);
    let stopped = solve_from(&scene, &options, &mut state, |_| {
        steps += 1;
        if steps > 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!(stopped.expect("light").mesh.elements.iter().map(|element| element.patch).max(), Some(383));
    let mut state = State::from_bytes(&state.to_bytes()).expect("a state");
    let resumed = solve_from(&scene, &options, &mut state, |_| ControlFlow::Continue(())).expect("light");
    assert_eq!(resumed.irradiance, whole.irradiance);
}

#[test]
fn a_camera_sees_tiles_one_by_one() {
    let scene = tiled(8);
    let camera = Camera {
        name: "eye".into(),
        position: DVec3::new(0.1, 1.0, 0.5),
        direction: DVec3::X,
        up: DVec3::Z,
        vertical_fov: 0.1,
        aspect: 1.0,
    };
    let solution = solved(&scene, &Options { for_camera: Some(camera), ..by_levels(0.3) });
    let in_view = solution.in_view.expect("it was for a camera");
    let names = scene.patches.iter().zip(in_view).filter(|(_, is_seen)| *is_seen);
    let names: Vec<&str> = names.map(|(patch, _)| patch.name.as_str()).collect();
    // The picture is 0.29 wide and high where that wall is, which has its tiles 0.25 and 0.125 apart.
    let seen = (3..5).flat_map(|i| (2..6).map(move |j| format!("upper0-{i}-{j}"))).collect::<Vec<_>>();
    assert_eq!(names, seen);
}
