//! clipper2-rust, a port of Clipper2 to Rust.

use super::task::{Outcome, Task, operands, reading};
use super::{integer, integer_scale};
use crate::job::{Job, Op, Polygon};
use clipper2_rust::{ClipType, FillRule, Paths64, Point64, area, boolean_op_64};

pub(super) fn load(job: &Job) -> Result<Box<dyn Task>, String> {
    let scale = integer_scale(job);
    let op = match job.op {
        Op::UnionOfAll | Op::Union => ClipType::Union,
        Op::Intersection => ClipType::Intersection,
        Op::Difference => ClipType::Difference,
        Op::SymmetricDifference => ClipType::Xor,
    };
    let boolean =
        move |subject: &Paths64, clip: &Paths64| Ok(boolean_op_64(op, FillRule::NonZero, subject, clip));
    let measure = move |paths: &Paths64| {
        let doubled: f64 = paths.iter().map(area).sum();
        Outcome::of(doubled / (scale * scale), paths.len())
    };
    Ok(reading(operands(job, |operand| paths(operand, scale)), boolean, measure))
}

fn paths(polygons: &[Polygon], scale: f64) -> Paths64 {
    let point = |p: &[f64; 2]| Point64::new(integer(p[0], scale), integer(p[1], scale));
    polygons.iter().flatten().map(|ring| ring.iter().map(point).collect()).collect()
}
