//! Self-intersecting rings on small lattices: every degenerate contact, many times.
use super::Pair;
use crate::Ring;
use crate::oracle::{Operand, Rule};
use crate::random::Random;
use glam::DVec2;

/// Two operands of one to three random rings on a lattice of 2 × 2 to 8 × 8 points, each with a random fill rule.
pub fn lattice(seed: u64) -> Pair {
    let mut random = Random::new(seed);
    let size = random.between(2, 8);
    let (a, b) = (operand(&mut random, size), operand(&mut random, size));
    Pair { name: format!("lattice {seed}"), a, b }
}

fn operand(random: &mut Random, size: i32) -> Operand {
    let rings = (0..random.between(1, 3)).map(|_| ring(random, size)).collect();
    Operand { rings, rule: Rule::ALL[random.below(3)] }
}

fn ring(random: &mut Random, size: i32) -> Ring {
    let corners = random.between(3, 8);
    (0..corners).map(|_| point(random, size)).collect()
}

fn point(random: &mut Random, size: i32) -> DVec2 {
    let mut coordinate = || f64::from(random.between(0, size - 1));
    DVec2::new(coordinate(), coordinate())
}
