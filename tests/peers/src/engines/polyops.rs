//! polyops: Martinez, Rueda and Feito. Polygons that overlap are united pairwise first, inside the call.

use super::task::{Outcome, Task, consuming, doubled_area, operands};
use crate::job::{Job, Op, Parts, Polygon};
use polyops::{Geometry, MultiPolygon, difference, intersection, union, xor};

pub(super) fn load(job: &Job) -> Result<Box<dyn Task>, String> {
    let op = job.op;
    let boolean = move |subject, clip| {
        let subject = united(subject);
        let result = match op {
            Op::UnionOfAll => return Ok(subject),
            Op::Union => union(geometry(subject), geometry(united(clip))),
            Op::Intersection => intersection(geometry(subject), geometry(united(clip))),
            Op::Difference => difference(geometry(subject), geometry(united(clip))),
            Op::SymmetricDifference => xor(geometry(subject), geometry(united(clip))),
        };
        Ok(result.unwrap_or_default())
    };
    Ok(consuming(operands(job, |operand| parts(operand, job)), boolean, measure))
}

fn geometry(polygons: MultiPolygon) -> Geometry {
    Geometry::MultiPolygon(polygons)
}

/// The operand in parts that have to be united: one where the polygons are disjoint already.
fn parts(polygons: &[Polygon], job: &Job) -> Vec<MultiPolygon> {
    let closed: MultiPolygon =
        polygons.iter().map(|polygon| polygon.iter().map(|ring| closed(ring)).collect()).collect();
    if job.parts != Parts::Overlapping && job.op != Op::UnionOfAll {
        vec![closed]
    } else {
        closed.into_iter().map(|polygon| vec![polygon]).collect()
    }
}

fn closed(ring: &[[f64; 2]]) -> Vec<[f64; 2]> {
    ring.iter().chain(ring.first()).copied().collect()
}

/// The union of neighbours in the list, then of the unions, and so on.
fn united(mut parts: Vec<MultiPolygon>) -> MultiPolygon {
    while parts.len() > 1 {
        let mut rest = parts.into_iter();
        parts = Vec::with_capacity(rest.len().div_ceil(2));
        while let Some(a) = rest.next() {
            parts.push(match rest.next() {
                Some(b) => union(geometry(a), geometry(b)).unwrap_or_default(),
                None => a,
            });
        }
    }
    parts.pop().unwrap_or_default()
}

fn measure(polygons: &MultiPolygon) -> Outcome {
    let area = |polygon: &Polygon| -> f64 {
        let mut rings = polygon.iter().map(|ring| doubled_area(ring.iter().copied()).abs());
        rings.next().unwrap_or(0.0) - rings.sum::<f64>()
    };
    let doubled: f64 = polygons.iter().map(area).sum();
    Outcome::of(doubled / 2.0, polygons.iter().map(Vec::len).sum())
}
