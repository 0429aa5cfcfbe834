//! Seven kinds of rooms in which light is hard to find, with sizes, places and counts from a seed.
use super::shapes::{Material, block, interior, lamp, level, matt, put_lamp, surface, turned_over};
use super::{Bands, Surface};
use crate::random::Random;
use glam::{DMat3, DVec2, DVec3};

/// The kinds.
pub const KINDS: [&str; 7] = ["box", "blocks", "door", "blades", "step", "furniture", "bright"];

const WHITE: Bands = [0.73, 0.72, 0.7];
const RED: Bands = [0.62, 0.07, 0.06];
const GREEN: Bands = [0.15, 0.48, 0.11];

/// A room of a kind.
///
/// # Panics
/// When there is no such kind.
pub fn room(kind: usize, seed: u64) -> Vec<Surface> {
    let make = [open_box, blocks, door, blades, step, furniture, bright][kind];
    make(&mut Random::new(seed.wrapping_mul(7) + u64::try_from(kind).unwrap_or_default()))
}

fn any_size(random: &mut Random, low: DVec3, high: DVec3) -> DVec3 {
    DVec3::new(random.range(low.x, high.x), random.range(low.y, high.y), random.range(low.z, high.z))
}

/// A rectangle within another one, so many of its size.
fn within(random: &mut Random, size: DVec2, shares: [f64; 2]) -> [DVec2; 2] {
    let [low, high] = shares;
    let extent = size * DVec2::new(random.range(low, high), random.range(low, high));
    let corner = (size - extent) * DVec2::new(random.range(0.2, 0.8), random.range(0.2, 0.8));
    [corner, corner + extent]
}

/// Turned blocks on the floor, each in a field of its own.
fn standing(
    random: &mut Random,
    size: DVec3,
    fields: [usize; 2],
    count: usize,
    material: Material,
) -> Vec<Surface> {
    let field = DVec2::new(size.x / fields[0] as f64, size.y / fields[1] as f64);
    let mut places: Vec<usize> = (0..fields[0] * fields[1]).collect();
    let mut all = Vec::new();
    for index in 0..count.min(places.len()) {
        let place = places.swap_remove(random.below(places.len()));
        let middle = field * DVec2::new((place % fields[0]) as f64 + 0.5, (place / fields[0]) as f64 + 0.5);
        let half = field.min_element() * DVec2::new(random.range(0.15, 0.33), random.range(0.15, 0.33));
        let height = size.z * random.range(0.1, 0.65);
        let corners = [(middle - half).extend(0.0), (middle + half).extend(height)];
        let turn = random.range(-0.7, 0.7);
        all.extend(block(&format!("block{index}"), corners, turn, material, &["bottom"]));
    }
    all
}

/// A box that is open in front, with coloured sides and two blocks.
fn open_box(random: &mut Random) -> Vec<Surface> {
    let size = any_size(random, DVec3::new(4.5, 4.5, 4.5), DVec3::new(6.5, 6.5, 6.0));
    let [white, red, green] = [WHITE, RED, GREEN].map(|reflectance| Some(matt(reflectance)));
    let mut room = interior([DVec3::ZERO, size], [white, white, None, white, red, green]);
    let at = within(random, size.truncate(), [0.15, 0.3]);
    put_lamp(&mut room, at, size.z, 17.0);
    room.extend(standing(random, size, [2, 1], 2, matt(WHITE)));
    room
}

/// A closed room with three to six blocks.
fn blocks(random: &mut Random) -> Vec<Surface> {
    let size = any_size(random, DVec3::new(4.0, 4.0, 2.4), DVec3::new(8.0, 7.0, 3.5));
    let [white, red, green] = [WHITE, RED, GREEN].map(|reflectance| Some(matt(reflectance)));
    let mut room = interior([DVec3::ZERO, size], [white, white, red, white, green, white]);
    let at = within(random, size.truncate(), [0.1, 0.25]);
    put_lamp(&mut room, at, size.z, 17.0);
    let count = 3 + random.below(4);
    room.extend(standing(random, size, [3, 2], count, matt([0.5, 0.55, 0.6])));
    room
}

/// Two rooms, a door between them, and a lamp case closely below the ceiling of one.
fn door(random: &mut Random) -> Vec<Surface> {
    let size = any_size(random, DVec3::new(6.0, 3.5, 2.4), DVec3::new(9.0, 5.0, 2.9));
    let mut room = interior([DVec3::ZERO, size], [Some(matt(WHITE)); 6]);
    let west = random.range(0.4, 0.6) * size.x;
    let (east, south) = (west + random.range(0.08, 0.2), random.range(0.2, 0.5) * size.y);
    let (north, head) = (south + random.range(0.8, 1.1), random.range(1.9, 2.15));
    let wall = |name: &str, y: [f64; 2], low: f64, without: &[&str]| {
        let corners = [DVec3::new(west, y[0], low), DVec3::new(east, y[1], size.z)];
        block(name, corners, 0.0, matt(WHITE), without)
    };
    room.extend(wall("wall0", [0.0, south], 0.0, &["bottom", "top", "south"]));
    room.extend(wall("wall1", [north, size.y], 0.0, &["bottom", "top", "north"]));
    room.extend(wall("lintel", [south, north], head, &["top", "south", "north"]));
    let middle = DVec2::new(west / 2.0, random.range(0.35, 0.65) * size.y);
    let half = DVec2::new(random.range(0.15, 0.4), random.range(0.15, 0.4));
    let top = size.z - 0.05;
    let bottom = top - random.range(0.05, 0.12);
    let corners = [(middle - half).extend(bottom), (middle + half).extend(top)];
    room.extend(block("case", corners, 0.0, matt(WHITE), &["bottom"]));
    room.push(surface("lamp", lamp(30.0), vec![turned_over(level([middle - half, middle + half], bottom))]));
    room
}

