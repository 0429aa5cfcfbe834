//! Layers of many rings: what people dissolve and overlay, straight and turned, near the origin and far away.
use crate::Ring;
use crate::random::Random;
use glam::DVec2;
use std::f64::consts::TAU;

type Layer = fn(&mut Random, usize) -> Vec<Ring>;

/// Each kind of layer by its name.
pub const LAYERS: [(&str, Layer); 14] = [
    ("grid", |_, n| tiles(n, |p| p)),
    ("grid, turned", |_, n| tiles(n, |p| DVec2::from_angle(0.3).rotate(p))),
    ("grid, sheared", |_, n| tiles(n, |p| DVec2::new(p.x + p.y / 3.0, p.y - p.x / 7.0))),
    ("tenths", |_, n| tiles(n, |p| p * 0.1)),
    ("parcels", parcels),
    ("skyline", skyline),
    ("skyline, turned", |random, n| turned(&skyline(random, n), 1.1)),
    ("octagons", octagons),
    ("mixed sizes", mixed_sizes),
    ("spikes", spikes),
    ("long bars through one place", bars),
    ("rectangles at 5e15", far_away),
    ("triangles on a small lattice", |random, n| lattice_triangles(random, n, |p| p)),
    ("triangles on a sheared lattice", |random, n| {
        lattice_triangles(random, n, |p| DVec2::new(p.x / 3.0 + p.y / 7.0, p.y / 3.0 - p.x / 11.0))
    }),
];

/// The layer of a kind, of about `count` rings.
pub fn layer(kind: usize, seed: u64, count: usize) -> Vec<Ring> {
    LAYERS[kind].1(&mut Random::new(seed), count)
}

fn rectangle(corner: DVec2, size: DVec2) -> Ring {
    vec![corner, corner + DVec2::new(size.x, 0.0), corner + size, corner + DVec2::new(0.0, size.y)]
}

fn turned(rings: &[Ring], angle: f64) -> Vec<Ring> {
    let turn = DVec2::from_angle(angle);
    rings.iter().map(|ring| ring.iter().map(|&p| turn.rotate(p)).collect()).collect()
}

/// A square of tiles, about `count` of them, whose corners are where `place` puts those of a lattice.
fn tiles(count: usize, mut place: impl FnMut(DVec2) -> DVec2) -> Vec<Ring> {
    let side = (1..).find(|side| side * side >= count).expect("a root");
    let side = u32::try_from(side).expect("few tiles");
    let mut corner = |x: u32, y: u32| place(DVec2::new(x.into(), y.into()));
    let corners: Vec<Vec<DVec2>> = (0..=side).map(|y| (0..=side).map(|x| corner(x, y)).collect()).collect();
    let rows = corners.windows(2).flat_map(|rows| rows[0].windows(2).zip(rows[1].windows(2)));
    rows.map(|(low, high)| vec![low[0], low[1], high[1], high[0]]).collect()
}

fn parcels(random: &mut Random, count: usize) -> Vec<Ring> {
    tiles(count, |p| p + DVec2::new(random.range(-0.3, 0.3), random.range(-0.3, 0.3)))
}

/// Houses on one base line, to the centimetre.
fn skyline(random: &mut Random, count: usize) -> Vec<Ring> {
    let mut metres = |low, high| f64::from(random.between(low, high)) / 100.0;
    let house =
        |_| rectangle(DVec2::new(metres(0, 100_000), 0.0), DVec2::new(metres(100, 10_000), metres(1, 5_000)));
    (0..count).map(house).collect()
}

fn octagons(random: &mut Random, count: usize) -> Vec<Ring> {
    let octagon = |_| {
        let center = DVec2::new(random.range(0.0, 30.0), random.range(0.0, 30.0));
        let arm = DVec2::from_angle(random.angle()) * random.range(0.3, 0.9);
        (0..8).map(|k| center + DVec2::from_angle(f64::from(k) * TAU / 8.0).rotate(arm)).collect()
    };
    (0..count).map(octagon).collect()
}

fn mixed_sizes(random: &mut Random, count: usize) -> Vec<Ring> {
    let one = |_| {
        let size = 2.0_f64.powi(random.between(-6, 5));
        rectangle(DVec2::new(random.range(0.0, 40.0), random.range(0.0, 40.0)), DVec2::new(size, size * 0.7))
    };
    (0..count).map(one).collect()
}

/// Needles a thousandth of their length wide.
fn spikes(random: &mut Random, count: usize) -> Vec<Ring> {
    let spike = |_| {
        let foot = DVec2::new(random.range(0.0, 10.0), random.range(0.0, 10.0));
        let angle = random.angle();
        vec![foot, foot + DVec2::from_angle(angle) * 9.0, foot + DVec2::from_angle(angle + 1e-3) * 9.0]
    };
    (0..count / 5).map(spike).collect()
}

/// Bars whose middles are within a few roundings of one place.
fn bars(random: &mut Random, count: usize) -> Vec<Ring> {
    let bar = |_| {
        let along = DVec2::from_angle(random.angle()) * 7.0;
        let across = along.perp() * 1e-4;
        let middle = DVec2::new(3.0, 1.0) + across * f64::from(random.between(-2, 2)) * 0.5;
        [-along - across, along - across, along + across, across - along].map(|p| middle + p).to_vec()
    };
    (0..count / 20).map(bar).collect()
}

/// Where the doubles are the even numbers or the whole numbers.
fn far_away(random: &mut Random, count: usize) -> Vec<Ring> {
    let mut whole = |low, high| f64::from(random.between(low, high));
    let one = |_| {
        let corner = DVec2::splat(5e15) + DVec2::new(whole(0, 200), whole(0, 200));
        rectangle(corner, DVec2::new(whole(1, 9), whole(1, 9)))
    };
    (0..count).map(one).collect()
}

/// Triangles on few points, so that many edges coincide, overlap and meet in common points.
fn lattice_triangles(random: &mut Random, count: usize, place: impl Fn(DVec2) -> DVec2) -> Vec<Ring> {
    let mut point = || place(DVec2::new(random.between(0, 12).into(), random.between(0, 12).into()));
    (0..count / 10).map(|_| vec![point(), point(), point()]).collect()
}
