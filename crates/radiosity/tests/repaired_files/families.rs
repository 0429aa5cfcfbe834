//! Meshes with every kind of dirt.
use super::random::Random;
use super::shapes::{Outlines, block, level};
use radiosity::glam::DVec3;

/// A kind of dirt: its name, and how the meshes of some nodes get it.
pub(crate) type Family = (&'static str, fn(&mut Random) -> Vec<Outlines>);

pub(crate) const FAMILIES: [Family; 8] = [
    ("overlap", |random| {
        let mut rectangle = || {
            let [x, y] = [random.next(), random.next()];
            vec![level([x, y, x + 0.1 + random.next(), y + 0.1 + random.next()], 0.0)]
        };
        (0..6).map(|_| rectangle()).collect()
    }),
    ("interpenetration", |random| {
        let mut solid = || {
            let low = DVec3::new(random.next(), random.next(), 0.0);
            block(low, low + DVec3::new(0.3 + random.next(), 0.3 + random.next(), 1.0))
        };
        let solids = [solid(), solid(), solid()];
        [vec![vec![level([-1.0, -1.0, 3.0, 3.0], 0.0)]], solids.to_vec()].concat()
    }),
    ("doubled faces", |random| {
        let solid = block(DVec3::ZERO, DVec3::new(1.0, 0.2 + random.next(), 0.3));
        vec![[solid.clone(), vec![solid[1].clone()]].concat(), vec![solid[3].clone()]]
    }),
    ("slivers", |random| {
        let width = 1e-15 * random.next();
        let thin = vec![DVec3::ZERO, DVec3::X, DVec3::X + width * DVec3::Y];
        let flat = vec![DVec3::ZERO, DVec3::Y, 2.0 * DVec3::Y];
        vec![vec![level([0.0, 0.0, 1.0, 1.0], 0.0), thin, flat], vec![level([1.0, 0.0, 2.0, 1.0], 0.0)]]
    }),
    ("T-junctions", |random| {
        let share = 0.2 + 0.6 * random.next();
        let halves = [level([1.0, 0.0, 2.0, share], 0.0), level([1.0, share, 2.0, 1.0], 0.0)];
        vec![vec![level([0.0, 0.0, 1.0, 1.0], 0.0)], halves.to_vec(), vec![level([0.5, 0.5, 1.5, 0.7], 0.0)]]
    }),
    ("cracks", |random| {
        let mut off = || 3e-7 * (random.next() - 0.5);
        let tiles =
            (0..3).map(|k| vec![level([f64::from(k) + off(), off(), f64::from(k + 1) + off(), 1.0], off())]);
        tiles.collect()
    }),
    ("bent faces", |random| {
        let mut bent = level([0.0, 0.0, 1.0, 1.0], 0.0);
        bent[2].z = 0.1 * random.next();
        vec![vec![bent, level([1.0, 0.0, 2.0, 1.0], 0.0)], vec![level([0.5, 0.0, 1.5, 1.0], 0.0)]]
    }),
    ("thin strips", |random| {
        let width = 10_f64.powf(-7.0 + 3.0 * random.next());
        let lid = level([0.2 * random.next(), width, 1.0 - width, 1.0 - width], 0.0);
        vec![vec![level([0.0, 0.0, 1.0, 1.0], 0.0)], vec![lid]]
    }),
];
