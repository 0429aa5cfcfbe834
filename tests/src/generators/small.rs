//! Few edges where doubles are too few: in each family rounding makes edges meet that do not.
use super::nasty::{jittered, ulps};
use crate::Ring;
use crate::oracle::{Operand, Rule};
use crate::random::Random;
use glam::DVec2;

/// One to four operands with a name for messages.
#[derive(Clone, Debug)]
pub struct Small {
    /// Family and seed.
    pub name: String,
    /// Each read even-odd or non-zero.
    pub operands: Vec<Operand>,
}

type Family = fn(&mut Random) -> Vec<Ring>;

const SHAPES: [(&str, Family); FAMILIES] = [
    ("near a line", near_a_line),
    ("clusters", clusters),
    ("subnormals", |random| lattice(random, DVec2::ZERO, 5e-324)),
    ("ulps at 2^52", |random| lattice(random, DVec2::splat(TWO_52 + 10.0), 1.0)),
    ("half ulps at 2^52", |random| lattice(random, DVec2::splat(TWO_52), 0.5)),
    ("mixed scales", |random| coordinates(random, &[0.0, -0.0, 1e-17, 1e-9, 1.0 / 3.0, 2.0 / 3.0, 1.0, 1e9])),
    ("tilted lattices", tilted_lattices),
    ("columns", columns),
    ("rows", |random| {
        columns(random).into_iter().map(|ring| ring.iter().map(|p| DVec2::new(p.y, p.x)).collect()).collect()
    }),
    ("fans", fans),
    ("thirds", |random| coordinates(random, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(|k| k / 3.0))),
    ("points given twice", points_given_twice),
    ("shared lines", shared_lines),
    ("nearly one ring", nearly_one_ring),
    ("nearly one point", nearly_one_point),
    ("exponents", exponents),
];

/// How many families there are.
pub const FAMILIES: usize = 16;

const TWO_52: f64 = 4_503_599_627_370_496.0;

/// The input number `seed` of a family.
pub fn small(family: usize, seed: u64) -> Small {
    let (name, make) = SHAPES[family];
    let mut random = Random::new(seed.wrapping_mul(1000) + u64::try_from(family).expect("a small number"));
    let rules = [Rule::EvenOdd, Rule::NonZero];
    let operand = |_| Operand { rings: Vec::new(), rule: rules[random.below(2)] };
    let mut operands: Vec<Operand> = (0..4).map(operand).collect();
    operands.truncate(1 + random.below(4));
    for ring in make(&mut random) {
        let operand = random.below(operands.len());
        operands[operand].rings.push(ring);
    }
    Small { name: format!("{name} {seed}"), operands }
}

/// Two to five rings of three or four points.
fn rings(random: &mut Random, mut point: impl FnMut(&mut Random) -> DVec2) -> Vec<Ring> {
    let mut ring = |random: &mut Random| (0..random.between(3, 4)).map(|_| point(random)).collect();
    (0..random.between(2, 5)).map(|_| ring(random)).collect()
}

fn unit(random: &mut Random) -> DVec2 {
    DVec2::new(random.unit(), random.unit())
}

/// Mostly a few ulps off one line.
fn near_a_line(random: &mut Random) -> Vec<Ring> {
    let (start, end) = (unit(random), unit(random));
    rings(random, |random| {
        let on_line = start.lerp(end, random.range(-1.0, 2.0));
        if random.one_in(4) { unit(random) } else { jittered(random, on_line, 2) }
    })
}

/// Half of the points a few ulps from one place.
fn clusters(random: &mut Random) -> Vec<Ring> {
    let place = unit(random);
    rings(random, |random| if random.one_in(2) { unit(random) } else { jittered(random, place, 4) })
}

fn lattice(random: &mut Random, origin: DVec2, step: f64) -> Vec<Ring> {
    let steps = |random: &mut Random| f64::from(random.between(-9, 9)) * step;
    rings(random, |random| origin + DVec2::new(steps(random), steps(random)))
}

fn coordinates(random: &mut Random, pool: &[f64]) -> Vec<Ring> {
    rings(random, |random| DVec2::new(pool[random.below(pool.len())], pool[random.below(pool.len())]))
}

/// A small lattice, turned and rounded: many edges nearly in line, many crossings nearly in one point.
fn tilted_lattices(random: &mut Random) -> Vec<Ring> {
    let turn = DVec2::from_angle(random.angle());
    let step = |random: &mut Random| f64::from(random.between(-3, 3));
    rings(random, |random| turn.rotate(DVec2::new(step(random), step(random))))
}

/// A few ulps wide and as tall as can be.
fn columns(random: &mut Random) -> Vec<Ring> {
    let place = random.unit();
    let width = random.between(1, 6);
    rings(random, |random| DVec2::new(ulps(random, place, width), random.unit()))
}

/// Needles from two tips, each to two places a few ulps apart.
fn fans(random: &mut Random) -> Vec<Ring> {
    let tips = [unit(random), unit(random)];
    let foot = unit(random);
    let mut needle = |_| {
        let tip = tips[random.below(2)];
        let foot = tip + (foot - tip) * random.range(0.5, 1.5);
        vec![tip, jittered(random, foot, 3), jittered(random, foot, 3)]
    };
    (0..5).map(&mut needle).collect()
}

/// Rings that come back to points of a small pool, some at once.
fn points_given_twice(random: &mut Random) -> Vec<Ring> {
    let place = unit(random);
    let pool: Vec<DVec2> =
        (0..5).map(|i| if i < 2 { unit(random) } else { jittered(random, place, 3) }).collect();
    let mut last = place;
    rings(random, |random| {
        last = if random.one_in(4) { last } else { pool[random.below(pool.len())] };
        last
    })
}

/// Points on the lines of a few whole directions, so that edges overlap in part, and some beside.
fn shared_lines(random: &mut Random) -> Vec<Ring> {
    let whole =
        |random: &mut Random| DVec2::new(f64::from(random.between(-5, 5)), f64::from(random.between(-5, 5)));
    let lines = [[whole(random), whole(random)], [whole(random), whole(random)]];
    rings(random, |random| {
        let [start, along] = lines[random.below(2)];
        let on_line = start + along * f64::from(random.between(-3, 3));
        if random.one_in(5) { jittered(random, on_line, 1) } else { on_line }
    })
}

/// One ring again and again, its points moved by a few ulps or not at all.
fn nearly_one_ring(random: &mut Random) -> Vec<Ring> {
    let ring: Ring = (0..4).map(|_| unit(random)).collect();
    let mut again =
        |_| ring.iter().map(|&p| if random.one_in(2) { p } else { jittered(random, p, 2) }).collect();
    (0..4).map(&mut again).collect()
}

/// Triangles with an edge each nearly through one point, on both sides of it.
fn nearly_one_point(random: &mut Random) -> Vec<Ring> {
    let place = unit(random);
    let mut triangle = |_| {
        let to = unit(random) - 0.5;
        let beyond = place + to * random.range(0.5, 2.0);
        vec![place - to, jittered(random, beyond, 1), unit(random)]
    };
    (0..5).map(&mut triangle).collect()
}

/// Every coordinate with an exponent of its own.
fn exponents(random: &mut Random) -> Vec<Ring> {
    let most = [3, 60, 1000][random.below(3)];
    let coordinate =
        |random: &mut Random| random.range(-2.0, 2.0) * 2.0_f64.powi(random.between(-most, most));
    rings(random, |random| DVec2::new(coordinate(random), coordinate(random)))
}
