//! Closed rooms of six kinds with what stands in them: whatever a surface faces is a surface of the room, so that the form factors of
//! each from area to area add to 1.
//!
//! Surfaces face inwards, each point is seen by one of them only: where something stands, the floor has a hole.
use crate::random::Random;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// The kinds of rooms.
pub const KINDS: [&str; 6] = ["corner", "star", "columns", "blocks", "table", "gable"];

/// The loops of each surface.
pub type Room = Vec<Vec<Vec<DVec3>>>;

/// A closed room of a kind.
#[must_use]
pub fn room(kind: usize, seed: u64) -> Room {
    let mut random = Random::new(7919 * seed + kind as u64);
    let height = random.range(2.2, 3.5);
    let size = DVec2::new(random.range(3.0, 8.0), random.range(3.0, 8.0));
    match kind {
        0 => prism(&corner(size, &mut random), height, &[]),
        1 => prism(&star(&mut random), height, &[]),
        2 => prism(&rectangle(DVec2::ZERO, size), height, &columns(size, &mut random)),
        3 => stand(prism(&rectangle(DVec2::ZERO, size), height, &[]), 0.0, &blocks(size, &mut random)),
        4 => set(prism(&rectangle(DVec2::ZERO, size), height, &[]), size, &mut random),
        _ => {
            let top = height + random.range(0.5, 2.0);
            set(gable(size, [height, top]), size, &mut random)
        }
    }
}

/// Counter-clockwise.
fn rectangle(at: DVec2, size: DVec2) -> Vec<DVec2> {
    let (x, y) = (DVec2::new(size.x, 0.0), DVec2::new(0.0, size.y));
    vec![at, at + x, at + size, at + y]
}

/// An L.
fn corner(size: DVec2, random: &mut Random) -> Vec<DVec2> {
    let notch = size * DVec2::new(random.range(0.2, 0.6), random.range(0.2, 0.6));
    let inner = size - notch;
    let [first, second, third, fourth] = [[size.x, 0.0], [size.x, inner.y], inner.into(), [inner.x, size.y]];
    [[0.0; 2], first, second, third, fourth, [0.0, size.y]].map(DVec2::from).to_vec()
}

/// A polygon of 5 to 11 corners that its middle sees.
fn star(random: &mut Random) -> Vec<DVec2> {
    let count = 5 + random.below(7);
    let turn = |i: usize| DVec2::from_angle(TAU * i as f64 / count as f64);
    (0..count).map(|i| turn(i) * random.range(1.5, 5.0)).collect()
}

/// Two turned squares.
fn columns(size: DVec2, random: &mut Random) -> Vec<Vec<DVec2>> {
    let mut column = |share: f64| {
        let middle = size * DVec2::new(share, random.range(0.3, 0.7));
        let (turn, radius) = (random.angle(), random.range(0.1, 0.3));
        (0..4).map(|i| middle + radius * DVec2::from_angle(turn + TAU * f64::from(i) / 4.0)).collect()
    };
    vec![column(0.27), column(0.7)]
}

/// Two outlines with heights.
fn blocks(size: DVec2, random: &mut Random) -> Vec<(Vec<DVec2>, f64)> {
    let mut block = |share: f64| {
        let at = size * DVec2::new(share, random.range(0.1, 0.5));
        let own = DVec2::new(random.range(0.1, 0.3), random.range(0.1, 0.3));
        (rectangle(at, size * own), random.range(0.3, 2.0))
    };
    vec![block(0.15), block(0.6)]
}

fn lifted(outline: &[DVec2], height: f64) -> Vec<DVec3> {
    outline.iter().map(|p| p.extend(height)).collect()
}

fn turned_over(mut points: Vec<DVec3>) -> Vec<DVec3> {
    points.reverse();
    points
}

