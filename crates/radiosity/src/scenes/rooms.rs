//! Rooms whose light is known, or must show something.
use super::shapes::{Z_UP, camera, face, grid, joined, lamp, quad, room, sphere, square, surface, turned};
use crate::io::collada::model::{Face, Material, Model};
use crate::scene::camera::Camera;
use glam::DVec3;
use std::f64::consts::PI;

/// A closed cube that reflects and emits everywhere; see [`furnace_of`].
pub(super) fn furnace() -> Model {
    furnace_of(0.5)
}

/// A closed unit cube of reflectance ρ and emittance 1 − ρ: its radiosity is 1 everywhere.
pub(super) fn furnace_of(reflectance: f64) -> Model {
    let glow = lamp(reflectance, (1.0 - reflectance) / PI);
    let faces = room([0; 6], [DVec3::ZERO, DVec3::ONE]);
    model("A furnace: radiosity 1 everywhere", vec![glow], faces, inside())
}

/// A closed cube of 6 by 6 patches a face, of which one emits.
pub(super) fn cube() -> Model {
    let whole = room([0; 6], [DVec3::ZERO, DVec3::ONE]);
    let mut faces: Vec<Face> = whole.iter().map(|side| cells(side, 6)).collect();
    let shining = faces[1].polygons.swap_remove(14);
    faces.push(Face { name: "lamp".into(), material: 1, polygons: vec![shining], texture: None });
    model(
        "A closed cube of 216 patches, one of them a lamp",
        vec![surface("grey", [0.9; 3]), lamp(0.9, 10.0)],
        faces,
        inside(),
    )
}

/// A face of one quad cut in `n` by `n`.
fn cells(side: &Face, n: u32) -> Face {
    let corners = [0, 1, 2, 3].map(|corner| side.polygons[0][0][corner].to_array());
    face(&side.name, side.material, grid(corners, n).into_iter().map(|cell| cell.map(DVec3::from).to_vec()))
}

/// Two closed rooms with a thin wall between them, a lamp in the western one: the eastern one stays dark.
///
/// Floor, ceiling and long walls run through under the wall's edges, as rooms are mostly drawn.
pub(super) fn separating_wall() -> Model {
    let mut faces = room([0; 6], [DVec3::ZERO, DVec3::new(4.0, 2.0, 2.0)]);
    let toward_west = [[2.0, 0.0, 0.0], [2.0, 0.0, 2.0], [2.0, 2.0, 2.0], [2.0, 2.0, 0.0]];
    faces.push(quad("wall-west", 0, toward_west));
    faces.push(quad("wall-east", 0, turned(toward_west)));
    faces.push(quad("lamp", 1, turned(square([1.0, 1.0], 0.5, 1.5))));
    let eye = camera([2.6, -6.0, 1.6], [2.0, 1.0, 0.95], 38.0);
    model(
        "Two rooms, a thin wall between them, light in one",
        vec![surface("white", [0.8; 3]), lamp(0.5, 10.0)],
        joined(faces),
        eye,
    )
}

/// A white floor between a red and a green wall under a shining ceiling.
pub(super) fn colour_bleeding() -> Model {
    let materials = vec![
        surface("white", [0.8; 3]),
        lamp(0.0, 5.0),
        surface("red", [0.7, 0.1, 0.1]),
        surface("green", [0.1, 0.7, 0.1]),
    ];
    let faces = room([0, 1, 0, 0, 2, 3], [DVec3::ZERO, DVec3::splat(2.0)]);
    let eye = camera([1.0, -4.5, 1.2], [1.0, 1.0, 0.9], 35.0);
    model("A white floor between a red and a green wall", materials, faces, eye)
}

/// A round lamp over a plane: rings of equal light, and no other ones.
pub(super) fn sphere_lamp() -> Model {
    let faces = vec![
        quad("floor", 0, square([0.0, 0.0], 4.0, 0.0)),
        face("lamp", 1, sphere(DVec3::new(0.0, 0.0, 1.5), 0.25)),
    ];
    let eye = camera([0.0, -5.0, 4.4], [0.0, 0.0, 0.5], 45.0);
    model("A round lamp over a plane", vec![surface("white", [0.8; 3]), lamp(0.8, 10.0)], faces, eye)
}

/// From one corner of the unit cube toward the opposite one.
fn inside() -> Camera {
    camera([0.1, 0.1, 0.9], [1.0, 1.0, 0.3], 75.0)
}

fn model(title: &str, materials: Vec<Material>, faces: Vec<Face>, camera: Camera) -> Model {
    Model {
        title: title.into(),
        asset: Z_UP,
        wavelengths: Vec::new(),
        materials,
        faces,
        cameras: vec![camera],
    }
}
