//! What rooms are made of.
use super::{Bands, Surface};
use glam::{DMat3, DVec2, DVec3};

/// What a surface does with light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Material {
    pub(super) reflectance: Bands,
    pub(super) radiance: Bands,
}

pub(super) fn matt(reflectance: Bands) -> Material {
    Material { reflectance, radiance: [0.0; 3] }
}

pub(super) fn lamp(radiance: f64) -> Material {
    Material { reflectance: [0.3; 3], radiance: [radiance, 0.8 * radiance, 0.5 * radiance] }
}

pub(super) fn surface(name: &str, material: Material, loops: Vec<Vec<DVec3>>) -> Surface {
    let Material { reflectance, radiance } = material;
    Surface { name: name.to_owned(), loops, reflectance, radiance }
}

/// A level rectangle that faces up.
pub(super) fn level([low, high]: [DVec2; 2], z: f64) -> Vec<DVec3> {
    [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)].map(|p| p.extend(z)).to_vec()
}

/// The same from the other side.
pub(super) fn turned_over(mut points: Vec<DVec3>) -> Vec<DVec3> {
    points.reverse();
    points
}

/// The names of a box's faces.
pub(super) const SIDES: [&str; 6] = ["bottom", "top", "south", "north", "west", "east"];

/// The faces of a box between two corners, from outside, in the order of [`SIDES`].
fn faces([low, high]: [DVec3; 2]) -> [Vec<DVec3>; 6] {
    let corner = |i: usize| {
        let pick = |axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    };
    let rings = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    rings.map(|ring| ring.map(corner).to_vec())
}

/// The inner faces of a box, each of its own material, without those that are `None`.
pub(super) fn interior(corners: [DVec3; 2], materials: [Option<Material>; 6]) -> Vec<Surface> {
    let names = ["floor", "ceiling", "south", "north", "west", "east"];
    let face = |((name, material), points): ((&str, Option<Material>), Vec<DVec3>)| {
        Some(surface(name, material?, vec![turned_over(points)]))
    };
    names.into_iter().zip(materials).zip(faces(corners)).filter_map(face).collect()
}

/// The outer faces of a box without those of some sides, turned about the vertical through its middle.
pub(super) fn block(
    name: &str,
    corners: [DVec3; 2],
    turn: f64,
    material: Material,
    without: &[&str],
) -> Vec<Surface> {
    let middle = (corners[0] + corners[1]) / 2.0;
    let turn = DMat3::from_rotation_z(turn);
    let sides = SIDES.into_iter().zip(faces(corners)).filter(|(side, _)| !without.contains(side));
    let face = |(side, points): (&str, Vec<DVec3>)| {
        let points = points.into_iter().map(|p| turn * (p - middle) + middle).collect();
        surface(&format!("{name}-{side}"), material, vec![points])
    };
    sides.map(face).collect()
}

/// Puts a lamp in a level ceiling, which gets a hole there.
pub(super) fn put_lamp(room: &mut Vec<Surface>, at: [DVec2; 2], z: f64, radiance: f64) {
    let outline = turned_over(level(at, z));
    for ceiling in room.iter_mut().filter(|surface| surface.name == "ceiling") {
        ceiling.loops.push(outline.iter().rev().copied().collect());
    }
    room.push(surface("lamp", lamp(radiance), vec![outline]));
}
