//! Layers of polygons to dissolve: parcels with common borders, buildings on one base line.

use crate::job::{Job, Parts, Polygon, Ring};
use crate::random::Random;

/// √n × √n cells of a grid whose inner vertices are moved by up to 0.3 of a cell; an inner side has up to two more vertices.
/// So a cell is a ring of 4 to 12 vertices, and neighbours share theirs.
pub(super) fn parcels(n: usize) -> Job {
    let side = n.isqrt();
    let mut random = Random::new(13);
    let is_inner = |i: usize| i > 0 && i < side;
    let corners: Vec<Ring> = (0..=side)
        .map(|i| {
            let mut moved = |c: usize| c as f64 + if is_inner(c) { random.within(-0.3, 0.3) } else { 0.0 };
            (0..=side).map(|j| [moved(i), moved(j)]).collect()
        })
        .collect();
    let mut path = |a: [f64; 2], b: [f64; 2], is_inner: bool| between(&mut random, a, b, is_inner);
    let cells = |f: &mut dyn FnMut(usize, usize) -> Ring, rows, columns| -> Vec<Vec<Ring>> {
        (0..rows).map(|i| (0..columns).map(|j| f(i, j)).collect()).collect()
    };
    let east = cells(&mut |i, j| path(corners[i][j], corners[i + 1][j], is_inner(j)), side, side + 1);
    let north = cells(&mut |i, j| path(corners[i][j], corners[i][j + 1], is_inner(i)), side + 1, side);
    let parcel = |i: usize, j: usize| -> Polygon {
        let there = east[i][j].iter().chain(&north[i + 1][j]).copied();
        let back = |path: &Ring, to: [f64; 2]| -> Ring {
            std::iter::once(to).chain(path[1..].iter().rev().copied()).collect()
        };
        let back = back(&east[i][j + 1], corners[i + 1][j + 1])
            .into_iter()
            .chain(back(&north[i][j], corners[i][j + 1]));
        vec![there.chain(back).collect()]
    };
    let all = (0..side).flat_map(|i| (0..side).map(move |j| (i, j))).map(|(i, j)| parcel(i, j)).collect();
    Job::union_of_all(all, Parts::Coverage)
}

/// From a towards b, without b: on an inner side over up to two vertices off the straight line.
fn between(random: &mut Random, a: [f64; 2], b: [f64; 2], is_inner: bool) -> Ring {
    let (more, step) = if is_inner {
        (random.within(0.0, 3.0).floor(), [b[0] - a[0], b[1] - a[1]])
    } else {
        (0.0, [0.0; 2])
    };
    let mut ring = vec![a];
    let mut k = 1.0;
    while k <= more {
        let (along, across) = (k / (more + 1.0), random.within(-0.05, 0.05));
        ring.push([a[0] + along * step[0] - across * step[1], a[1] + along * step[1] + across * step[0]]);
        k += 1.0;
    }
    ring
}

fn buildings(n: usize, mut building: impl FnMut(&mut Random) -> [f64; 3]) -> Job {
    let mut random = Random::new(17);
    let all = (0..n).map(|_| {
        let [west, east, height] = building(&mut random);
        vec![vec![[west, 0.0], [east, 0.0], [east, height], [west, height]]]
    });
    Job::union_of_all(all.collect(), Parts::Overlapping)
}

/// n buildings 1 to 101 wide along a street of 1 000, sizes in hundredths.
pub(super) fn skyline(n: usize) -> Job {
    let hundredths = |c: f64| (c * 100.0).round() / 100.0;
    buildings(n, |random| {
        let west = hundredths(random.within(0.0, 1000.0));
        let width = hundredths(random.within(1.0, 101.0));
        [west, west + width, hundredths(random.within(0.01, 50.0))]
    })
}

/// n rectangles between two random places on a base line.
pub(super) fn baseline(n: usize) -> Job {
    buildings(n, |random| {
        let (a, b) = (random.within(0.0, 1.0), random.within(0.0, 1.0));
        [a.min(b), a.max(b), random.within(0.0, 1.0)]
    })
}
