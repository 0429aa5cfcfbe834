//! The kinds of input on which polygon libraries fail.
use super::{Pair, ring_of};
use crate::Ring;
use crate::oracle::{Operand, Rule};
use crate::random::Random;
use glam::DVec2;
use std::f64::consts::{PI, TAU};

type Maker = fn(&mut Random) -> [Vec<Ring>; 2];

/// Each kind with its name.
pub const KINDS: [(&str, Maker); 24] = [
    ("near-collinear", near_collinear),
    ("slivers 1e-12", slivers),
    ("edges through one point", concurrent),
    ("1e-9 mixed with 1e9", mixed_scales),
    ("offset 1e15", far_away),
    ("scale 1e150", |r| scaled(r, 1e150)),
    ("scale 1e-150", |r| scaled(r, 1e-150)),
    ("shared edges", shared_edges),
    ("rotated by 1e-9", |r| rotated(r, 1e-9)),
    ("rotated by 1e-12", |r| rotated(r, 1e-12)),
    ("rotated by 1e-15", |r| rotated(r, 1e-15)),
    ("self-touching", self_touching),
    ("bow-ties", bow_ties),
    ("spikes", spikes),
    ("pentagrams", pentagrams),
    ("identical rings", identical),
    ("small lattices", small_lattice),
    ("random walks", random_walks),
    ("needles", needles),
    ("exponents 300", |r| exponents(r, 300)),
    ("exponents 1000", |r| exponents(r, 1000)),
    ("subnormals", subnormals),
    ("stacked slabs", stacked_slabs),
    ("general position", general),
];

/// The input number `seed` of a kind (an index into [`KINDS`]).
pub fn nasty(kind: usize, seed: u64) -> Pair {
    let (name, make) = KINDS[kind];
    let mut random = Random::new(seed.wrapping_mul(1000) + u64::try_from(kind).expect("a small number"));
    let [a, b] = make(&mut random);
    let mut operand = |rings| Operand { rings, rule: Rule::ALL[random.below(3)] };
    Pair { name: format!("{name} {seed}"), a: operand(a), b: operand(b) }
}

fn polygon(random: &mut Random, corners: i32, center: DVec2, radius: f64) -> Vec<DVec2> {
    let turn = random.angle();
    let corner = |i: i32| center + radius * DVec2::from_angle(turn + TAU * f64::from(i) / f64::from(corners));
    (0..corners).map(corner).collect()
}

fn near(random: &mut Random) -> DVec2 {
    DVec2::new(random.range(-1.0, 1.0), random.range(-1.0, 1.0))
}

pub(super) fn ulps(random: &mut Random, value: f64, most: i32) -> f64 {
    let mut moved = value;
    for _ in 0..random.between(0, most) {
        moved = if random.one_in(2) { moved.next_up() } else { moved.next_down() };
    }
    moved
}

pub(super) fn jittered(random: &mut Random, p: DVec2, most: i32) -> DVec2 {
    DVec2::new(ulps(random, p.x, most), ulps(random, p.y, most))
}

/// Corners a few ulps off one line, closed by a far one.
fn near_collinear(random: &mut Random) -> [Vec<Ring>; 2] {
    let (start, along) = (near(random), near(random));
    let mut make = || {
        let mut points: Vec<DVec2> =
            (0..random.between(3, 6)).map(|_| start + along * random.range(-2.0, 2.0)).collect();
        points.iter_mut().for_each(|p| *p = jittered(random, *p, 3));
        points.push(near(random) * 3.0);
        ring_of(points)
    };
    [make(), make()]
}

/// Triangles with a height of 1e-12 across one line.
fn slivers(random: &mut Random) -> [Vec<Ring>; 2] {
    let mut make = || {
        let sliver = |random: &mut Random| {
            let height = 1e-12 * random.range(-2.0, 2.0);
            vec![
                DVec2::new(random.range(-1.0, 0.0), 0.7),
                DVec2::new(random.range(0.0, 1.0), 0.7 + height),
                DVec2::new(random.range(-0.5, 0.5), 0.7 - 1e-12 * random.unit()),
            ]
        };
        (0..random.between(1, 4)).map(|_| sliver(random)).collect()
    };
    [make(), make()]
}

