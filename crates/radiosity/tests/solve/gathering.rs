//! The final gather on a mesh: what is shown, and the elements that are cut for it.
use crate::build::{cube, patch, room, scene, solved};
use radiosity::formfactor::PlanarPolygon;
use radiosity::glam::DVec3;
use radiosity::{Mesh, Options, Patch, Record, Scene, Sky, SkyKind, repair};
use std::f64::consts::PI;

/// A horizontal square that looks up, or down.
fn square(name: &str, [x, y, z]: [f64; 3], half: f64, looks_up: bool, [rho, emittance]: [f64; 2]) -> Patch {
    let mut corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        .map(|[across, along]| [x + half * across, y + half * along, z]);
    if !looks_up {
        corners.reverse();
    }
    patch(name, &corners, rho, emittance)
}

#[test]
fn a_furnace_is_shown_equally_bright_and_stays_as_it_was_cut() {
    let scene = cube(2, 0.5, 0.5);
    let solution = solved(&scene, &Options { tolerance: 1e-8, ..Options::mesh(300) });
    for light in solution.vertex_irradiance() {
        assert!((light - 1.0).abs() < 1e-6, "{light}");
    }
    let even = Mesh::even(&scene, 300).expect("a mesh");
    assert_eq!(even.elements, solution.mesh.elements);
}

/// A lamp so small that its form factors are below 1e-8 lights a floor as a point would.
#[test]
fn a_tiny_lamp_lights_what_is_below_it() {
    let lamp = square("lamp", [0.0, 0.0, 2.0], 1e-5, false, [0.0, 1e10]);
    let floor = square("floor", [0.0; 3], 3.0, true, [0.5, 0.0]);
    let solution = solved(&scene(vec![floor, lamp]), &Options::mesh(60));
    for (place, light) in solution.mesh.vertices.iter().zip(solution.vertex_irradiance()) {
        let point = 4.0 / PI * 4.0 / (4.0 + place.truncate().length_squared()).powi(2);
        assert!(place.z > 0.0 || (light / point - 1.0).abs() < 0.01, "{light} at {place}, not {point}");
    }
}

/// Boards with a ten thousandth of the ground's area each are looked from as the ground is.
#[test]
fn small_boards_on_a_wide_ground_get_all_light_of_a_lamp() {
    let board = |k: u32| square("board", [0.7 * f64::from(k) - 2.0, 1.0, 0.2], 0.05, true, [0.5, 0.0]);
    let ground = square("ground", [0.0; 3], 5.0, true, [0.5, 0.0]);
    let lamp = square("lamp", [0.0, 0.0, 1.0], 0.001, false, [0.0, 1e6]);
    let scene = scene([ground, lamp].into_iter().chain((0..6).map(board)).collect());
    let solution = solved(&scene, &Options::mesh(200));
    for (place, light) in solution.mesh.vertices.iter().zip(solution.vertex_irradiance()) {
        let way = DVec3::Z - *place;
        let point = 4.0 / PI * (way.z / way.length_squared()).powi(2);
        assert!(place.z != 0.2 || (light / point - 1.0).abs() < 0.01, "{light} at {place}, not {point}");
    }
}

/// A floor under a lamp, half of it behind a wall.
fn shadow(unit: f64) -> Scene {
    let long = |corners: [[f64; 3]; 4]| corners.map(|corner| corner.map(|coordinate| unit * coordinate));
    let wall = [[0.5, -1.0, 0.0], [0.5, 1.0, 0.0], [0.5, 1.0, 1.0], [0.5, -1.0, 1.0]];
    let mut back = wall;
    back.reverse();
    scene(vec![
        patch("floor", &long([[-2., -2., 0.], [2., -2., 0.], [2., 2., 0.], [-2., 2., 0.]]), 0.5, 0.0),
        patch("lamp", &long([[-1., 1., 2.], [0., 1., 2.], [0., 0., 2.], [-1., 0., 2.]]), 0.0, 10.0),
        patch("wall", &long(wall), 0.5, 0.0),
        patch("back", &long(back), 0.5, 0.0),
    ])
}

#[test]
fn the_unit_of_length_changes_nothing() {
    let [one, other] = [1.0, 2f64.powi(-40)].map(|unit| solved(&shadow(unit), &Options::mesh(120)));
    assert_eq!(one.mesh.elements, other.mesh.elements);
    assert_eq!(one.vertex_irradiance(), other.vertex_irradiance());
}

/// What is shown is cut where light is not linear: it covers what it is cut from, and sends as much.
#[test]
fn elements_are_cut_where_light_is_not_linear() {
    let scene = shadow(1.0);
    let [gathered, plain] = [true, false].map(|gather| {
        let solution = solved(&scene, &Options { gather, ..Options::mesh(120) });
        Record::new("shadow", &scene, &solution)
    });
    assert!(gathered.elements.len() > plain.elements.len());
    assert!(gathered.vertices.len() < 5 * plain.vertices.len());
    assert!(gathered.elements.is_sorted_by_key(|element| element[0]));
    for (of, before) in patches(&gathered).into_iter().zip(patches(&plain)) {
        for (sum, before) in of.into_iter().zip(before) {
            assert!((sum - before).abs() < 1e-12 * before, "{sum} {before}");
        }
    }
}

/// The shadows around a block on a ground a thousand times as large are a small part of the area: they are cut all the same.
#[test]
fn the_ground_around_a_small_block_is_cut() {
    let mut patches = room([-0.5, -0.5, 0.0], [0.5, 0.5, 1.0], 1, 0.5, 0.0);
    patches.iter_mut().for_each(turn);
    patches.push(square("ground", [0.0; 3], 20.0, true, [0.5, 0.0]));
    let sky = Some(Sky { radiance: vec![1.0], kind: SkyKind::Uniform });
    let scene = Scene { sky, ..repair(&scene(patches)).scene };
    let [gathered, plain] = [true, false].map(|gather| {
        let solution = solved(&scene, &Options { gather, ..Options::mesh(600) });
        Record::new("ground", &scene, &solution).elements.len()
    });
    assert!(gathered > plain, "{gathered} {plain}");
}

/// Turns a patch to its other side.
fn turn(patch: &mut Patch) {
    let loops = patch.polygon.loops().map(|points| points.iter().rev().copied().collect::<Vec<_>>());
    patch.polygon = PlanarPolygon::new(loops).expect("planar");
}

/// For each patch the area of its elements, and the power that they send.
fn patches(record: &Record) -> Vec<[f64; 2]> {
    let mut sums = vec![[0.0; 2]; record.patches.len()];
    for ([patch, corners @ ..], sent) in record.elements.iter().zip(&record.radiosity) {
        let [a, b, c] = corners.map(|corner| record.vertices[corner]);
        let area = (b - a).cross(c - a).length() / 2.0;
        sums[*patch][0] += area;
        sums[*patch][1] += area * sent;
    }
    sums
}
