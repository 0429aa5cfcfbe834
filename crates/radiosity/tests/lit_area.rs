//! What is lit is shown as bright as an exact gather over the solution says, also on a coarse mesh.

#[path = "gather/mod.rs"]
mod gather;

use gather::area::{lit_samples, within};
use radiosity::{Method, Options, Quality, scenes, solve};
use std::ops::ControlFlow;

/// The share of the lit area that is shown within 5 %, at draft on a mesh, with and without a final gather.
fn shares(name: &str) -> [f64; 2] {
    let scene = scenes::scene(name).expect("a built-in scene");
    [true, false].map(|gather| {
        let options = Options { method: Method::Mesh, gather, ..Quality::Draft.options() };
        let solution = solve(&scene, &options, |_| ControlFlow::Continue(())).expect("a solution");
        within(&lit_samples(&scene, &solution, 200).expect("points"), 0.05)
    })
}

fn assert_shown(name: &str, least: f64, gain: f64) {
    let [gathered, interpolated] = shares(name);
    assert!(gathered >= least, "{name}: {gathered} is less than {least}");
    assert!(gathered >= interpolated + gain, "{name}: {gathered} beside {interpolated}");
}

#[test]
fn the_cornell_box() {
    assert_shown("cornell-box", 0.87, 0.15);
}

#[test]
fn penumbrae_of_small_occluders() {
    assert_shown("small-occluders", 0.87, 0.15);
}

#[test]
fn lit_spots_under_a_panel() {
    assert_shown("perforated", 0.8, 0.2);
}

#[test]
fn smooth_light() {
    assert_shown("obstruction", 0.99, 0.0);
}