/// What is above the sides of an outline that is on the left of each, seen from there.
fn sides(outline: &[DVec2], [low, high]: [f64; 2]) -> impl Iterator<Item = Vec<Vec<DVec3>>> {
    outline
        .iter()
        .zip(outline.iter().cycle().skip(1))
        .map(move |(a, b)| vec![vec![a.extend(low), a.extend(high), b.extend(high), b.extend(low)]])
}

/// A room with an outline, counter-clockwise, and columns from the floor, which comes first, to the ceiling.
fn prism(outline: &[DVec2], height: f64, columns: &[Vec<DVec2>]) -> Room {
    let inverse = |column: &Vec<DVec2>| column.iter().rev().copied().collect::<Vec<_>>();
    let holes: Vec<Vec<DVec2>> = columns.iter().map(inverse).collect();
    let outlines = || std::iter::once(outline).chain(holes.iter().map(Vec::as_slice));
    let floor = outlines().map(|outline| lifted(outline, 0.0)).collect();
    let ceiling = outlines().map(|outline| turned_over(lifted(outline, height))).collect();
    let walls = outlines().flat_map(|outline| sides(outline, [0.0, height]));
    [floor, ceiling].into_iter().chain(walls).collect()
}

/// A room of a size under a roof with its ridge along x.
fn gable(size: DVec2, [eaves, top]: [f64; 2]) -> Room {
    let at = |x: f64, y: f64, z: f64| DVec3::new(x * size.x, y * size.y, z);
    let [west, east] = [0.0, 1.0].map(|x| {
        [at(x, 0.0, 0.0), at(x, 1.0, 0.0), at(x, 1.0, eaves), at(x, 0.5, top), at(x, 0.0, eaves)].to_vec()
    });
    let roof = |y: f64| [at(0.0, y, eaves), at(0.0, 0.5, top), at(1.0, 0.5, top), at(1.0, y, eaves)].to_vec();
    let mut room: Room = vec![vec![lifted(&rectangle(DVec2::ZERO, size), 0.0)]];
    room.extend([west, turned_over(east), roof(0.0), turned_over(roof(1.0))].map(|points| vec![points]));
    let wall = |y: f64| [at(0.0, y, 0.0), at(0.0, y, eaves), at(1.0, y, eaves), at(1.0, y, 0.0)].to_vec();
    room.extend([wall(0.0), turned_over(wall(1.0))].map(|points| vec![points]));
    room
}

/// The room with blocks on its floor, from a height on.
fn stand(mut room: Room, low: f64, blocks: &[(Vec<DVec2>, f64)]) -> Room {
    for (outline, height) in blocks {
        let inverse: Vec<DVec2> = outline.iter().rev().copied().collect();
        room[0].push(lifted(&inverse, low));
        room.extend(sides(&inverse, [low, *height]));
        room.push(vec![lifted(outline, *height)]);
    }
    room
}

/// The room with a table: a top on four legs, which touch it from below.
fn set(mut room: Room, size: DVec2, random: &mut Random) -> Room {
    const LEG: f64 = 0.05;
    let at = size * DVec2::new(random.range(0.1, 0.4), random.range(0.1, 0.4));
    let own = size * DVec2::new(random.range(0.25, 0.5), random.range(0.25, 0.5));
    let height = random.range(0.5, 0.9);
    let mut below = vec![turned_over(lifted(&rectangle(at, own), height))];
    for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
        let foot = rectangle(at + (own - LEG) * DVec2::new(x, y), DVec2::splat(LEG));
        let inverse: Vec<DVec2> = foot.iter().rev().copied().collect();
        room[0].push(lifted(&inverse, 0.0));
        below.push(lifted(&foot, height));
        room.extend(sides(&inverse, [0.0, height]));
    }
    let inverse: Vec<DVec2> = rectangle(at, own).into_iter().rev().collect();
    room.extend(sides(&inverse, [height, height + 0.04]));
    room.extend([below, vec![lifted(&rectangle(at, own), height + 0.04)]]);
    room
}
