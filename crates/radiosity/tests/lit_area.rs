//! What is lit is shown as bright as an exact gather over the solution says, also on a coarse mesh.

#[path = "gather/mod.rs"]
mod gather;

use gather::area::{Sample, lit_samples, within};
use radiosity::formfactor::PlanarPolygon;
use radiosity::glam::{DQuat, DVec3};
use radiosity::{Method, Options, Patch, Quality, Scene, scenes, solve};
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
    assert_shown("cornell-box", 0.95, 0.15);
}

#[test]
fn penumbrae_of_small_occluders() {
    assert_shown("small-occluders", 0.96, 0.15);
}

#[test]
fn lit_spots_under_a_panel() {
    assert_shown("perforated", 0.83, 0.2);
}

#[test]
fn smooth_light() {
    assert_shown("obstruction", 0.99, 0.0);
}

/// A level or an upright rectangle of one band, from a corner along two edges.
fn sheet(name: &str, corner: DVec3, [along, up]: [DVec3; 2], emission: f64) -> Patch {
    let polygon = PlanarPolygon::new([[corner, corner + along, corner + along + up, corner + up]]);
    Patch::new(name, polygon.expect("planar"), vec![0.6], vec![emission])
}

fn scene(patches: Vec<Patch>) -> Scene {
    Scene { patches, bands: 1, ..Scene::default() }
}

/// A room of 4 × 4 × 3 m with a lamp below its ceiling: patch 0 is a wall, patch 4 the floor, 6 the lamp.
fn room() -> Vec<Patch> {
    let [x, y, z] = [4.0 * DVec3::X, 4.0 * DVec3::Y, 3.0 * DVec3::Z];
    vec![
        sheet("wall", DVec3::ZERO, [y, z], 0.0),
        sheet("front", x, [z, y], 0.0),
        sheet("left", DVec3::ZERO, [z, x], 0.0),
        sheet("right", y, [x, z], 0.0),
        sheet("floor", DVec3::ZERO, [x, y], 0.0),
        sheet("ceiling", z, [y, x], 0.0),
        sheet("lamp", DVec3::new(1.5, 1.5, 2.99), [DVec3::Y, DVec3::X], 10.0),
    ]
}

/// The share of what is lit in a part of the scene that is shown within 5 %.
fn share_where(scene: &Scene, elements: usize, is_there: impl Fn(&Sample) -> bool) -> f64 {
    let options = Options { method: Method::Mesh, elements, ..Quality::Draft.options() };
    let solution = solve(scene, &options, |_| ControlFlow::Continue(())).expect("a solution");
    let mut samples = lit_samples(scene, &solution, 3000).expect("points");
    samples.retain(is_there);
    assert!(samples.len() >= 20, "{}", samples.len());
    within(&samples, 0.05)
}

/// Around a plate that hangs before a wall, the wall has elements whose centroids see nothing, and parts of them see the room. The shadow's
/// edge itself ends a tenth of a metre beside the plate.
#[test]
fn what_surrounds_a_plate_before_a_wall() {
    let plate = [2.0 * DVec3::Y, 1.2 * DVec3::Z];
    let corner = DVec3::new(0.03, 1.0, 1.0);
    let mut patches = room();
    patches.extend([sheet("plate", corner, plate, 0.0), sheet("back", corner, [plate[1], plate[0]], 0.0)]);
    let scene = scene(patches);
    let is_around = |sample: &Sample| {
        let [along, up] = [sample.point.y, sample.point.z];
        let off = (along - 2.0).abs().max((up - 1.6).abs() + 0.4);
        sample.patch == 0 && (1.1..1.4).contains(&off)
    };
    let share = share_where(&scene, 300, is_around);
    assert!(share >= 0.9, "{share}");
}

/// A closed box of six patches, its edges along three directions that are right-handed in this order.
fn block(name: &str, middle: DVec3, [x, y, z]: [DVec3; 3]) -> Vec<Patch> {
    let corner = middle - (x + y + z) / 2.0;
    let faces = [
        (corner, [y, x]),
        (corner + z, [x, y]),
        (corner, [x, z]),
        (corner + y, [z, x]),
        (corner, [z, y]),
        (corner + x, [y, z]),
    ];
    faces.map(|(corner, edges)| sheet(name, corner, edges, 0.0)).to_vec()
}

/// Blocks that lean against each other and into the floor of a room, as people model them: light jumps where one enters the other.
#[test]
fn solids_that_pass_through_each_other() {
    let mut patches = room();
    for (k, turn) in [0.3, 1.1, 2.0, 2.9].into_iter().enumerate() {
        let turned = DQuat::from_rotation_z(turn) * DQuat::from_rotation_x(0.2 * turn - 0.3);
        let edges = [0.7 * DVec3::X, 1.3 * DVec3::Y, 0.9 * DVec3::Z].map(|edge| turned * edge);
        patches.extend(block("block", DVec3::new(1.2 + 0.5 * k as f64, 1.6 + 0.2 * k as f64, 0.3), edges));
    }
    let share = share_where(&scene(patches), 600, |sample| sample.patch > 6 || sample.patch == 4);
    assert!(share >= 0.79, "{share}");
}
