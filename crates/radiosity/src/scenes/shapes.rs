//! Faces that several scenes are made of. Corners run counter-clockwise seen from the front.
use crate::io::collada::model::{Face, Material};
use crate::scene::{asset::Asset, camera::Camera};
use glam::DVec3;
use std::cmp::Ordering;

/// Four corners.
pub(super) type Quad = [[f64; 3]; 4];

/// Lengths in metres, z up: all scenes but the Cornell box.
pub(super) const Z_UP: Asset = Asset { up: DVec3::Z, unit: 1.0 };

/// A surface that gives no light of its own.
pub(super) fn surface(name: &str, reflectance: [f64; 3]) -> Material {
    Material { name: name.into(), reflectance: reflectance.into(), emission: vec![0.0; 3], texture: None }
}

/// A surface that emits the same radiance in all bands.
pub(super) fn lamp(reflectance: f64, radiance: f64) -> Material {
    Material {
        name: "lamp".into(),
        reflectance: vec![reflectance; 3],
        emission: vec![radiance; 3],
        texture: None,
    }
}

/// A face of several polygons without holes.
pub(super) fn face(name: &str, material: usize, outlines: impl IntoIterator<Item = Vec<DVec3>>) -> Face {
    let polygons = outlines.into_iter().map(|outline| vec![outline]).collect();
    Face { name: name.into(), material, polygons, texture: None }
}

pub(super) fn quad(name: &str, material: usize, corners: Quad) -> Face {
    face(name, material, [corners.map(DVec3::from).to_vec()])
}

/// The same faces, whose edges along an axis have the corners of others that lie within them.
pub(super) fn joined(mut faces: Vec<Face>) -> Vec<Face> {
    let mut corners: Vec<DVec3> =
        faces.iter().flat_map(|face| &face.polygons).flatten().flatten().copied().collect();
    corners.sort_by(|a, b| a.to_array().partial_cmp(&b.to_array()).unwrap_or(Ordering::Equal));
    corners.dedup();
    for ring in faces.iter_mut().flat_map(|face| &mut face.polygons).flatten() {
        let ends = ring.iter().zip(ring.iter().cycle().skip(1));
        *ring = ends.flat_map(|(a, b)| with_corners([*a, *b], &corners)).collect();
    }
    faces
}

/// The first end of an edge along an axis, and the corners within it in its direction.
fn with_corners([a, b]: [DVec3; 2], corners: &[DVec3]) -> Vec<DVec3> {
    let is_within = |corner: &&DVec3| {
        let [low, high] = [a.min(b), a.max(b)];
        let is_inside = corner.cmpge(low).all() && corner.cmple(high).all();
        is_inside && (b - a).to_array().iter().filter(|way| **way != 0.0).count() == 1
    };
    let mut within: Vec<DVec3> =
        corners.iter().filter(is_within).copied().filter(|corner| *corner != b).collect();
    within.sort_by(|p, q| p.distance(a).total_cmp(&q.distance(a)));
    within
}

/// A level rectangle, `[low x, low y]` to `[high x, high y]`, that faces up.
pub(super) fn level([low, high]: [[f64; 2]; 2], z: f64) -> Quad {
    [[low[0], low[1], z], [high[0], low[1], z], [high[0], high[1], z], [low[0], high[1], z]]
}

/// The same corners from the other side.
pub(super) fn turned([a, b, c, d]: Quad) -> Quad {
    [a, d, c, b]
}

/// A level square around (x, y) that faces up.
pub(super) fn square([x, y]: [f64; 2], side: f64, z: f64) -> Quad {
    let half = side / 2.0;
    level([[x - half, y - half], [x + half, y + half]], z)
}

/// The six faces of a box between two corners, seen from outside; `bend` moves its corners.
pub(super) fn solid(
    name: &str,
    material: usize,
    corners: [DVec3; 2],
    bend: impl Fn(DVec3) -> DVec3,
) -> Vec<Face> {
    let corner = |i: usize| {
        let pick = |bit: usize, axis: usize| corners[(i >> bit) & 1][axis];
        bend(DVec3::new(pick(0, 0), pick(1, 1), pick(2, 2))).to_array()
    };
    let sides = [
        ("bottom", [0, 2, 3, 1]),
        ("top", [4, 5, 7, 6]),
        ("south", [0, 1, 5, 4]),
        ("north", [2, 6, 7, 3]),
        ("west", [0, 4, 6, 2]),
        ("east", [1, 3, 7, 5]),
    ];
    sides.map(|(side, picks)| quad(&format!("{name}-{side}"), material, picks.map(corner))).into()
}

