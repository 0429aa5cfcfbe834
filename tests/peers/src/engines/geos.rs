//! GEOS (OverlayNG). It takes valid multipolygons only: overlapping operands are united first, inside the call. A clip of
//! many polygons is prepared, inside the call too.

use super::task::{Outcome, Sink, Task, operands, reading, task};
use crate::job::{Job, Op, Operand, Parts, Polygon, Ring};
use geos::{CoordSeq, GResult, Geom, Geometry, PreparedGeometry};

pub(super) fn load(job: &Job) -> Result<Box<dyn Task>, String> {
    if job.has_common_clip() {
        return clips(job);
    }
    let (op, parts) = (job.op, job.parts);
    let boolean = move |subject: &Geometry, clip: &Geometry| told(overlay(op, subject, clip, parts));
    Ok(reading(geometries(job)?, boolean, measure))
}

/// What dissolves polygons that share their borders vertex by vertex.
pub(super) fn coverage(job: &Job) -> Result<Box<dyn Task>, String> {
    let union = |subject: &Geometry, _: &Geometry| told(subject.coverage_union());
    Ok(reading(geometries(job)?, union, measure))
}

/// The prepared way: copy what lies within, leave out what lies outside, cut the rest.
fn clips(job: &Job) -> Result<Box<dyn Task>, String> {
    let [subjects, clips] = geometries(job)?;
    let call = move |(), sink: Sink<'_, Geometry>| {
        let clip = &clips[0];
        let prepared = told(PreparedGeometry::new(clip))?;
        subjects.iter().try_for_each(|subject| told(clipped(subject, clip, &prepared)).map(&mut *sink))
    };
    Ok(task((), call, measure))
}

fn clipped(subject: &Geometry, clip: &Geometry, prepared: &PreparedGeometry<'_>) -> GResult<Geometry> {
    if prepared.contains(subject)? {
        Geom::clone(subject)
    } else if prepared.disjoint(subject)? {
        Geometry::create_empty_polygon()
    } else {
        subject.intersection(clip)
    }
}

fn overlay(op: Op, subject: &Geometry, clip: &Geometry, parts: Parts) -> GResult<Geometry> {
    if op == Op::UnionOfAll {
        return subject.unary_union();
    }
    let united;
    let clip = if parts == Parts::Overlapping {
        united = clip.unary_union()?;
        &united
    } else {
        clip
    };
    match op {
        Op::UnionOfAll | Op::Union => subject.union(clip),
        Op::Intersection => subject.intersection(clip),
        Op::Difference => subject.difference(clip),
        Op::SymmetricDifference => subject.sym_difference(clip),
    }
}

fn told<T>(result: GResult<T>) -> Result<T, String> {
    result.map_err(|error| error.to_string())
}

fn geometries(job: &Job) -> Result<[Vec<Geometry>; 2], String> {
    let [subjects, clips] = operands(job, geometry).map(|all| told(all.into_iter().collect()));
    Ok([subjects?, clips?])
}

fn geometry(operand: &Operand) -> GResult<Geometry> {
    match &operand[..] {
        [polygon] => self::polygon(polygon),
        polygons => Geometry::create_multipolygon(polygons.iter().map(polygon).collect::<GResult<Vec<_>>>()?),
    }
}

fn polygon(polygon: &Polygon) -> GResult<Geometry> {
    let mut rings = polygon.iter().map(linear_ring).collect::<GResult<Vec<_>>>()?.into_iter();
    match rings.next() {
        Some(outer) => Geometry::create_polygon(outer, rings.collect()),
        None => Geometry::create_empty_polygon(),
    }
}

fn linear_ring(ring: &Ring) -> GResult<Geometry> {
    let closed: Vec<[f64; 2]> = ring.iter().chain(ring.first()).copied().collect();
    Geometry::create_linear_ring(CoordSeq::new_from_vec(&closed)?)
}

fn measure(result: &Geometry) -> Outcome {
    let parts = result.get_num_geometries().unwrap_or(0);
    let holes = |i| result.get_geometry_n(i).and_then(|part| part.get_num_interior_rings()).unwrap_or(0);
    Outcome::of(result.area().unwrap_or(f64::NAN), (0..parts).map(|i| 1 + holes(i)).sum())
}
