//! The scenes of Gomes, *Modelo de Iluminação Global por Radiação* (2010), section 5.
use super::cornell_box;
use super::shapes::{Quad, Z_UP, camera, face, grid, halves, lamp, quad, sphere, square, surface, turned};
use crate::io::collada::model::{Face, Material, Model};
use crate::picture::png::grey;
use crate::scene::texture::{Image, Texture};
use glam::{DVec2, DVec3};
use std::sync::Arc;

const WHITE: usize = 0;
const LAMP: usize = 1;

/// A white wall on a white floor, and a lamp that faces the wall.
pub(super) fn wall() -> Model {
    let upright: Quad = [[-2.0, 2.0, 0.0], [2.0, 2.0, 0.0], [2.0, 2.0, 4.0], [-2.0, 2.0, 4.0]];
    let shine: Quad = [[0.5, -1.5, 1.5], [-0.5, -1.5, 1.5], [-0.5, -1.5, 2.5], [0.5, -1.5, 2.5]];
    Model {
        title: "Gomes 2010: Wall".into(),
        asset: Z_UP,
        wavelengths: Vec::new(),
        materials: vec![surface("white", [0.8; 3]), lamp(0.8, 10.0)],
        faces: vec![
            quad("floor", WHITE, square([0.0, 0.0], 4.0, 0.0)),
            quad("wall", WHITE, upright),
            quad("lamp", LAMP, shine),
        ],
        cameras: vec![camera([3.0, -7.0, 4.5], [-0.3, 0.3, 1.6], 45.0)],
    }
}

/// A thin green wall on a chessboard, under a round lamp. The wall is two patches, one for each side.
pub(super) fn chessboard() -> Model {
    let front: Quad = [[-1.0, 0.5, 0.0], [1.0, 0.5, 0.0], [1.0, 0.5, 1.5], [-1.0, 0.5, 1.5]];
    let floor = square([0.0, 0.0], 4.0, 0.0);
    let texture = Some(fields(floor));
    Model {
        title: "Gomes 2010: Chessboard".into(),
        asset: Z_UP,
        wavelengths: Vec::new(),
        materials: vec![
            Material { texture, ..surface("chessboard", [0.425; 3]) },
            lamp(0.8, 10.0),
            surface("green", [0.1, 0.6, 0.1]),
        ],
        faces: vec![
            quad("floor", WHITE, floor),
            quad("wall-south", 2, front),
            quad("wall-north", 2, turned(front)),
            face("lamp", LAMP, sphere(DVec3::new(1.0, -1.0, 2.5), 0.25)),
        ],
        // From the west: the wall's shadow lies to the left of it, what is lit to the right.
        cameras: vec![camera([-5.6, -1.6, 4.0], [0.3, 0.2, 0.6], 45.0)],
    }
}

/// Eight by eight fields over a square, one texel each, black where the lower left corner is.
fn fields(floor: Quad) -> Texture {
    let dark = |row: usize, column: usize| (row + column) % 2 == 1;
    let texels: Vec<f64> = (0..64).map(|field| if dark(field / 8, field % 8) { 0.05 } else { 0.8 }).collect();
    let bytes = grey(&texels, 8);
    let texels = texels.into_iter().map(|grey| [grey; 3]).collect();
    let image = Image { name: "chessboard.png".into(), bytes, mime: "image/png", width: 8, texels };
    let [a, b, c, d] = floor.map(DVec3::from);
    let [sw, se, ne, nw] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]].map(DVec2::from);
    let map = vec![[(a, sw), (b, se), (c, ne)], [(a, sw), (c, ne), (d, nw)]];
    Texture { image: Arc::new(image), factor: [1.0; 3], map }
}

/// The Cornell box in the 3842 triangles of his mesh, each a patch: walls of 16 by 16 quads, faces of blocks of 8 by 8.
///
/// His ceiling has no hole; so the lamp hangs 0.1 mm below it, or the two would lie in each other.
pub(super) fn cornell_3842() -> Model {
    let parts = |corners: Quad, n: u32| grid(corners, n).into_iter().flat_map(halves);
    let mut faces: Vec<Face> = cornell_box::WALLS
        .into_iter()
        .map(|(name, material, corners)| face(name, material, parts(corners, 16)))
        .collect();
    let hung = cornell_box::LIGHT.map(|[x, y, z]| [x, y - 0.1, z]);
    faces.push(face("light", cornell_box::LAMP, halves(hung)));
    let blocks = cornell_box::blocks();
    faces
        .extend(blocks.into_iter().map(|(name, corners)| face(&name, cornell_box::WHITE, parts(corners, 8))));
    Model {
        title: "Gomes 2010: the Cornell box in 3842 triangles".into(),
        faces,
        ..cornell_box::cornell_box()
    }
}
