//! The scenes of Barreto, *Cálculo do Fator-de-Forma exato entre Áreas Diferencial e Finita Usando CSG* (2008), chapter 4.
//!
//! The thesis prints patch counts but no coordinates; the sizes are this project's. Occluders block on both sides; what
//! light they reflect they reflect on their front, which faces the lamp.
use super::shapes::{
    Quad, Z_UP, camera, face, grid, joined, lamp, level, quad, solid, square, surface, turned,
};
use crate::io::collada::model::{Face, Model};
use crate::scene::camera::Camera;
use glam::DVec3;

const BASE: usize = 0;
const LAMP: usize = 1;
const OCCLUDER: usize = 2;

/// A lamp of one polygon and one of a hundred of the same total area give the same light.
pub(super) fn emission() -> Model {
    let lamps = lamps();
    // From below the lamps, of which the shining sides are seen.
    let eye = camera([0.0, -14.0, 3.6], [0.0, 0.0, 1.2], 42.0);
    model("Barreto 2008, figure 4.2: the light does not depend on how a lamp is cut", lamps, 0.5, eye)
}

/// The same lamps, each with a black square under it: two equal shadows.
pub(super) fn obstruction() -> Model {
    // From so high that the squares are seen before the base.
    let eye = camera([0.0, -12.0, 9.0], [0.0, -0.3, 0.6], 42.0);
    let black = |(name, x)| quad(name, OCCLUDER, square([x, 0.0], 0.6, 2.0));
    let faces = lamps().into_iter().chain([("black-left", -2.5), ("black-right", 2.5)].map(black));
    model("Barreto 2008, figure 4.3: two equal shadows", faces.collect(), 0.0, eye)
}

fn lamps() -> Vec<Face> {
    let shape = |x: f64| turned(square([x, 0.0], 2.0, 4.0));
    let cells = grid(shape(2.5), 10).into_iter().map(|cell| cell.map(DVec3::from).to_vec());
    vec![quad("lamp-left", LAMP, shape(-2.5)), face("lamp-right", LAMP, cells)]
}

/// Two layers of beams, each rising along its length, under a long lamp across the lower ones.
pub(super) fn beams() -> Model {
    let mut faces = vec![quad("lamp", LAMP, turned(level([[-0.25, -3.0], [0.25, 3.0]], 8.0)))];
    for (number, across) in [-3.0, -1.0, 1.0, 3.0].into_iter().enumerate() {
        faces.extend(beam(&format!("lower-{}", number + 1), across, [0.5, 2.5], |place| place));
    }
    for (number, across) in [-3.0, -1.0, 1.0, 3.0].into_iter().enumerate() {
        // A quarter turn: what lay along x lies along y.
        let along_y = |place: DVec3| DVec3::new(-place.y, place.x, place.z);
        faces.extend(beam(&format!("upper-{}", number + 1), -across, [3.0, 4.5], along_y));
    }
    // From the side, so that both layers and their shadows are seen.
    let eye = camera([-6.5, -13.0, 9.5], [0.0, 0.0, 1.3], 45.0);
    model("Barreto 2008, figure 4.4: shadows whose hardness varies along a beam", faces, 0.5, eye)
}

/// A beam of 9 by 0.3 by 0.3 along x; its underside rises from the first to the second height.
fn beam(name: &str, across: f64, heights: [f64; 2], turn: impl Fn(DVec3) -> DVec3) -> Vec<Face> {
    let corners = [DVec3::new(-4.5, across - 0.15, 0.0), DVec3::new(4.5, across + 0.15, 0.3)];
    solid(name, OCCLUDER, corners, |corner| {
        let rise = if corner.x < 0.0 { heights[0] } else { heights[1] };
        turn(corner + rise * DVec3::Z)
    })
}

