//! The Cornell box: the measurements that Cornell's Program of Computer Graphics published, y up, in millimetres.
//!
//! Two facts that the file has to meet: the left wall is not planar (its fourth vertex lies 3.20 off the plane of the
//! others), so that it is two triangles; the lamp lies in the ceiling's plane, so that the ceiling is the ceiling minus
//! the lamp.
use super::{Face, Material, Model, View};
use glam::DVec3;
use polycsg::{FillRule, Region};

type Quad = [[f64; 3]; 4];

const FLOOR: Quad = [[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]];
const CEILING: Quad = [[556.0, 548.8, 0.0], [556.0, 548.8, 559.2], [0.0, 548.8, 559.2], [0.0, 548.8, 0.0]];
const BACK: Quad = [[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, 548.8, 559.2], [556.0, 548.8, 559.2]];
const RIGHT: Quad = [[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, 548.8, 0.0], [0.0, 548.8, 559.2]];
const LEFT: Quad = [[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, 548.8, 559.2], [556.0, 548.8, 0.0]];
const LIGHT: Quad =
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

pub(super) fn cornell_box() -> Model {
    let mut faces = vec![
        quad("floor", "white", FLOOR),
        Face { name: "ceiling".into(), material: "white", polygons: ceiling() },
        quad("back", "white", BACK),
        quad("right", "green", RIGHT),
        left(),
        quad("light", "light", LIGHT),
    ];
    faces.extend(block("short", SHORT));
    faces.extend(block("tall", TALL));
    Model {
        title: "The Cornell box, as published by the Cornell Program of Computer Graphics",
        up_axis: "Y_UP",
        unit: ("millimeter", 0.001),
        materials: materials(),
        faces,
        view: View {
            eye: DVec3::new(278.0, 273.0, -800.0),
            interest: DVec3::new(278.0, 273.0, 0.0),
            up: DVec3::Y,
            // Film 0.025 by 0.025 behind a focal length of 0.035.
            degrees: 2.0 * (0.0125_f64 / 0.035).atan().to_degrees(),
            aspect: 1.0,
        },
    }
}

/// Red, green and blue made of the published spectra.
fn materials() -> Vec<Material> {
    let surface = |name, reflectance| Material { name, reflectance, emission: [0.0; 3] };
    vec![
        surface("white", [0.725, 0.71, 0.68]),
        surface("red", [0.63, 0.065, 0.05]),
        surface("green", [0.14, 0.45, 0.091]),
        Material { name: "light", reflectance: [0.78; 3], emission: [17.0, 12.0, 4.0] },
    ]
}

fn quad(name: &str, material: &'static str, corners: Quad) -> Face {
    Face { name: name.into(), material, polygons: vec![vec![corners.map(DVec3::from).to_vec()]] }
}

fn block(name: &str, [top, sides @ ..]: [Quad; 5]) -> Vec<Face> {
    let sides =
        sides.into_iter().zip(1..).map(|(side, number)| quad(&format!("{name}-{number}"), "white", side));
    std::iter::once(quad(&format!("{name}-top"), "white", top)).chain(sides).collect()
}

/// The triangles 0-1-2 and 0-2-3.
fn left() -> Face {
    let corners = LEFT.map(DVec3::from);
    let triangle = |picks: [usize; 3]| vec![picks.map(|pick| corners[pick]).to_vec()];
    Face { name: "left".into(), material: "red", polygons: vec![triangle([0, 1, 2]), triangle([0, 2, 3])] }
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
