//! Lambert's sum in plain doubles, with a bound.
use super::cone::{Edge, coarse_error};
use super::interval::{Interval, greater};
use crate::form_factor::FormFactor;
use crate::numeric::{predicates::place, rounding::ROUNDING};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use glam::{DVec2, DVec3};
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
            sum.add_angle(&line, line.sine.atan2(start.dot(end)), 0.0);
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
    /// |along x start|, its inverse, and its relative error.
    sine: f64,
    inverse: f64,
    turned: f64,
    /// The cosine between dA's normal and that of the plane.
    pub(super) cosine: f64,
}

/// Angles between the ends of parts of an edge, added by multiplying (cosine, sine) as complex numbers: one arc tangent serves
/// many. The parts are disjoint, so that the sum is below a half turn; each product errs by less than 4 roundings of the sum.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts {
    product: DVec2,
    count: u8,
}

impl Default for Parts {
    fn default() -> Self {
        Self { product: DVec2::X, count: 0 }
    }
}

impl Parts {
    /// At most so many parts, so that the product does not underflow.
    const MOST: u8 = 8;

    fn is_full(&self) -> bool {
        self.count == Self::MOST || self.product.abs().max_element() < 1e-60
    }
}

impl Line {
    /// A bound on the angle by which the directions to two ends turn in all when their parameters err by so much.
    ///
    /// Per unit of the parameter the direction to an end turns by sine / |end|^2, which is below `stretch` everywhere
    /// and known to a few hundredths where the error itself turns it by no more than a hundredth.
    fn turns(&self, [start, end]: [DVec3; 2], [first, last]: [f64; 2], stretch: f64) -> f64 {
        if (first + last) * stretch < 0.01 {
            let (near, far) = (start.length_squared(), end.length_squared());
            1.05 * self.sine * (first * far + last * near) / (near * far)
        } else {
            (first + last) * stretch
        }
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
        Line { sine, inverse, turned: error * inverse, cosine: self.normal.dot(inward) * inverse }
    }

    /// A whole edge.
    pub(super) fn add_whole(&mut self, edge: &Edge, line: &Line) {
        self.add_angle(line, line.sine.atan2(edge.start.dot(edge.end)), 0.0);
    }

    /// Adds a part of an edge to those before it, and to the error what its ends leave open.
    #[inline]
    pub(super) fn add_part(&mut self, edge: &Edge, line: &Line, part: Interval, parts: &mut Parts) {
        let stretch = edge.spread * line.inverse;
        let ends = [part.low, part.high].map(|mark| edge.start + edge.along * mark.at);
        self.add_error(line.turns(ends, [part.low.error(), part.high.error()], stretch));
        if part.low.at < part.high.at {
            let turn = DVec2::new(ends[0].dot(ends[1]), (part.high.at - part.low.at) * line.sine);
            if parts.is_full() {
                self.add_parts(edge, line, std::mem::take(parts));
            }
            parts.product = (turn * edge.scale).rotate(parts.product);
            parts.count += 1;
        }
    }

    /// The angle that parts of an edge span together.
    pub(super) fn add_parts(&mut self, edge: &Edge, line: &Line, parts: Parts) {
        if parts.count > 0 {
            let stretch = edge.spread * line.inverse;
            let cut = (6.0 * stretch * stretch + 4.0 * f64::from(Parts::MOST)) * ROUNDING;
            // Rounding may turn almost a half turn into a little more. Clamped it is nearer to the true angle.
            self.add_angle(line, parts.product.y.max(0.0).atan2(parts.product.x), cut);
        }
    }

    /// An angle spanned on a line. It and the cosine err by no more than 4.1/9 of `turned` each and some roundings; the
    /// angle of a part also by those of its ends, 6 of their terms by their lengths, which are no less than the distance of
    /// the line, `sine` / |along|: in all by the share `cut`.
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
