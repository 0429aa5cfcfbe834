//! Families of scenes of any size, each of about as many patches as are asked for.
use radiosity::formfactor::PlanarPolygon;
use radiosity::glam::DVec3;
use radiosity::{Asset, Camera, Lamp, Patch, Scene, Sky, SkyKind};
use std::f64::consts::TAU;

/// A family: its name, and its scene of about so many patches.
pub(crate) type Family = (&'static str, fn(usize) -> Scene);

/// All families.
pub(crate) const FAMILIES: [Family; 5] =
    [("town", town), ("sky", town_under_a_sky), ("room", room), ("torus", torus), ("row", row)];

/// One in so many tiles, or houses, gives light.
const LAMPS: usize = 64;

/// The ways along the walls of a cube whose fronts are inside: floor, ceiling, and four around.
const WALLS: [[DVec3; 2]; 6] = [
    [DVec3::X, DVec3::Y],
    [DVec3::Y, DVec3::X],
    [DVec3::Z, DVec3::X],
    [DVec3::X, DVec3::Z],
    [DVec3::Y, DVec3::Z],
    [DVec3::Z, DVec3::Y],
];

/// Houses of all heights on one ground, lit by a lamp above and by some of their roofs.
fn town(patches: usize) -> Scene {
    let side = (patches / 5).isqrt().max(2);
    let end = 2.0 * side as f64;
    let mut parts = Parts::default();
    parts.grid("ground", [DVec3::ZERO, end * DVec3::X, end * DVec3::Y], 1);
    for house in 0..side * side {
        let corner =
            DVec3::new((house % side) as f64, (house / side) as f64, 0.0) * 2.0 + 0.5 * (DVec3::X + DVec3::Y);
        parts.block(
            &format!("house-{house}"),
            corner,
            DVec3::new(1.0, 1.0, 1.0 + (house * 7919 % 97) as f64 / 32.0),
        );
        parts.light(house);
    }
    let lamp = Lamp::even("lamp", DVec3::new(0.3 * end, 0.6 * end, end), vec![end * end; 3]);
    let scene = parts.seen(DVec3::new(-0.2, -0.2, 0.4) * end, DVec3::new(1.0, 1.0, -0.5));
    Scene { lamps: vec![lamp], ..scene }
}

/// The same town under an overcast sky.
fn town_under_a_sky(patches: usize) -> Scene {
    let sky = Sky { radiance: vec![1.0; 3], kind: SkyKind::Overcast };
    Scene { lamps: Vec::new(), sky: Some(sky), ..town(patches) }
}

/// A room of tiles with boxes on its floor; some of its tiles are lamps.
fn room(patches: usize) -> Scene {
    let side = (2 * patches / 13).isqrt().max(4);
    let mut parts = Parts::default();
    for (wall, edges) in walls().enumerate() {
        parts.grid(&format!("wall-{wall}"), edges, side);
    }
    (0..parts.patches.len()).for_each(|tile| parts.light_at(tile, tile));
    let row = side.div_ceil(3);
    let step = 10.0 / row as f64;
    for piece in 0..row * row {
        let corner = DVec3::new((piece % row) as f64 + 0.3, (piece / row) as f64 + 0.3, 0.0) * step;
        parts.block(&format!("box-{piece}"), corner, DVec3::new(0.4, 0.4, 0.6) * step);
    }
    parts.seen(DVec3::new(1.0, 1.0, 5.0), DVec3::new(1.0, 1.0, -0.2))
}

/// A smooth torus of small facets in a room of six walls, one of them a lamp.
fn torus(patches: usize) -> Scene {
    let around = (2 * patches).isqrt().max(8);
    let across = (patches / around).max(4);
    let mut parts = Parts::default();
    for (wall, edges) in walls().enumerate() {
        parts.grid(&format!("wall-{wall}"), edges, 1);
    }
    parts.light(0);
    let place = |i: usize, j: usize| {
        let [turn, tilt] =
            [(i % around, around), (j % across, across)].map(|(k, of)| TAU * k as f64 / of as f64);
        let reach = 3.0 + tilt.cos();
        DVec3::new(5.0 + reach * turn.cos(), 5.0 + reach * turn.sin(), 5.0 + tilt.sin())
    };
    for (i, j) in (0..around).flat_map(|i| (0..across).map(move |j| (i, j))) {
        // The four corners lie in one plane, as the two edges along the tube are parallel.
        let corners = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
        parts.add(format!("facet-{i}-{j}"), corners);
        parts.patches.last_mut().expect("it was added").smoothing = Some(1);
    }
    parts.seen(DVec3::new(1.0, 1.0, 9.0), DVec3::new(1.0, 1.0, -1.0))
}

/// Tiles in one long row with gaps between them, and as many above them, some of which are lamps.
fn row(patches: usize) -> Scene {
    let mut parts = Parts::default();
    for tile in 0..patches.div_ceil(2) {
        let corner = tile as f64 * DVec3::X;
        parts.grid(&format!("tile-{tile}"), [corner, 0.9 * DVec3::X, DVec3::Y], 1);
        parts.grid(&format!("shade-{tile}"), [corner + 2.0 * DVec3::Z, DVec3::Y, 0.9 * DVec3::X], 1);
        parts.light(tile);
    }
    parts.seen(DVec3::new(-2.0, 0.5, 1.0), DVec3::X)
}

/// A corner and two edges of each wall of a cube from 0 to 10.
fn walls() -> impl Iterator<Item = [DVec3; 3]> {
    WALLS.into_iter().map(|[u, v]| [5.0 * (DVec3::ONE - u.cross(v) - u - v), 10.0 * u, 10.0 * v])
}

/// The patches of a scene so far.
#[derive(Default)]
struct Parts {
    patches: Vec<Patch>,
}

impl Parts {
    /// A grey patch.
    fn add(&mut self, name: String, corners: [DVec3; 4]) {
        let polygon = PlanarPolygon::new([corners]).expect("a planar polygon");
        self.patches.push(Patch::new(name, polygon, vec![0.5; 3], vec![0.0; 3]));
    }

    /// A rectangle, given by a corner and two edges, of n × n tiles.
    fn grid(&mut self, name: &str, [corner, along, across]: [DVec3; 3], n: usize) {
        let at = |i: usize, j: usize| corner + i as f64 / n as f64 * along + j as f64 / n as f64 * across;
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            self.add(format!("{name}-{i}-{j}"), [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }

    /// A block that stands on something: four sides and a top, the last.
    fn block(&mut self, name: &str, low: DVec3, size: DVec3) {
        let [x, y, z] = [size.x * DVec3::X, size.y * DVec3::Y, size.z * DVec3::Z];
        let sides = [[low, x, z], [low + x, y, z], [low + x + y, -x, z], [low + y, -y, z], [low + z, x, y]];
        for (side, edges) in sides.into_iter().enumerate() {
            self.grid(&format!("{name}-{side}"), edges, 1);
        }
    }

    /// Makes a patch a lamp, if it is the turn of one.
    fn light_at(&mut self, index: usize, turn: usize) {
        if turn % LAMPS == 0 {
            self.patches[index].emission = vec![1.0; 3];
        }
    }

    /// The same for the last patch.
    fn light(&mut self, turn: usize) {
        self.light_at(self.patches.len() - 1, turn);
    }

    /// The scene, z up, with a camera.
    fn seen(self, position: DVec3, direction: DVec3) -> Scene {
        let camera = Camera {
            name: "camera".into(),
            position,
            direction,
            up: DVec3::Z,
            vertical_fov: 1.0,
            aspect: 1.5,
        };
        let asset = Asset { up: DVec3::Z, unit: 1.0 };
        Scene { patches: self.patches, bands: 3, cameras: vec![camera], asset, ..Scene::default() }
    }
}