/// The six faces of a room between two corners, seen from inside, in the order floor, ceiling, south, north, west, east.
pub(super) fn room(materials: [usize; 6], corners: [DVec3; 2]) -> Vec<Face> {
    let names = ["floor", "ceiling", "south", "north", "west", "east"];
    let inward = |(mut face, (name, material)): (Face, (&str, usize))| {
        face.polygons.iter_mut().flatten().for_each(|outline| outline[1..].reverse());
        Face { name: name.into(), material, ..face }
    };
    solid("", 0, corners, |corner| corner)
        .into_iter()
        .zip(names.into_iter().zip(materials))
        .map(inward)
        .collect()
}

/// The cells of a quad cut in `n` by `n`. Points on its edges depend on the edge alone, not on its direction.
pub(super) fn grid(corners: Quad, n: u32) -> Vec<Quad> {
    let [a, b, c, d] = corners.map(DVec3::from);
    let whole = f64::from(n);
    let point = |i: u32, j: u32| {
        let (i, j) = (f64::from(i), f64::from(j));
        let along = |from: DVec3, to: DVec3| from * (whole - i) + to * i;
        ((along(a, b) * (whole - j) + along(d, c) * j) / (whole * whole)).to_array()
    };
    let cell = |(i, j)| [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
    (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).map(cell).collect()
}

/// A quad as the triangles 0-1-2 and 0-2-3.
pub(super) fn halves(corners: Quad) -> [Vec<DVec3>; 2] {
    let corners = corners.map(DVec3::from);
    [[0, 1, 2], [0, 2, 3]].map(|picks| picks.map(|pick| corners[pick]).to_vec())
}

/// The outward triangles of a sphere: an icosahedron's, each cut in four: 80.
pub(super) fn sphere(centre: DVec3, radius: f64) -> Vec<Vec<DVec3>> {
    let golden = (1.0 + 5_f64.sqrt()) / 2.0;
    let corner = |i: usize| {
        let (sign, turn) = ([[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]][i % 4], i / 4);
        let mut axes = [0.0, sign[0], sign[1] * golden];
        axes.rotate_right(turn);
        DVec3::from(axes).normalize()
    };
    let corners: Vec<DVec3> = (0..12).map(corner).collect();
    // Neighbours subtend an angle with cosine 1/√5 = 0.447; the next corners lie at −0.447.
    let near = |a: usize, b: usize| corners[a].dot(corners[b]) > 0.0;
    let triples = (0..12).flat_map(|a| (a + 1..12).flat_map(move |b| (b + 1..12).map(move |c| [a, b, c])));
    let faces = triples.filter(|&[a, b, c]| near(a, b) && near(b, c) && near(c, a));
    let outward = faces
        .map(|face| face.map(|corner| corners[corner]))
        .map(|[a, b, c]| if a.dot(b.cross(c)) > 0.0 { [a, b, c] } else { [a, c, b] });
    let place = |direction: DVec3| centre + radius * direction;
    let quarters = |[a, b, c]: [DVec3; 3]| {
        let [ab, bc, ca] = [a + b, b + c, c + a].map(DVec3::normalize);
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]].map(|corners| corners.map(place).to_vec())
    };
    outward.flat_map(quarters).collect()
}

/// A camera from `eye` toward `interest`, 4:3, z up, with a vertical field of view in degrees.
pub(super) fn camera(eye: [f64; 3], interest: [f64; 3], degrees: f64) -> Camera {
    let position = DVec3::from(eye);
    Camera {
        name: "camera".into(),
        position,
        direction: DVec3::from(interest) - position,
        up: DVec3::Z,
        vertical_fov: degrees.to_radians(),
        aspect: 4.0 / 3.0,
    }
}
