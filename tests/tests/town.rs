//! Light by clusters beside path tracing: in a town, whose ground is far larger than what stands on it, and in a room of tiles.
use radiosity::formfactor::PlanarPolygon;
use radiosity::{Method, Options, Patch, Quality, Scene, solve};
use std::ops::ControlFlow;
use tests::light::{Estimate, Surface, mean_irradiance, tiled_room, town};

const PATHS: u32 = 10_000;

fn scene(surfaces: &[Surface]) -> Scene {
    let patch = |surface: &Surface| {
        let polygon = PlanarPolygon::new(&surface.loops).expect("a polygon");
        Patch::new(&surface.name, polygon, surface.reflectance.to_vec(), surface.radiance.to_vec())
    };
    Scene { patches: surfaces.iter().map(patch).collect(), bands: 3, ..Scene::default() }
}

/// Solves by levels at draft and sets some faces beside path tracing.
fn assert_within_estimates(surfaces: &[Surface], most: f64) {
    let (mut errors, mut too_low) = (Vec::new(), 0);
    let options = Options { method: Method::Hierarchical, ..Quality::Draft.options() };
    let solution = solve(&scene(surfaces), &options, |_| ControlFlow::Continue(())).expect("a solution");
    let means = solution.patch_means(&solution.irradiance, surfaces.len());
    let transfers = solution.transfers.expect("by levels");
    assert!(solution.converged && transfers.clusters > 100, "{transfers:?}");
    let scene_mean = means.iter().map(|mean| mean[0]).sum::<f64>() / means.len() as f64;
    for of in (0..surfaces.len()).step_by(7) {
        let [Estimate { mean, error }, ..] = mean_irradiance(surfaces, of, PATHS, of as u64);
        let beyond = ((means[of][0] - mean).abs() - 3.0 * error).max(0.0);
        too_low += usize::from(beyond > solution.patch_estimate(of)[0]);
        errors.push(beyond / mean.max(0.01 * scene_mean));
    }
    let square: f64 = errors.iter().map(|error| error * error).sum();
    let root_mean_square = (square / errors.len() as f64).sqrt();
    assert!(root_mean_square < most, "{root_mean_square}");
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