/// Triangles with one edge each through a common point, up to rounding.
fn concurrent(random: &mut Random) -> [Vec<Ring>; 2] {
    let hub = near(random);
    let is_on_grid = random.one_in(2);
    let mut make = || {
        let triangle = |random: &mut Random| {
            let to = if is_on_grid { (near(random) * 8.0).round() / 8.0 } else { near(random) };
            let center = if is_on_grid { DVec2::ZERO } else { hub };
            vec![center - to, center + to, near(random)]
        };
        (0..random.between(2, 4)).map(|_| triangle(random)).collect()
    };
    [make(), make()]
}

fn mixed_scales(random: &mut Random) -> [Vec<Ring>; 2] {
    let mut make = || {
        let scales = [1e-9, 1.0, 1e9];
        ring_of((0..random.between(4, 7)).map(|_| near(random) * scales[random.below(3)]))
    };
    [make(), make()]
}

fn far_away(random: &mut Random) -> [Vec<Ring>; 2] {
    let offset = DVec2::new(1e15, -1e15);
    let mut make = || {
        let size = random.range(1.0, 40.0);
        ring_of((0..random.between(3, 7)).map(|_| offset + near(random) * size))
    };
    [make(), make()]
}

fn scaled(random: &mut Random, scale: f64) -> [Vec<Ring>; 2] {
    let mut make = || ring_of((0..random.between(3, 6)).map(|_| near(random) * scale));
    [make(), make()]
}

/// Two polygons on one pool of corners, so that edges coincide, in whole or in part.
fn shared_edges(random: &mut Random) -> [Vec<Ring>; 2] {
    let pool: Vec<DVec2> = (0..5).map(|_| near(random)).collect();
    let mut make = || ring_of((0..random.between(3, 6)).map(|_| pool[random.below(pool.len())]));
    [make(), make()]
}

/// A polygon and itself turned by a tiny angle about the origin.
fn rotated(random: &mut Random, angle: f64) -> [Vec<Ring>; 2] {
    let corners = random.between(3, 8);
    let center = near(random);
    let points = polygon(random, corners, center, 1.0);
    let turn = DVec2::from_angle(angle * random.range(0.5, 2.0));
    let turned: Vec<DVec2> = points.iter().map(|p| turn.rotate(*p)).collect();
    [ring_of(points), ring_of(turned)]
}

/// A ring that comes back to its own corners and edges.
fn self_touching(random: &mut Random) -> [Vec<Ring>; 2] {
    let mut make = || {
        let hub = DVec2::new(f64::from(random.between(-2, 2)), f64::from(random.between(-2, 2)));
        let mut points = Vec::new();
        for _ in 0..random.between(2, 3) {
            let out = DVec2::new(f64::from(random.between(-4, 4)), f64::from(random.between(-4, 4)));
            points.extend([hub, hub + out, hub + out.perp() + out]);
        }
        ring_of(points)
    };
    [make(), make()]
}

fn bow_ties(random: &mut Random) -> [Vec<Ring>; 2] {
    let mut make = || {
        let (p, q) = (near(random), near(random));
        ring_of([p, q, DVec2::new(p.x, q.y), DVec2::new(q.x, p.y)])
    };
    [make(), make()]
}

/// A polygon with an edge that runs out and straight back.
fn spikes(random: &mut Random) -> [Vec<Ring>; 2] {
    let mut make = || {
        let corners = random.between(3, 6);
        let mut points = polygon(random, corners, DVec2::ZERO, 1.0);
        for _ in 0..random.between(1, 2) {
            let at = random.below(points.len());
            let (foot, tip) = (points[at], near(random) * 2.0);
            points.splice(at..at, [foot, tip]);
        }
        ring_of(points)
    };
    [make(), make()]
}