/// Twenty-five squares at five heights: mostly penumbra.
pub(super) fn small_occluders() -> Model {
    let places = [-4.0, -2.0, 0.0, 2.0, 4.0];
    let outlines = (0..5_u32).flat_map(|j| (0..5_u32).map(move |i| (i, j))).map(|(i, j)| {
        let z = 1.0 + 0.25 * f64::from((i + 2 * j) % 5);
        square([places[i as usize], places[j as usize]], 1.0, z).map(DVec3::from).to_vec()
    });
    let faces = vec![ceiling_lamp(), face("square", OCCLUDER, outlines)];
    let eye = camera([0.0, -13.0, 7.0], [0.0, -0.3, 0.6], 42.0);
    model("Barreto 2008, figure 4.5: penumbrae of small occluders", faces, 0.5, eye)
}

/// A panel with nine holes, as one polygon.
pub(super) fn perforated() -> Model {
    let outline = square([0.0, 0.0], PANEL, PANEL_HEIGHT);
    let holes = HOLES.into_iter().flat_map(|y| HOLES.map(|x| turned(square([x, y], HOLE, PANEL_HEIGHT))));
    let loops = std::iter::once(outline).chain(holes).map(|corners| corners.map(DVec3::from).to_vec());
    let panel =
        Face { name: "panel".into(), material: OCCLUDER, polygons: vec![loops.collect()], texture: None };
    let faces = vec![ceiling_lamp(), panel];
    model("Barreto 2008, figure 4.6: lit spots under the holes of a panel", faces, 0.5, under_panel())
}

/// From so low that two rows of spots are seen below the panel's edge.
fn under_panel() -> Camera {
    camera([0.0, -14.0, 5.4], [0.0, -0.6, 0.3], 42.0)
}

/// The same panel cut into rectangles: one between each two rows of holes, and those between the holes of a row.
///
/// Two bars along x over the whole width, two between the rows of holes, two at the sides, and two between the holes of
/// each of the three rows: 12, as he counts. Neighbours have each other's corners in their edges.
pub(super) fn perforated_cut() -> Model {
    let (half, radius) = (PANEL / 2.0, HOLE / 2.0);
    let [low, middle, high] = HOLES;
    let inner = low - radius..high + radius;
    let rows = [
        [-half, low - radius],
        [low + radius, middle - radius],
        [middle + radius, high - radius],
        [high + radius, half],
    ];
    // Whole width at the south and the north; between the outer columns of holes elsewhere.
    let bars = rows.into_iter().enumerate().map(|(row, [south, north])| {
        let [west, east] = if row % 3 == 0 { [-half, half] } else { [inner.start, inner.end] };
        level([[west, south], [east, north]], PANEL_HEIGHT)
    });
    let sides = [[-half, inner.start], [inner.end, half]]
        .map(|[west, east]| level([[west, inner.start], [east, inner.end]], PANEL_HEIGHT));
    let between = HOLES.into_iter().flat_map(|y| {
        [[low + radius, middle - radius], [middle + radius, high - radius]]
            .map(|[west, east]| level([[west, y - radius], [east, y + radius]], PANEL_HEIGHT))
    });
    let pieces: Vec<Quad> = bars.chain(sides).chain(between).collect();
    let outlines = pieces.into_iter().map(|corners| corners.map(DVec3::from).to_vec());
    let faces = joined(vec![ceiling_lamp(), face("panel", OCCLUDER, outlines)]);
    model("Barreto 2008, figure 4.6, with the panel cut into 12 rectangles", faces, 0.5, under_panel())
}

const PANEL: f64 = 7.07;
const PANEL_HEIGHT: f64 = 1.5;
const HOLE: f64 = 1.2;
const HOLES: [f64; 3] = [-2.2, 0.0, 2.2];

/// As large as the base, 10 above it.
fn ceiling_lamp() -> Face {
    quad("lamp", LAMP, turned(square([0.0, 0.0], 10.0, 10.0)))
}

/// The base, and the faces above it.
fn model(title: &str, faces: Vec<Face>, occluders: f64, camera: Camera) -> Model {
    let base = quad("base", BASE, square([0.0, 0.0], 10.0, 0.0));
    Model {
        title: title.into(),
        asset: Z_UP,
        wavelengths: Vec::new(),
        materials: vec![surface("base", [0.7; 3]), lamp(0.5, 10.0), surface("occluder", [occluders; 3])],
        faces: std::iter::once(base).chain(faces).collect(),
        cameras: vec![camera],
    }
}
