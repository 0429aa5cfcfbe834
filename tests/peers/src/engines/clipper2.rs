//! Clipper2, the C++ original, through its safe wrapper.

use super::integer_scale;
use super::task::{Outcome, Task, consuming, operands};
use crate::job::{Job, Op, Polygon};
use clipper2::{Clipper, FillRule, One, Paths, Point};

pub(super) fn load(job: &Job) -> Result<Box<dyn Task>, String> {
    let (op, scale) = (job.op, integer_scale(job));
    let boolean = move |subject, clip| {
        let clipper = Clipper::<_, One>::new().add_subject(subject).add_clip(clip);
        let rule = FillRule::NonZero;
        let result = match op {
            Op::UnionOfAll | Op::Union => clipper.union(rule),
            Op::Intersection => clipper.intersect(rule),
            Op::Difference => clipper.difference(rule),
            Op::SymmetricDifference => clipper.xor(rule),
        };
        result.map_err(|error| error.to_string())
    };
    let measure = move |paths: &Paths<One>| Outcome::of(paths.signed_area() / (scale * scale), paths.len());
    Ok(consuming(operands(job, |operand| paths(operand, scale)), boolean, measure))
}

fn paths(polygons: &[Polygon], scale: f64) -> Paths<One> {
    let point = |p: &[f64; 2]| Point::<One>::new((p[0] * scale).round(), (p[1] * scale).round());
    let rings = polygons.iter().flatten();
    Paths::new(rings.map(|ring| ring.iter().map(point).collect::<Vec<_>>().into()).collect())
}