fn pentagrams(random: &mut Random) -> [Vec<Ring>; 2] {
    let mut make = || {
        let center = near(random) * 0.5;
        let star = polygon(random, 5, center, 1.0);
        ring_of([0, 2, 4, 1, 3].map(|i| star[i]))
    };
    [make(), make()]
}

/// The same ring on both sides, started elsewhere and perhaps reversed, perhaps twice.
fn identical(random: &mut Random) -> [Vec<Ring>; 2] {
    let points: Vec<DVec2> = (0..random.between(3, 7)).map(|_| near(random)).collect();
    let mut other = points.clone();
    other.rotate_left(random.below(points.len()));
    if random.one_in(2) {
        other.reverse();
    }
    let copies = if random.one_in(3) { 2 } else { 1 };
    [vec![points], vec![other; copies]]
}

fn small_lattice(random: &mut Random) -> [Vec<Ring>; 2] {
    let size = random.between(2, 4);
    let step = random.range(0.1, 1.0);
    let mut make = || {
        let mut coordinate = || f64::from(random.between(0, size)) * step;
        ring_of((0..6).map(|_| DVec2::new(coordinate(), coordinate())))
    };
    [make(), make()]
}

fn random_walks(random: &mut Random) -> [Vec<Ring>; 2] {
    let mut make = || {
        let mut at = near(random);
        let steps = random.between(8, 24);
        ring_of((0..steps).map(|_| {
            at += near(random) * 0.3;
            at
        }))
    };
    [make(), make()]
}

/// Triangles a million million times longer than wide.
fn needles(random: &mut Random) -> [Vec<Ring>; 2] {
    let mut make = || {
        let needle = |random: &mut Random| {
            let (tip, along) = (near(random), DVec2::from_angle(random.range(0.0, PI)));
            let foot = tip + along * 2.0;
            vec![tip, foot, jittered(random, foot, 4)]
        };
        (0..random.between(1, 4)).map(|_| needle(random)).collect()
    };
    [make(), make()]
}

/// Every coordinate with an exponent of its own.
fn exponents(random: &mut Random, most: i32) -> [Vec<Ring>; 2] {
    let mut make = || {
        let coordinate =
            |random: &mut Random| random.range(-2.0, 2.0) * 2.0_f64.powi(random.between(-most, most));
        ring_of((0..random.between(3, 5)).map(|_| DVec2::new(coordinate(random), coordinate(random))))
    };
    [make(), make()]
}

/// Lattice rings in units of the smallest double.
fn subnormals(random: &mut Random) -> [Vec<Ring>; 2] {
    let mut make = || {
        let mut coordinate = || f64::from(random.between(-5, 5)) * 5e-324;
        ring_of((0..5).map(|_| DVec2::new(coordinate(), coordinate())))
    };
    [make(), make()]
}

/// Flat quadrilaterals in a slab of a few ulps, where rounding makes edges meet.
fn stacked_slabs(random: &mut Random) -> [Vec<Ring>; 2] {
    let height = [1e-12, 1e-13, 1e-14, 1e-15][random.below(4)];
    let mut make = || {
        let quad = |random: &mut Random| {
            let mut y = || 0.7 + height * random.unit();
            let [a, b, c, d] = [y(), y(), y(), y()];
            let (left, right) = (random.range(0.0, 0.5), random.range(0.5, 1.0));
            vec![DVec2::new(left, a), DVec2::new(right, b), DVec2::new(right, c), DVec2::new(left, d)]
        };
        (0..random.between(2, 5)).map(|_| quad(random)).collect()
    };
    [make(), make()]
}

fn general(random: &mut Random) -> [Vec<Ring>; 2] {
    let mut make = || ring_of((0..random.between(3, 12)).map(|_| near(random)));
    [make(), make()]
}