/// A room with tilted blades before its only light, a window.
fn blades(random: &mut Random) -> Vec<Surface> {
    let size = any_size(random, DVec3::new(3.0, 3.5, 2.4), DVec3::new(4.0, 5.0, 2.8));
    let mut room = interior([DVec3::ZERO, size], [Some(matt(WHITE)); 6]);
    let (left, sill) = ((size.x - 1.8) / 2.0, random.range(0.7, 0.95));
    let height = 1.3;
    // The window hangs a little before the wall, so that the wall needs no hole.
    let pane = |x: f64, z: f64| DVec3::new(x, 0.02, z);
    let (right, head) = (left + 1.8, sill + height);
    let outline = vec![pane(right, sill), pane(left, sill), pane(left, head), pane(right, head)];
    room.push(surface("window", lamp(12.0), vec![outline]));
    let (count, tilt) = (10 + random.below(5), random.range(-0.9, 0.9));
    for index in 0..count {
        let z = sill + height * (index as f64 + 0.5) / count as f64;
        let middle = DVec3::new(size.x / 2.0, 0.15, z);
        let half = DVec3::new(0.95, 0.05, 0.001);
        let turn = DMat3::from_rotation_x(tilt);
        let mut blade = block(&format!("blade{index}"), [-half, half], 0.0, matt([0.6; 3]), &[]);
        blade
            .iter_mut()
            .flat_map(|face| face.loops.iter_mut().flatten())
            .for_each(|p| *p = turn * *p + middle);
        room.extend(blade);
    }
    room
}

/// A low step on a floor under grazing light.
fn step(random: &mut Random) -> Vec<Surface> {
    let size = any_size(random, DVec3::new(4.0, 3.0, 2.2), DVec3::new(6.0, 4.0, 2.6));
    let grey = Some(matt([0.5; 3]));
    let mut room = interior([DVec3::ZERO, size], [grey; 6]);
    let [low, high] = within(random, size.truncate(), [0.3, 0.5]);
    let rise = random.range(0.015, 0.03);
    room.extend(block("step", [low.extend(0.0), high.extend(rise)], 0.0, matt([0.5; 3]), &["bottom"]));
    let (y, z) = (random.range(0.3, 0.7) * size.y, random.range(0.1, 0.3));
    let pane = |y: f64, z: f64| DVec3::new(0.03, y, z);
    let outline = vec![pane(y, z), pane(y + 0.4, z), pane(y + 0.4, z + 0.2), pane(y, z + 0.2)];
    room.push(surface("lamp", lamp(40.0), vec![outline]));
    room
}

/// A slab on four legs.
fn on_legs(
    name: &str,
    middle: DVec2,
    half: DVec2,
    heights: [f64; 2],
    leg: f64,
    material: Material,
) -> Vec<Surface> {
    let [low, high] = heights;
    let mut all =
        block(name, [(middle - half).extend(low), (middle + half).extend(high)], 0.0, material, &[]);
    for (index, corner) in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].into_iter().enumerate() {
        let at = middle + DVec2::from(corner) * (half - 1.5 * leg);
        let half = DVec2::splat(leg / 2.0);
        let corners = [(at - half).extend(0.0), (at + half).extend(low)];
        all.extend(block(&format!("{name}-leg{index}"), corners, 0.0, material, &["bottom", "top"]));
    }
    all
}

/// A table and chairs with thin legs.
fn furniture(random: &mut Random) -> Vec<Surface> {
    let size = any_size(random, DVec3::new(4.0, 4.0, 2.4), DVec3::new(5.5, 5.0, 2.8));
    let mut room = interior([DVec3::ZERO, size], [Some(matt(WHITE)); 6]);
    let at = within(random, size.truncate(), [0.1, 0.2]);
    put_lamp(&mut room, at, size.z, 20.0);
    let wood = matt([0.45, 0.3, 0.18]);
    let middle = size.truncate() / 2.0;
    let half = DVec2::new(random.range(0.5, 0.9), random.range(0.35, 0.5));
    room.extend(on_legs("table", middle, half, [0.7, 0.73], random.range(0.03, 0.06), wood));
    let count = 1 + random.below(3);
    for index in 0..count {
        let side = if index % 2 == 0 { -1.0 } else { 1.0 };
        let along = (index / 2) as f64 * 0.6 - 0.2;
        let place = middle + DVec2::new(along, side * (half.y + random.range(0.15, 0.35)));
        let name = format!("chair{index}");
        room.extend(on_legs(&name, place, DVec2::splat(0.2), [0.43, 0.46], 0.03, wood));
        let y = place.y + side * 0.19;
        let corners = [DVec3::new(place.x - 0.18, y - 0.01, 0.46), DVec3::new(place.x + 0.18, y + 0.01, 0.9)];
        room.extend(block(&format!("{name}-back"), corners, 0.0, wood, &["bottom"]));
    }
    room
}

/// A closed room with a bright finish.
fn bright(random: &mut Random) -> Vec<Surface> {
    let size = any_size(random, DVec3::splat(2.0), DVec3::splat(4.0));
    let mut room = interior([DVec3::ZERO, size], [Some(matt([0.9, 0.9, 0.85])); 6]);
    let at = within(random, size.truncate(), [0.2, 0.5]);
    put_lamp(&mut room, at, size.z, 5.0);
    room
}
