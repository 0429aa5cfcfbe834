//! A layer of small polygons, each clipped by the same large outline and kept by itself.

use super::{outline, polar};
use crate::job::{Job, Op, Operand, Parts, Ring};
use crate::random::Random;

/// The layer is a grid of that many cells a side.
const CELLS: usize = 100;

/// Polygons of 4 to 8 vertices, half to nine tenths of a cell wide, one in each cell of a grid over the box of the clip.
fn small(clip: &Ring) -> Vec<Operand> {
    let mut random = Random::new(5);
    let [(west, east), (south, north)] = [0, 1].map(|axis| {
        clip.iter().fold((f64::MAX, f64::MIN), |(low, high), p| (p[axis].min(low), p[axis].max(high)))
    });
    let (width, height) = ((east - west) / CELLS as f64, (north - south) / CELLS as f64);
    let polygon = |cell: usize| -> Operand {
        let centre = [(cell / CELLS) as f64 + 0.5, (cell % CELLS) as f64 + 0.5];
        let around = polar(4 + cell % 5, centre, |_, _| random.within(0.25, 0.45));
        vec![vec![around.iter().map(|p| [west + width * p[0], south + height * p[1]]).collect()]]
    };
    (0..CELLS * CELLS).map(polygon).collect()
}

fn clips(clip: Ring) -> Job {
    Job { op: Op::Intersection, subjects: small(&clip), clips: vec![vec![vec![clip]]], parts: Parts::Apart }
}

/// The clip is a smooth outline of n vertices, the same curve for every n.
pub(super) fn smooth(n: usize) -> Job {
    clips(outline(&mut Random::new(3), n, 0.0))
}

/// The clip has n vertices at radius 1 and 0.7 by turns.
pub(super) fn spiky(n: usize) -> Job {
    clips(polar(n, [0.0, 0.0], |i, _| if i % 2 == 0 { 1.0 } else { 0.7 }))
}
