//! linesweeper: outlines with curves, of which the tables use straight ones.

use super::task::{Outcome, Task, doubled_area, operands, reading};
use crate::job::{Job, Op, Operand};
use kurbo::{BezPath, Point};
use linesweeper::topology::Contours;
use linesweeper::{BinaryOp, FillRule, binary_op};

pub(super) fn load(job: &Job) -> Result<Box<dyn Task>, String> {
    let op = match job.op {
        Op::UnionOfAll | Op::Union => BinaryOp::Union,
        Op::Intersection => BinaryOp::Intersection,
        Op::Difference => BinaryOp::Difference,
        Op::SymmetricDifference => BinaryOp::Xor,
    };
    let boolean = move |subject: &BezPath, clip: &BezPath| {
        binary_op(subject, clip, FillRule::NonZero, op).map_err(|error| error.to_string())
    };
    Ok(reading(operands(job, path), boolean, measure))
}

fn path(polygons: &Operand) -> BezPath {
    let mut path = BezPath::new();
    for ring in polygons.iter().flatten() {
        path.move_to((ring[0][0], ring[0][1]));
        ring[1..].iter().for_each(|p| path.line_to((p[0], p[1])));
        path.close_path();
    }
    path
}

fn measure(contours: &Contours) -> Outcome {
    let ends =
        |path: &BezPath| -> Vec<Point> { path.elements().iter().filter_map(|e| e.end_point()).collect() };
    let area = |path: &BezPath| {
        let points = ends(path);
        doubled_area(points.iter().chain(points.first()).map(|p| [p.x, p.y]))
    };
    let doubled: f64 = contours.contours().map(|contour| area(&contour.path)).sum();
    Outcome::of(doubled.abs() / 2.0, contours.contours().count())
}
