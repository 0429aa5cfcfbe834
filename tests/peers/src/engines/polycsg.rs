//! polycsg, by the ways in which operands can be given.

use super::task::{Outcome, Sink, Task, operands, reading, task};
use crate::job::{Job, Op, Operand, Polygon, Ring};
use polycsg::{Csg, FillRule, PreparedRegion, Region, Scratch};

/// All polygons of an operand as one set of raw rings; reading them is part of the call.
pub(super) fn from_rings(job: &Job) -> Result<Box<dyn Task>, String> {
    let (op, mut scratch) = (job.op, Scratch::default());
    let boolean = move |a: &Vec<Ring>, b: &Vec<Ring>| Ok(raw(op, a, b)?.evaluate_with(&mut scratch));
    Ok(reading(operands(job, |operand| operand.concat()), boolean, measure))
}

/// As [`from_rings`], to the boundary.
pub(super) fn boundary(job: &Job) -> Result<Box<dyn Task>, String> {
    let (op, mut scratch) = (job.op, Scratch::default());
    let boolean = move |a: &Vec<Ring>, b: &Vec<Ring>| Ok(raw(op, a, b)?.boundary(&mut scratch).area());
    Ok(reading(operands(job, |operand| operand.concat()), boolean, |&area| Outcome::of(area, 0)))
}

/// Each polygon as an operand of raw rings.
pub(super) fn from_operands(job: &Job) -> Result<Box<dyn Task>, String> {
    let (op, mut scratch) = (job.op, Scratch::default());
    let boolean =
        move |a: &Operand, b: &Operand| Ok(join(op, united(a)?, || united(b))?.evaluate_with(&mut scratch));
    Ok(reading(operands(job, Operand::clone), boolean, measure))
}

/// Each polygon as a region that stands ready; building the expression is part of the call.
pub(super) fn from_regions(job: &Job) -> Result<Box<dyn Task>, String> {
    let (op, mut scratch) = (job.op, Scratch::default());
    let boolean = move |a: &Vec<Region>, b: &Vec<Region>| {
        Ok(join(op, Csg::union(a), || Ok(Csg::union(b)))?.evaluate_with(&mut scratch))
    };
    Ok(reading(regions(job)?, boolean, measure))
}

/// Each operand as a geo-types multipolygon; for unions.
#[cfg(feature = "geo")]
pub(super) fn from_geo(job: &Job) -> Result<Box<dyn Task>, String> {
    let mut scratch = Scratch::default();
    let union = move |all: &geo::MultiPolygon, _: &geo::MultiPolygon| {
        let union = Csg::try_from(all).map_err(|error| error.to_string())?;
        Ok(union.evaluate_with(&mut scratch))
    };
    Ok(reading(operands(job, super::geo::multi_polygon), union, measure))
}

/// So many regions are clipped in one call: the sink can stop after each of these.
const TOGETHER: usize = 256;

/// Many regions clipped by one, which is prepared in the call.
pub(super) fn clips(job: &Job) -> Result<Box<dyn Task>, String> {
    let [subjects, clips] = regions(job)?.map(|regions| regions.concat());
    let call = move |(), sink: Sink<'_, Region>| {
        let clip = PreparedRegion::from(clips[0].clone());
        let _ = subjects.chunks(TOGETHER).flat_map(|subjects| clip.clip_all(subjects)).all(sink);
        Ok(())
    };
    Ok(task((), call, measure))
}

fn raw(op: Op, subject: &[Ring], clip: &[Ring]) -> Result<Csg<'static>, String> {
    join(op, read(subject)?, || read(clip))
}

fn read(rings: &[Ring]) -> Result<Csg<'static>, String> {
    Csg::from_rings(rings, FillRule::NonZero).map_err(|error| error.to_string())
}

fn united(operand: &Operand) -> Result<Csg<'static>, String> {
    Ok(Csg::union(operand.iter().map(|polygon| read(polygon)).collect::<Result<Vec<_>, _>>()?))
}

fn join<'a>(op: Op, a: Csg<'a>, b: impl FnOnce() -> Result<Csg<'a>, String>) -> Result<Csg<'a>, String> {
    Ok(match op {
        Op::UnionOfAll => a,
        Op::Union => a | b()?,
        Op::Intersection => a & b()?,
        Op::Difference => a - b()?,
        Op::SymmetricDifference => a ^ b()?,
    })
}

fn regions(job: &Job) -> Result<[Vec<Vec<Region>>; 2], String> {
    let region =
        |polygon: &Polygon| Region::from_rings(polygon, FillRule::NonZero).map_err(|error| error.to_string());
    let all = |operand: &Operand| operand.iter().map(region).collect::<Result<Vec<_>, _>>();
    let [subjects, clips] = operands(job, all);
    Ok([subjects.into_iter().collect::<Result<_, _>>()?, clips.into_iter().collect::<Result<_, _>>()?])
}

fn measure(region: &Region) -> Outcome {
    Outcome { valid: Some(region.validate().is_ok()), ..Outcome::of(region.area(), region.rings().count()) }
}
