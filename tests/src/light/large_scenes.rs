//! Scenes of hundreds of surfaces: a town, a room of tiles, and rooms whose faces are cut.
use super::Surface;
use crate::random::Random;
use glam::{DMat3, DVec3};

const STREET: f64 = 3.0;

fn surface(name: String, corners: [DVec3; 4], reflectance: f64, radiance: f64) -> Surface {
    Surface { name, loops: vec![corners.to_vec()], reflectance: [reflectance; 3], radiance: [radiance; 3] }
}

/// Turned houses of any size on one ground, so many along its sides, under a lamp above its middle.
pub fn town(side: usize, seed: u64) -> Vec<Surface> {
    let mut random = Random::new(seed);
    let end = STREET * side as f64;
    let level = |low: f64, high: f64, z: f64| {
        [[low, low], [high, low], [high, high], [low, high]].map(|[x, y]| DVec3::new(x, y, z))
    };
    let mut all = vec![surface("ground".into(), level(0.0, end, 0.0), 0.4, 0.0)];
    let mut above = level(0.3 * end, 0.5 * end, 0.8 * end);
    above.reverse();
    all.push(surface("lamp".into(), above, 0.0, 10.0));
    for house in 0..side * side {
        let middle = STREET * DVec3::new((house % side) as f64 + 0.5, (house / side) as f64 + 0.5, 0.0);
        let turn = DMat3::from_rotation_z(random.range(-0.5, 0.5));
        let [a, b] = [0, 1].map(|_| random.range(0.4, 0.9));
        let base = [[-a, -b], [a, -b], [a, b], [-a, b]].map(|[x, y]| middle + turn * DVec3::new(x, y, 0.0));
        let rise = DVec3::new(0.0, 0.0, random.range(0.5, 4.0));
        let reflectance = random.range(0.2, 0.7);
        for side in 0..4 {
            let [p, q] = [base[side], base[(side + 1) % 4]];
            all.push(surface(format!("wall-{house}-{side}"), [p, q, q + rise, p + rise], reflectance, 0.0));
        }
        all.push(surface(format!("roof-{house}"), base.map(|p| p + rise), reflectance, 0.0));
    }
    all
}

/// A room whose six sides are tiles, one of them a lamp, with boxes that cover whole tiles of the floor, or parts of them.
pub fn tiled_room() -> Vec<Surface> {
    let edges = |axis: usize| [DVec3::AXES[axis], DVec3::AXES[(axis + 1) % 3]];
    let walls = [0, 2, 1].map(edges).into_iter().flat_map(|[u, v]| [[u, v], [v, u]]);
    let mut all = Vec::new();
    for (wall, [u, v]) in walls.enumerate() {
        let corner = 3.0 * (DVec3::ONE - u.cross(v) - u - v);
        for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (f64::from(i), f64::from(j)))) {
            let tile = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
            let corners = tile.map(|[x, y]| corner + (i + x) * u + (j + y) * v);
            let radiance = if wall == 1 && [i, j] == [2.0, 3.0] { 20.0 } else { 0.0 };
            all.push(surface(format!("tile-{wall}-{i}-{j}"), corners, 0.5, radiance));
        }
    }
    for (index, [low, size]) in [[1.0, 1.0], [4.0, 1.0], [2.3, 0.6], [4.4, 1.4]].into_iter().enumerate() {
        let low = DVec3::new(low, [1.0, 4.0, 3.1, 0.5][index], 0.0);
        let base =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| low + size * DVec3::new(x, y, 0.0));
        let rise = DVec3::new(0.0, 0.0, 1.0 + size);
        for side in 0..4 {
            let [p, q] = [base[side], base[(side + 1) % 4]];
            all.push(surface(format!("side-{index}-{side}"), [p, q, q + rise, p + rise], 0.5, 0.0));
        }
        all.push(surface(format!("top-{index}"), base.map(|p| p + rise), 0.5, 0.0));
    }
    all
}

/// A room of which every face with four corners is so many times so many, each less bright than the last, but for lamps.
pub fn cut(room: Vec<Surface>, times: usize) -> Vec<Surface> {
    let is_whole = |face: &Surface| {
        face.loops.len() > 1
            || face.loops[0].len() != 4
            || face.radiance.iter().any(|radiance| *radiance > 0.0)
    };
    let parts = |face: Surface| {
        if is_whole(&face) {
            return vec![face];
        }
        let at = |i: usize, j: usize| {
            let [u, v] = [i, j].map(|k| k as f64 / times as f64);
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| face.loops[0][k]);
            (1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * d + u * c)
        };
        let part = |i: usize, j: usize| Surface {
            name: format!("{}-{i}-{j}", face.name),
            loops: vec![vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]],
            reflectance: face.reflectance.map(|rho| rho * (1.0 - 0.07 * ((3 * i + 5 * j) % 7) as f64)),
            ..face.clone()
        };
        (0..times).flat_map(|i| (0..times).map(move |j| (i, j))).map(|(i, j)| part(i, j)).collect()
    };
    room.into_iter().flat_map(parts).collect()
}
