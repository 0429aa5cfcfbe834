//! Thousands of edges over one another.
use crate::Ring;
use crate::random::Random;
use glam::DVec2;

/// Small polygons, spikes and long bars over one another: thousands of edges and of crossings.
pub fn crowd(seed: u64, count: usize) -> Vec<Ring> {
    let mut random = Random::new(seed);
    let mut ring = |_| {
        let center = DVec2::new(random.range(0.0, 20.0), random.range(0.0, 20.0));
        let corners = random.between(3, 9);
        let stretch = if random.one_in(8) { DVec2::new(12.0, 0.1) } else { DVec2::ONE };
        let turn = DVec2::from_angle(random.angle());
        let mut corner = |i: i32| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(corners);
            center + turn.rotate(DVec2::from_angle(angle) * stretch * random.range(0.2, 1.0))
        };
        (0..corners).map(&mut corner).collect()
    };
    (0..count).map(&mut ring).collect()
}
