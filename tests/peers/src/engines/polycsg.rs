//! polycsg, from raw rings and from regions, to a region and to the boundary alone.

use super::task::{Outcome, Task, task};
use crate::job::{Job, Op, Polygon, Ring};
use polycsg::{Csg, Error, FillRule, Region, Scratch};

fn rings(polygons: &[Polygon]) -> Vec<Ring> {
    polygons.concat()
}

/// Reading the rings is part of the call.
pub(super) fn from_rings(job: &Job) -> Result<Box<dyn Task>, String> {
    let (op, subject, clip) = (job.op, rings(&job.subject), rings(&job.clip));
    let mut scratch = Scratch::default();
    let call = move |()| Ok(raw(op, &subject, &clip)?.evaluate_with(&mut scratch));
    Ok(task((), call, measure))
}

/// As [`from_rings`], to the boundary.
pub(super) fn boundary(job: &Job) -> Result<Box<dyn Task>, String> {
    let (op, subject, clip) = (job.op, rings(&job.subject), rings(&job.clip));
    let mut scratch = Scratch::default();
    let call = move |()| Ok(raw(op, &subject, &clip)?.boundary(&mut scratch).area());
    Ok(task((), call, |&area| Outcome::of(area, 0)))
}

/// Regions stand ready; building the expression is part of the call.
pub(super) fn from_regions(job: &Job) -> Result<Box<dyn Task>, String> {
    let (op, subject, clip) = (job.op, regions(&job.subject)?, regions(&job.clip)?);
    let mut scratch = Scratch::default();
    let call = move |()| Ok(expression(op, &subject, &clip).evaluate_with(&mut scratch));
    Ok(task((), call, measure))
}

/// As [`from_regions`], to the boundary.
pub(super) fn boundary_of_regions(job: &Job) -> Result<Box<dyn Task>, String> {
    let (op, subject, clip) = (job.op, regions(&job.subject)?, regions(&job.clip)?);
    let mut scratch = Scratch::default();
    let call = move |()| Ok(expression(op, &subject, &clip).boundary(&mut scratch).area());
    Ok(task((), call, |&area| Outcome::of(area, 0)))
}

fn raw(op: Op, subject: &[Ring], clip: &[Ring]) -> Result<Csg<'static>, String> {
    let read = |rings: &[Ring]| Csg::from_rings(rings, FillRule::NonZero);
    let joined = |join: fn(Csg<'static>, Csg<'static>) -> Csg<'static>| Ok(join(read(subject)?, read(clip)?));
    let csg: Result<Csg<'static>, Error> = match op {
        Op::UnionOfAll => read(subject),
        Op::Intersection => joined(|a, b| a & b),
        Op::Difference => joined(|a, b| a - b),
        Op::SymmetricDifference => joined(|a, b| a ^ b),
    };
    csg.map_err(|error| error.to_string())
}

fn regions(polygons: &[Polygon]) -> Result<Vec<Region>, String> {
    let region = |polygon| Region::from_rings(polygon, FillRule::NonZero).map_err(|error| error.to_string());
    polygons.iter().map(region).collect()
}

fn expression<'a>(op: Op, subject: &'a [Region], clip: &'a [Region]) -> Csg<'a> {
    match op {
        Op::UnionOfAll => Csg::union(subject),
        Op::Intersection => Csg::union(subject) & Csg::union(clip),
        Op::Difference => Csg::union(subject) - Csg::union(clip),
        Op::SymmetricDifference => Csg::union(subject) ^ Csg::union(clip),
    }
}

fn measure(region: &Region) -> Outcome {
    Outcome { valid: Some(region.validate().is_ok()), ..Outcome::of(region.area(), region.rings().count()) }
}
