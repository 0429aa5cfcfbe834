//! The pixels of pictures are as bright as an exact gather at their points says.

#[path = "gather/mod.rs"]
mod gather;

use gather::pixels::pixel_errors;
use radiosity::{Quality, scenes, solve};
use std::ops::ControlFlow;

/// At default quality the mean error is at most 0.5 % of the brightest reflected light, that of 99 pixels of 100 at most 3 %, and of none more than 4 %.
fn assert_right(name: &str) {
    let scene = scenes::scene(name).expect("a built-in scene");
    let solution =
        solve(&scene, &Quality::Normal.options(), |_| ControlFlow::Continue(())).expect("a solution");
    let found = pixel_errors(&scene, &solution, &scene.cameras[0], 32).expect("points");
    assert!(found.pixels > 100 && found.mean <= 0.005 && found.percentile <= 0.03, "{name}: {found:?}");
    assert!(found.worst <= 0.04, "{name}: {} at {:?}", found.worst, found.place);
}

#[test]
fn penumbrae_of_small_occluders() {
    assert_right("small-occluders");
}

#[test]
fn the_shadow_on_a_chessboard() {
    assert_right("chessboard");
}

#[test]
fn two_equal_shadows() {
    assert_right("obstruction");
}

#[test]
fn lit_spots_under_a_panel() {
    assert_right("perforated");
}

#[test]
fn shadows_of_beams() {
    assert_right("beams");
}
