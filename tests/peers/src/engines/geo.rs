//! geo's `BooleanOps` and `unary_union` (single-threaded build).

use super::task::{Outcome, Task, doubled_area, operands, reading};
use crate::job::{Job, Op, Operand, Polygon, Ring};
use geo::algorithm::bool_ops::{BooleanOps, FillRule, OpType, unary_union};
use geo::{LineString, MultiPolygon};

pub(super) fn load(job: &Job) -> Result<Box<dyn Task>, String> {
    let op = match job.op {
        Op::UnionOfAll => None,
        Op::Union => Some(OpType::Union),
        Op::Intersection => Some(OpType::Intersection),
        Op::Difference => Some(OpType::Difference),
        Op::SymmetricDifference => Some(OpType::Xor),
    };
    let boolean = move |subject: &MultiPolygon, clip: &MultiPolygon| {
        Ok(match op {
            None => unary_union(subject),
            Some(op) => subject.boolean_op_with_fill_rule(clip, op, FillRule::NonZero),
        })
    };
    Ok(reading(operands(job, multi_polygon), boolean, measure))
}

pub(super) fn multi_polygon(polygons: &Operand) -> MultiPolygon {
    let line = |ring: &Ring| LineString::from(ring.iter().chain(ring.first()).copied().collect::<Vec<_>>());
    let polygon = |polygon: &Polygon| {
        let mut rings = polygon.iter().map(line);
        geo::Polygon::new(rings.next().unwrap_or(LineString::new(vec![])), rings.collect())
    };
    MultiPolygon::new(polygons.iter().map(polygon).collect())
}

fn measure(result: &MultiPolygon) -> Outcome {
    let rings =
        || result.iter().flat_map(|polygon| std::iter::once(polygon.exterior()).chain(polygon.interiors()));
    let area: f64 = rings().map(|ring| doubled_area(ring.0.iter().map(|c| [c.x, c.y]))).sum();
    Outcome::of(area.abs() / 2.0, rings().count())
}
