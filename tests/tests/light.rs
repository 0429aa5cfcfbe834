//! The path tracer against closed forms, and the rooms that it is for.
use glam::DVec3;
use std::f64::consts::PI;
use tests::light::{Estimate, KINDS, Surface, mean_irradiance, room};

fn square(name: &str, corners: [[f64; 3]; 4], reflectance: f64, radiance: f64) -> Surface {
    let loops = vec![corners.map(DVec3::from).to_vec()];
    Surface { name: name.to_owned(), loops, reflectance: [reflectance; 3], radiance: [radiance; 3] }
}

/// The faces of the unit cube from inside.
fn cube(reflectance: f64, radiance: f64) -> Vec<Surface> {
    let faces = [
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
        [[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]],
        [[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]],
        [[0, 1, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1]],
        [[0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1]],
        [[1, 0, 0], [1, 0, 1], [1, 1, 1], [1, 1, 0]],
    ];
    let face =
        |corners: [[i32; 3]; 4]| square("face", corners.map(|p| p.map(f64::from)), reflectance, radiance);
    faces.map(face).to_vec()
}

fn assert_is(found: Estimate, exact: f64) {
    let off = (found.mean - exact).abs();
    assert!(off <= 4.0 * found.error + 1e-12 * exact, "{found:?}, exactly {exact}");
    assert!(found.error <= 0.01 * exact, "{found:?} says little of {exact}");
}

#[test]
fn a_furnace_is_as_bright_as_all_its_reflections() {
    for reflectance in [0.0, 0.3, 0.9] {
        let found = mean_irradiance(&cube(reflectance, 2.0), 3, 40_000, 1);
        found.into_iter().for_each(|found| assert_is(found, 2.0 * PI / (1.0 - reflectance)));
    }
}

/// Unit squares at 1: F = 0.1998248957. What blocks [0, ½]² half-way leaves 0.1498686718.
#[test]
fn light_from_a_square_to_a_square_is_its_form_factor() {
    let low = square("low", [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], 0.5, 0.0);
    let lamp = square("lamp", [[0., 0., 1.], [0., 1., 1.], [1., 1., 1.], [1., 0., 1.]], 0.0, 3.0);
    let board = square("board", [[0., 0., 0.5], [0.5, 0., 0.5], [0.5, 0.5, 0.5], [0., 0.5, 0.5]], 0.0, 0.0);
    let free = mean_irradiance(&[low.clone(), lamp.clone()], 0, 100_000, 2);
    assert_is(free[0], 3.0 * PI * 0.199_824_895_698_387_4);
    let hidden = mean_irradiance(&[low, lamp, board], 0, 100_000, 3);
    assert_is(hidden[0], 3.0 * PI * 0.149_868_671_773_790);
}

/// A lamp that touches what it shines on: F = 0.2000437763 between unit squares at right angles. Lamps alone would be sampled with
/// an infinite variance.
#[test]
fn light_along_a_common_edge_is_its_form_factor() {
    let floor = square("floor", [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], 0.5, 0.0);
    let wall = square("wall", [[0., 0., 0.], [0., 0., 1.], [1., 0., 1.], [1., 0., 0.]], 0.0, 1.0);
    assert_is(mean_irradiance(&[floor, wall], 0, 100_000, 4)[0], PI * 0.200_043_776_075_402_8);
}

#[test]
fn rooms_are_scenes() {
    for (kind, name) in KINDS.iter().enumerate() {
        for seed in 0..20 {
            let surfaces = room(kind, seed);
            let mut names: Vec<&str> = surfaces.iter().map(|surface| surface.name.as_str()).collect();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), surfaces.len(), "{name} {seed}");
            assert!(surfaces.iter().any(|surface| surface.radiance[0] > 0.0), "{name} {seed} is dark");
            for surface in &surfaces {
                let polygon = formfactor::PlanarPolygon::new(&surface.loops);
                assert!(polygon.is_ok_and(|p| p.area() > 0.0), "{name} {seed}: {}", surface.name);
            }
        }
    }
}
