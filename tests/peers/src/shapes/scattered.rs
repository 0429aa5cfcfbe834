//! Small polygons strewn over a square.

use super::polar;
use crate::job::{Job, Op, Parts, Ring};
use crate::random::Random;

const SIDE: f64 = 10.0;

fn square() -> Ring {
    vec![[0.0, 0.0], [SIDE, 0.0], [SIDE, SIDE], [0.0, SIDE]]
}

/// A triangle that cuts one side of a square.
pub(super) fn square_and_triangle() -> Job {
    let triangle = vec![[3.1, 2.3], [12.7, 4.9], [4.4, 8.2]];
    Job::one(Op::Difference, vec![vec![square()]], vec![vec![triangle]], Parts::Apart)
}

/// A square and n turned rectangles, whose areas add to that of the square.
pub(super) fn square_and_rectangles(n: usize) -> Job {
    let mut random = Random::new(7);
    let clip = (0..n).map(|_| vec![rectangle(&mut random, SIDE / (n as f64).sqrt())]).collect();
    Job::one(Op::Difference, vec![vec![square()]], clip, Parts::Overlapping)
}

/// A turned rectangle of area size² and sides from size / 2 to 2 size.
fn rectangle(random: &mut Random, size: f64) -> Ring {
    let (sin, cos) = random.within(0.0, std::f64::consts::PI).sin_cos();
    let stretch = random.within(-1.0, 1.0).exp2();
    let (w, h) = (size * stretch / 2.0, size / stretch / 2.0);
    let centre = [random.within(0.0, SIDE), random.within(0.0, SIDE)];
    let corner = |[x, y]: [f64; 2]| [centre[0] + cos * x - sin * y, centre[1] + sin * x + cos * y];
    [[-w, -h], [w, -h], [w, h], [-w, h]].map(corner).to_vec()
}

/// n octagons, whose areas add to twice that of the square they lie in.
pub(super) fn octagons(n: usize) -> Job {
    let mut random = Random::new(11);
    let mean = (2.0 * SIDE * SIDE / (n as f64 * std::f64::consts::PI)).sqrt();
    let octagon = |_| {
        let centre = [random.within(0.0, SIDE), random.within(0.0, SIDE)];
        let (size, turn) = (mean * random.within(0.7, 1.3), random.within(0.0, 1.0));
        let (sin, cos) = turn.sin_cos();
        let corner = |p: [f64; 2]| [centre[0] + cos * p[0] - sin * p[1], centre[1] + sin * p[0] + cos * p[1]];
        vec![polar(8, [0.0, 0.0], |_, _| size).into_iter().map(corner).collect()]
    };
    Job::union_of_all((0..n).map(octagon).collect(), Parts::Overlapping)
}
