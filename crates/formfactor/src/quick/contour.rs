//! Lambert's sum in plain doubles, with a bound.
use super::cone::{Edge, coarse_error};
use super::interval::{Interval, greater, lesser};
use crate::form_factor::FormFactor;
use crate::numeric::{angle::angle, predicates::place, rounding::ROUNDING};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use glam::DVec3;
use std::{cmp::Ordering, f64::consts::TAU};

/// Roundings of a term besides those of its edge's normal: the dot products, the root, the quotients, the arc tangent, the
/// unit normal.
const ROUNDINGS: f64 = 32.0;

/// The relative error up to which the sum is good enough.
const FINE: f64 = 1e-13;

/// The form factor of a convex target with nothing in between; `None` where doubles do not decide that all of it is seen,
/// and where the bound would be too large.
pub(crate) fn unoccluded(from: &DifferentialArea, to: &PlanarPolygon) -> Option<FormFactor> {
    let origin = from.position();
    if !to.is_convex() || to.deviation() > 0.0 || to.plane().quick_side(origin) != Some(Ordering::Greater) {
        return None;
    }
    let mut sum = Sum::new(from.normal());
    let mut before = *to.points().last()?;
    let mut start = before - origin;
    for &point in to.points() {
        if place(from.given_normal(), origin, point) == Ordering::Less {
            return None;
        }
        let (end, along) = (point - origin, point - before);
        if point != before {
            let line = sum.line(along.cross(start), coarse_error(along, start));
            sum.add_angle(&line, angle(line.sine, start.dot(end)), 0.0);
        }
        (before, start) = (point, end);
    }
    sum.fine(0.0)
}

/// Lambert's sum over edges and parts of edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sum {
    normal: DVec3,
    value: f64,
    error: f64,
    /// The largest error of one part or of one angle.
    worst: f64,
    /// Sum of the magnitudes of the terms, and their number.
    terms: f64,
    count: f64,
}

/// What the parts of an edge have in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    /// |along x start|, and its relative error.
    sine: f64,
    turned: f64,
    /// The cosine between dA's normal and that of the plane.
    pub(super) cosine: f64,
}

/// The angle that parts of an edge span together, and what bounds its error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts {
    angle: f64,
    count: f64,
    /// No direction to the edge turns faster along it, per unit of the parameter.
    speed: f64,
    /// The squares of the lengths that are added to a point of the edge, in sum, by the least square of a point's.
    spread: f64,
}

impl Parts {
    /// The direction to a point turns by sine / |point|^2.
    ///
    /// Over the base of an isosceles triangle no point is nearer than |mid|^2 = |side|^2 - |base|^2 / 4, and no point of an edge is
    /// nearer than if both ends were as near as the nearer one. Of a long edge, the distance of the line bounds it.
    pub(super) fn of(edge: &Edge, line: &Line) -> Self {
        let [start, end, along] = [edge.start, edge.end, edge.along].map(DVec3::length_squared);
        let ends = lesser(start, end);
        let nearest = if ends > 0.5 * along { ends - 0.25 * along } else { line.sine * line.sine / along };
        let inverse = 1.01 / nearest;
        Self { angle: 0.0, count: 0.0, speed: line.sine * inverse, spread: (start + along) * inverse }
    }
}

impl Sum {
    pub(super) fn new(normal: DVec3) -> Self {
        Self { normal, value: 0.0, error: 0.0, worst: 0.0, terms: 0.0, count: 0.0 }
    }

    /// What the parts of an edge in a plane with this normal have in common, the sum of whose components' errors is
    /// within `error`.
    pub(super) fn line(&self, inward: DVec3, error: f64) -> Line {
        let sine = inward.length();
        let inverse = 1.0 / sine;
        Line { sine, turned: error * inverse, cosine: self.normal.dot(inward) * inverse }
    }

    /// A whole edge.
    pub(super) fn add_whole(&mut self, edge: &Edge, line: &Line) {
        self.add_angle(line, angle(line.sine, edge.start.dot(edge.end)), 0.0);
    }

    /// Adds a part of an edge to those before it, and to the error what its ends leave open.
    #[inline]
    pub(super) fn add_part(&mut self, edge: &Edge, line: &Line, part: Interval, parts: &mut Parts) {
        self.add_error((part.low.error + part.high.error) * parts.speed);
        if part.low.at < part.high.at {
            let [start, end] = [part.low, part.high].map(|mark| edge.start + edge.along * mark.at);
            parts.angle += angle((part.high.at - part.low.at) * line.sine, start.dot(end));
            parts.count += 1.0;
        }
    }

    /// The angle that parts of an edge span together.
    ///
    /// A component of an end errs by 2 roundings of its terms, the dot product of two ends by 7 of the square of their sum, at most
    /// twice the sum of their squares.
    pub(super) fn add_parts(&mut self, line: &Line, parts: &Parts) {
        self.add_angle(line, parts.angle, (14.0 * parts.spread + parts.count) * ROUNDING);
    }

    /// An angle spanned on a line. It and the cosine err by no more than 4.1/9 of `turned` each and some roundings, and the
    /// angle of parts also by the share `cut`.
    fn add_angle(&mut self, line: &Line, angle: f64, cut: f64) {
        let term = angle * line.cosine;
        self.value += term;
        self.terms += term.abs();
        self.add_error(angle * (line.turned + ROUNDINGS * ROUNDING + cut));
        self.count += 1.0;
    }

    fn add_error(&mut self, error: f64) {
        self.error += error;
        self.worst = greater(self.worst, error);
    }

    /// The largest error of one part or of one angle.
    pub(super) fn worst(&self) -> f64 {
        self.worst
    }

    /// [`Self::form_factor`] of a target that nothing hides, if its value is known to 13 digits.
    pub(super) fn fine(&self, error: f64) -> Option<FormFactor> {
        self.form_factor(error).filter(|factor| factor.error_bound <= FINE * factor.value)
    }

    /// The form factor, with an error of at most `error` from elsewhere; `None` when nothing is known.
    pub(super) fn form_factor(&self, error: f64) -> Option<FormFactor> {
        let value = (self.value / TAU).clamp(0.0, 1.0);
        let error_bound = (self.error + self.count * ROUNDING * self.terms) / TAU + error;
        // NaN, from an edge through dA, is not small.
        (error_bound < 1.0).then_some(FormFactor { value, error_bound })
    }
}
