//! GEOS (OverlayNG). It takes valid multipolygons only: overlapping operands are united first, inside the call.

use super::task::{Outcome, Task, task};
use crate::job::{Job, Op, Polygon, Ring};
use geos::{CoordSeq, GResult, Geom, Geometry};

pub(super) fn load(job: &Job) -> Result<Box<dyn Task>, String> {
    let (op, disjoint) = (job.op, job.disjoint);
    let operands = multi_polygon(&job.subject).and_then(|subject| Ok((subject, multi_polygon(&job.clip)?)));
    let (subject, clip) = operands.map_err(|error| error.to_string())?;
    let call = move |()| overlay(op, &subject, &clip, disjoint).map_err(|error| error.to_string());
    Ok(task((), call, measure))
}

fn overlay(op: Op, subject: &Geometry, clip: &Geometry, disjoint: bool) -> GResult<Geometry> {
    if op == Op::UnionOfAll {
        return subject.unary_union();
    }
    let united;
    let clip = if disjoint {
        clip
    } else {
        united = clip.unary_union()?;
        &united
    };
    match op {
        Op::UnionOfAll => subject.union(clip),
        Op::Intersection => subject.intersection(clip),
        Op::Difference => subject.difference(clip),
        Op::SymmetricDifference => subject.sym_difference(clip),
    }
}

fn multi_polygon(polygons: &[Polygon]) -> GResult<Geometry> {
    let polygon = |polygon: &Polygon| -> GResult<Geometry> {
        let mut rings = polygon.iter().map(linear_ring).collect::<GResult<Vec<_>>>()?.into_iter();
        match rings.next() {
            Some(outer) => Geometry::create_polygon(outer, rings.collect()),
            None => Geometry::create_empty_polygon(),
        }
    };
    Geometry::create_multipolygon(polygons.iter().map(polygon).collect::<GResult<Vec<_>>>()?)
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
