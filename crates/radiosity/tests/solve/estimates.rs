//! How wrong light found by levels is said to be.
use crate::build::{patch, room, scene, seen, solved, views};
use crate::levels::{furnished, options, turned_inside_out};
use radiosity::glam::{DAffine3, DVec2, DVec3};
use radiosity::{Image, Scene, Texture, scenes};
use std::sync::Arc;

/// The largest estimate of a patch, as a share of its mean irradiance or of 1 % of the scene's.
fn worst(scene: &Scene, solution: &radiosity::Solution) -> f64 {
    let means = solution.patch_means(&solution.irradiance, scene.patches.len());
    let areas = scene.patches.iter().map(|patch| patch.polygon.area());
    let power: f64 = means.iter().zip(areas.clone()).map(|(mean, area)| mean[0] * area).sum();
    let dark = 0.01 * power / areas.sum::<f64>();
    let share = |patch: usize| solution.patch_estimate(patch)[0] / means[patch][0].max(dark);
    (0..means.len()).map(share).fold(0.0, f64::max)
}

/// Plates that pass through each other: light jumps where they meet, so that budgets of links do not tell all.
#[test]
fn a_run_has_converged_where_every_estimate_is_within_the_error() {
    let mut crossed = furnished();
    let plate = [[0.2, 0.6, 0.3], [1.4, 0.9, 0.35], [1.4, 0.9, 1.1], [0.2, 0.6, 1.05]];
    let back: Vec<[f64; 3]> = plate.iter().rev().copied().collect();
    crossed.patches.push(patch("plate", &plate, 0.6, 0.0));
    crossed.patches.push(patch("plate, back", &back, 0.6, 0.0));
    for error in [0.1, 0.05, 0.03] {
        for scene in [&crossed, &furnished()] {
            let solution = solved(scene, &options(error));
            assert_eq!(solution.converged, worst(scene, &solution) <= error, "{error}");
        }
    }
    let clean = furnished();
    assert!(solved(&clean, &options(0.03)).converged);
}

/// The share of patches whose mean irradiance at an error is within the estimate, as far as a run to an eighth of it tells.
fn within_estimates(scene: &Scene, error: f64) -> f64 {
    let [coarse, fine] = [error, error / 8.0].map(|error| solved(scene, &options(error)));
    let count = scene.patches.len();
    let [means, finer] = [&coarse, &fine].map(|solution| solution.patch_means(&solution.irradiance, count));
    let is_within =
        |index: &usize| (means[*index][0] - finer[*index][0]).abs() <= coarse.patch_estimate(*index)[0];
    (0..count).filter(is_within).count() as f64 / count as f64
}

/// At least 95 % of a scene's patches are within their estimates.
fn hold(name: &str, errors: &[f64], views: &[DAffine3]) {
    let scene = scenes::scene(name).expect("a built-in scene");
    for view in views {
        for error in errors {
            let share = within_estimates(&seen(&scene, *view), *error);
            assert!(share >= 0.95, "{name} at {error}: {share}, in {view}");
        }
    }
}

/// What a hundred parts of a lamp bring bends the light of a tile one way: errors add up, they are not independent. All parts see a plane the same
/// way, from peak to tail, where five points say that nothing bends.
#[test]
fn estimates_hold_however_a_lamp_is_cut() {
    hold("emission", &[0.03, 0.01], &views());
    hold("sphere-lamp", &[0.03], &views());
}

/// The shadows of beams fall between the five points of beams.
#[test]
fn estimates_hold_where_shadows_are_narrow() {
    hold("beams", &[0.03, 0.01], &views()[..1]);
    hold("small-occluders", &[0.03], &views());
    hold("obstruction", &[0.03, 0.01], &views());
}

/// A small lamp's facets look at a floor of 4 × 4 fields, bright and dark.
#[test]
fn estimates_know_how_uneven_a_picture_is() {
    let corners = [[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [2.0, 2.0, 0.0], [-2.0, 2.0, 0.0]];
    let mut floor = patch("floor", &corners, 0.4, 0.0);
    let texels = (0..16).map(|field| [if (field / 4 + field) % 2 == 0 { 0.8 } else { 0.0 }; 3]).collect();
    let image = Image { name: "fields".into(), bytes: Vec::new(), mime: "image/png", width: 4, texels };
    let map = [[0, 1, 2], [0, 2, 3]].map(|corner: [usize; 3]| {
        corner.map(|corner| {
            let place = DVec3::from(corners[corner]);
            (place, DVec2::new(0.25 * place.x + 0.5, 0.5 - 0.25 * place.y))
        })
    });
    floor.texture = Some(Texture { image: Arc::new(image), factor: [1.0; 3], map: map.into() });
    let mut patches = room([0.4, 0.3, 0.5], [0.6, 0.5, 0.7], 1, 0.5, 0.5);
    patches = patches.into_iter().map(turned_inside_out).collect();
    patches.push(floor);
    let share = within_estimates(&scene(patches), 0.03);
    assert!(share >= 0.95, "{share}");
}
