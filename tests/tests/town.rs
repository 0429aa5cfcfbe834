//! Light by clusters beside path tracing: in a town, whose ground is far larger than what stands on it, and in a room of tiles.
#[path = "../examples/beside_paths/mod.rs"]
mod beside_paths;

use beside_paths::{errors, root_mean_square, scene};
use radiosity::{Method, Options, Quality, solve};
use std::ops::ControlFlow;
use tests::light::{Surface, mean_irradiance, tiled_room, town};

const PATHS: u32 = 10_000;

/// Solves by levels at draft and sets some faces beside path tracing.
fn assert_within_estimates(surfaces: &[Surface], most: f64) {
    let options = Options { method: Method::Hierarchical, ..Quality::Draft.options() };
    let scene = scene(surfaces).expect("polygons");
    let solution = solve(&scene, &options, |_| ControlFlow::Continue(())).expect("a solution");
    let transfers = solution.transfers.expect("by levels");
    assert!(solution.converged && transfers.clusters > 100, "{transfers:?}");
    let faces: Vec<usize> = (0..surfaces.len()).step_by(7).collect();
    let traced: Vec<_> = faces.iter().map(|of| mean_irradiance(surfaces, *of, PATHS, *of as u64)).collect();
    let errors = errors(&solution, surfaces.len(), &faces, &traced);
    let too_low = errors.iter().filter(|(.., is_low)| *is_low).count();
    assert!(root_mean_square(&errors) < most, "{}", root_mean_square(&errors));
    assert!(20 * too_low <= errors.len(), "{too_low} of {}", errors.len());
}

#[test]
fn a_town_has_the_light_that_paths_find_within_its_estimates() {
    assert_within_estimates(&town(6, 0), 0.015);
}

/// What boxes cover is in no closed room, though all that is seen is.
#[test]
fn a_tiled_room_has_the_light_that_paths_find_beside_boxes_that_cover_tiles() {
    assert_within_estimates(&tiled_room(), 0.015);
}
