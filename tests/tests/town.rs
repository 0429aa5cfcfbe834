//! Light by clusters beside path tracing: in a town, whose ground is far larger than what stands on it, and in rooms of many patches.
#[path = "../examples/beside_paths/mod.rs"]
mod beside_paths;

use beside_paths::{errors, root_mean_square, scene};
use glam::DVec3;
use radiosity::{Method, Options, Quality, Solution, solve};
use std::ops::ControlFlow;
use tests::light::{KINDS, Surface, cut, mean_irradiance, room, tiled_room, town};

const PATHS: u32 = 10_000;

fn draft(surfaces: &[Surface]) -> Solution {
    let options = Options { method: Method::Hierarchical, ..Quality::Draft.options() };
    solve(&scene(surfaces).expect("polygons"), &options, |_| ControlFlow::Continue(())).expect("a solution")
}

/// Solves by levels at draft and sets some faces beside path tracing.
fn assert_within_estimates(surfaces: &[Surface], most: f64) {
    let solution = draft(surfaces);
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

/// Of what is lit through clusters no patch is left dark: a lamp faces each of the tiles of a wall, and not their centre.
#[test]
fn a_tiled_room_with_a_window_has_the_light_that_paths_find() {
    let mut room = tiled_room();
    room.retain(|tile| tile.name != "tile-4-3-3");
    assert_within_estimates(&room, 0.03);
}

/// Its lamp is no part of the ceiling, what blocks cover is in no closed room, and what a lamp brings is not scaled for what others lack.
#[test]
fn a_room_of_cut_blocks_has_the_light_that_paths_find() {
    let blocks = KINDS.iter().position(|kind| *kind == "blocks").expect("a kind");
    assert_within_estimates(&cut(room(blocks, 0), 3), 0.04);
}

/// However much there is outside, light does not leave a closed room: not over the floor, on which legs stand, nor by what is far from each other in it.
#[test]
fn a_closed_room_beside_a_town_is_as_bright_as_alone() {
    for name in ["box", "furniture", "bright"] {
        let kind = KINDS.iter().position(|kind| *kind == name).expect("a kind");
        let inside = room(kind, 0);
        let alone = draft(&inside);
        let aside = DVec3::new(-40.0, 0.0, 0.0);
        let moved = inside.iter().cloned().map(|surface| Surface {
            loops: surface.loops.iter().map(|points| points.iter().map(|p| *p + aside).collect()).collect(),
            ..surface
        });
        let all: Vec<Surface> = moved.chain(town(5, 0)).collect();
        let beside = draft(&all);
        assert!(beside.transfers.is_some_and(|transfers| transfers.clusters > 100), "{name}");
        let count = inside.len();
        let here = alone.patch_means(&alone.irradiance, count);
        let there = beside.patch_means(&beside.irradiance, all.len());
        let ratios: Vec<f64> = here.iter().zip(&there).map(|(here, there)| there[0] / here[0]).collect();
        let mean = ratios.iter().sum::<f64>() / count as f64;
        assert!((mean - 1.0).abs() < 0.01, "{name}: {mean}");
        let far = ratios.iter().filter(|ratio| (**ratio - 1.0).abs() > 0.1).count();
        assert!(20 * far <= count, "{name}: {ratios:?}");
    }
}
