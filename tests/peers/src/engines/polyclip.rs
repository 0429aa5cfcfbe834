//! polyclip: integers, exact, snap rounding; its engine is reused from call to call.

use super::task::{Outcome, Task, operands, reading};
use super::{integer, integer_scale};
use crate::job::{Job, Op};
use polyclip::{Boolean, FillRule, Point, PolygonSet};

pub(super) fn load(job: &Job) -> Result<Box<dyn Task>, String> {
    let scale = integer_scale(job);
    let op = match job.op {
        Op::UnionOfAll | Op::Union => polyclip::Op::Union,
        Op::Intersection => polyclip::Op::Intersection,
        Op::Difference => polyclip::Op::Difference,
        Op::SymmetricDifference => polyclip::Op::Xor,
    };
    let mut boolean = Boolean::new();
    let boolean = move |subject: &Vec<polyclip::Ring>, clip: &Vec<polyclip::Ring>| {
        boolean.clear();
        boolean.add_subject(subject, FillRule::NonZero).add_clip(clip, FillRule::NonZero).set_op(op);
        boolean.execute().map_err(|error| error.to_string())
    };
    let measure = move |result: &PolygonSet| {
        let doubled: i128 = result.iter().map(|polygon| polygon.signed_area2()).sum();
        let rings = result.iter().map(|polygon| 1 + polygon.holes.len()).sum();
        Outcome::of(doubled as f64 / (2.0 * scale * scale), rings)
    };
    Ok(reading(operands(job, |operand| rings(operand, scale)), boolean, measure))
}

fn rings(polygons: &[crate::job::Polygon], scale: f64) -> Vec<polyclip::Ring> {
    let point = |p: &[f64; 2]| Point::new(integer(p[0], scale), integer(p[1], scale));
    polygons.iter().flatten().map(|ring| polyclip::Ring(ring.iter().map(point).collect())).collect()
}
