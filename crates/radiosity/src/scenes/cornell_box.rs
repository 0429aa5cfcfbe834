//! The Cornell box: the measurements that Cornell's Program of Computer Graphics published, y up, in millimetres.
//!
//! Two facts that the file has to meet: the left wall is not planar (its fourth vertex lies 3.20 off the plane of the
//! others), so that it is two triangles; the lamp lies in the ceiling's plane, so that the ceiling is the ceiling minus
//! the lamp.
use super::shapes::{Quad, face, halves, quad, surface};
use crate::io::collada::model::{Face, Material, Model};
use crate::scene::{asset::Asset, camera::Camera};
use glam::DVec3;
use polycsg::{FillRule, Region};

const FLOOR: Quad = [[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]];
const CEILING: Quad = [[556.0, 548.8, 0.0], [556.0, 548.8, 559.2], [0.0, 548.8, 559.2], [0.0, 548.8, 0.0]];
const BACK: Quad = [[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, 548.8, 559.2], [556.0, 548.8, 559.2]];
const RIGHT: Quad = [[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, 548.8, 0.0], [0.0, 548.8, 559.2]];
const LEFT: Quad = [[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, 548.8, 559.2], [556.0, 548.8, 0.0]];
pub(super) const LIGHT: Quad =
    [[343.0, 548.8, 227.0], [343.0, 548.8, 332.0], [213.0, 548.8, 332.0], [213.0, 548.8, 227.0]];

/// The top, then the four sides.
const SHORT: [Quad; 5] = [
    [[130.0, 165.0, 65.0], [82.0, 165.0, 225.0], [240.0, 165.0, 272.0], [290.0, 165.0, 114.0]],
    [[290.0, 0.0, 114.0], [290.0, 165.0, 114.0], [240.0, 165.0, 272.0], [240.0, 0.0, 272.0]],
    [[130.0, 0.0, 65.0], [130.0, 165.0, 65.0], [290.0, 165.0, 114.0], [290.0, 0.0, 114.0]],
    [[82.0, 0.0, 225.0], [82.0, 165.0, 225.0], [130.0, 165.0, 65.0], [130.0, 0.0, 65.0]],
    [[240.0, 0.0, 272.0], [240.0, 165.0, 272.0], [82.0, 165.0, 225.0], [82.0, 0.0, 225.0]],
];
const TALL: [Quad; 5] = [
    [[423.0, 330.0, 247.0], [265.0, 330.0, 296.0], [314.0, 330.0, 456.0], [472.0, 330.0, 406.0]],
    [[423.0, 0.0, 247.0], [423.0, 330.0, 247.0], [472.0, 330.0, 406.0], [472.0, 0.0, 406.0]],
    [[472.0, 0.0, 406.0], [472.0, 330.0, 406.0], [314.0, 330.0, 456.0], [314.0, 0.0, 456.0]],
    [[314.0, 0.0, 456.0], [314.0, 330.0, 456.0], [265.0, 330.0, 296.0], [265.0, 0.0, 296.0]],
    [[265.0, 0.0, 296.0], [265.0, 330.0, 296.0], [423.0, 330.0, 247.0], [423.0, 0.0, 247.0]],
];

/// The materials, by number.
pub(super) const WHITE: usize = 0;
pub(super) const RED: usize = 1;
pub(super) const GREEN: usize = 2;
pub(super) const LAMP: usize = 3;

/// The five walls, the left one not planar and the ceiling without its hole.
pub(super) const WALLS: [(&str, usize, Quad); 5] = [
    ("floor", WHITE, FLOOR),
    ("ceiling", WHITE, CEILING),
    ("back", WHITE, BACK),
    ("right", GREEN, RIGHT),
    ("left", RED, LEFT),
];

pub(super) fn cornell_box() -> Model {
    let wall = |(name, material, corners)| match name {
        "ceiling" => Face { name: "ceiling".into(), material, polygons: ceiling(), texture: None },
        "left" => face(name, material, halves(corners)),
        _ => quad(name, material, corners),
    };
    let mut faces: Vec<Face> = WALLS.into_iter().map(wall).collect();
    faces.push(quad("light", LAMP, LIGHT));
    faces.extend(blocks().into_iter().map(|(name, corners)| quad(&name, WHITE, corners)));
    Model {
        title: "The Cornell box, as published by the Cornell Program of Computer Graphics".into(),
        asset: Asset { up: DVec3::Y, unit: 0.001 },
        wavelengths: Vec::new(),
        materials: materials(),
        faces,
        cameras: vec![Camera {
            name: "camera".into(),
            position: DVec3::new(278.0, 273.0, -800.0),
            direction: DVec3::Z,
            up: DVec3::Y,
            // Film 0.025 by 0.025 behind a focal length of 0.035.
            vertical_fov: 2.0 * (0.0125_f64 / 0.035).atan(),
            aspect: 1.0,
        }],
    }
}

/// The faces of both blocks, by name.
pub(super) fn blocks() -> Vec<(String, Quad)> {
    let block = |(name, [top, sides @ ..]): (&str, [Quad; 5])| {
        let sides = sides.into_iter().zip(1..).map(move |(side, number)| (format!("{name}-{number}"), side));
        std::iter::once((format!("{name}-top"), top)).chain(sides).collect::<Vec<_>>()
    };
    [("short", SHORT), ("tall", TALL)].into_iter().flat_map(block).collect()
}

/// Red, green and blue made of the published spectra.
fn materials() -> Vec<Material> {
    let light = surface("light", [0.78; 3]);
    vec![
        surface("white", [0.725, 0.71, 0.68]),
        surface("red", [0.63, 0.065, 0.05]),
        surface("green", [0.14, 0.45, 0.091]),
        Material { emission: vec![17.0, 12.0, 4.0], ..light },
    ]
}

/// The ceiling minus the lamp. In (x, z) what is counter-clockwise faces down, as it must.
fn ceiling() -> Vec<Vec<Vec<DVec3>>> {
    let region = |quad: Quad| {
        let ring = quad.map(|[x, _, z]| [x, z]);
        Region::from_rings([ring], FillRule::NonZero).expect("the published coordinates are finite")
    };
    let height = CEILING[0][1];
    let lift = |ring: &[polycsg::DVec2]| ring.iter().map(|p| DVec3::new(p.x, height, p.y)).collect();
    let open = region(CEILING).difference(&region(LIGHT));
    let polygons = open.polygons();
    polygons
        .map(|polygon| std::iter::once(polygon.outer()).chain(polygon.holes()).map(lift).collect())
        .collect()
}
