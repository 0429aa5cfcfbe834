//! Many small pairs: outlines that overlap in part, and neighbours with a common border.

use super::outline;
use crate::job::{Job, Op, Operand, Parts, Ring};
use crate::random::Random;

/// 20 000 / n pairs of n vertices a side.
fn jobs(op: Op, n: usize, mut pair: impl FnMut(&mut Random) -> [Ring; 2]) -> Job {
    let mut random = Random::new(n as u64);
    let (mut subjects, mut clips): (Vec<Operand>, Vec<Operand>) = (vec![], vec![]);
    for _ in 0..(20_000 / n).max(1) {
        let [subject, clip] = pair(&mut random);
        subjects.push(vec![vec![subject]]);
        clips.push(vec![vec![clip]]);
    }
    Job { op, subjects, clips, parts: Parts::Apart }
}

/// Two outlines of n vertices, the second moved by up to 0.8 each way.
pub(super) fn outlines(op: Op, n: usize, noise: f64) -> Job {
    jobs(op, n, |random| {
        let subject = outline(random, n, noise);
        let by = [random.within(-0.8, 0.8), random.within(-0.8, 0.8)];
        let clip = outline(random, n, noise).iter().map(|p| [p[0] + by[0], p[1] + by[1]]).collect();
        [subject, clip]
    })
}

/// A smooth outline of n vertices and a square of side 0.8 to 1.8 that lies over a part of it.
pub(super) fn tiles(n: usize) -> Job {
    jobs(Op::Intersection, n, |random| {
        let (angle, distance) = (random.within(0.0, std::f64::consts::TAU), random.within(0.6, 1.1));
        let (x, y) = (distance * angle.cos(), distance * angle.sin());
        let half = random.within(0.4, 0.9);
        let tile =
            vec![[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]];
        [outline(random, n, 0.0), tile]
    })
}

/// Two polygons of n vertices that share n / 2 of them, each closed by a path of its own.
pub(super) fn neighbours(n: usize) -> Job {
    jobs(Op::Union, n, |random| {
        let mut path =
            |x: f64| -> Ring { (0..n / 2).map(|i| [x + random.within(-0.05, 0.05), i as f64]).collect() };
        let [left, border, right] = [-5.0, 0.0, 5.0].map(&mut path);
        let closed = |up: &Ring, down: &Ring| up.iter().chain(down.iter().rev()).copied().collect();
        [closed(&border, &left), closed(&right, &border)]
    })
}
