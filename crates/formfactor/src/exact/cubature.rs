//! Unoccluded form factors by cubature, where the edges of the contour sum cancel: small, far and sliver targets.
//!
//! Over a triangle r = r0 + x (d1 + y (d2 - d1)), 0 <= x, y <= 1, with T = r0 . (d1 x d2),
//!
//! F = |T| / pi integral of (N . r) / |r|^4 x dx dy,
//!
//! where N . r is interpolated between the corners' heights over the horizon, which are not negative. Every term is
//! positive: nothing cancels, and the value is right to some roundings of itself.
//!
//! **The rule's error.** Along a line in x or in y let c be the middle and w half of the way. With R = |c| / 2 |w| the
//! integrand is analytic for |t| <= R, where |r|^2 >= |c|^2 / 4, so that it is at most 16 (1 + R)^2 / 2 times N . c / |c|^4,
//! while its integral over [-1, 1] is at least 0.54 times that. Gauss's rule with n nodes errs by at most
//! 64/15 rho^-2n / (1 - rho^-2) of the largest value in an ellipse with semi-axes that add to rho [Trefethen 2013, theorem
//! 19.3]; here rho >= 1.99 R. Relatively, that is below 64 (1 + R)^2 rho^-2n. Triangles are halved until they are no longer
//! than a tenth of their distance; then R >= 10, and 8 nodes err by 2e-17. At a hundredth R >= 100, and 5 nodes err by 7e-18.
use super::view::View;
use crate::form_factor::FormFactor;
use crate::numeric::gauss::{RULE_5, RULE_8};
use crate::numeric::offset::{Offset, accurate_dot, sizes};
use crate::numeric::rounding::ROUNDING;
use crate::shapes::differential_area::DifferentialArea;
use exactfloat::DoubleDouble;
use glam::DVec3;
use std::f64::consts::PI;

/// The quotients of length and distance up to which the rules of 8 and of 5 nodes are used.
const SMALL: f64 = 0.1;
const TINY: f64 = 0.01;

/// A bound on the error of the sum in roundings of itself: of its terms, of adding them, and of the rules.
const ROUNDINGS: f64 = 96.0;

/// The error of products of three double-doubles, relative to the sum of their terms' magnitudes: 2^-96.
const PRODUCT: f64 = 1.262_177_448_353_619e-29;

/// More triangles than this are not worth their cost.
const MOST: usize = 2000;

/// A part of the target.
#[derive(Clone, Copy, Debug)]
struct Triangle {
    /// Relative to dA.
    corners: [DVec3; 3],
    /// The corners' heights over the horizon, times the length of the normal as given.
    heights: [f64; 3],
    /// |T|, and a bound on its error.
    volume: [f64; 2],
}

/// The form factor of a convex target without a deviation; `None` when that takes too many triangles.
pub(crate) fn form_factor(view: &View) -> Option<FormFactor> {
    let [vertices] = &view.loops[..] else { return None };
    if !view.to.is_convex() || view.to.deviation() > 0.0 {
        return None;
    }
    let offsets: Vec<Offset> = vertices.iter().map(|v| v.offset).collect();
    let (first, rest) = offsets.split_first()?;
    let heights = Heights::over_horizon(view.from, &offsets);
    let mut open: Vec<Triangle> = (1..rest.len())
        .map(|i| triangle([*first, rest[i - 1], rest[i]], heights.of([0, i, i + 1])))
        .collect();
    let (mut sum, mut error, mut count) = (DoubleDouble::ZERO, 0.0, 0);
    while let Some(triangle) = open.pop() {
        count += 1;
        if count + open.len() > MOST {
            return None;
        }
        match triangle.integrals() {
            Some([part, mass]) => {
                let [volume, volume_error] = triangle.volume;
                sum = sum + DoubleDouble::from(volume * part);
                error += volume_error * part + (volume + volume_error) * mass * heights.error;
            }
            None => open.extend(triangle.halves()),
        }
    }
    let scale = 1.0 / (PI * accurate_dot(heights.normal, heights.normal).sqrt());
    let value = sum.round() * scale;
    let error_bound = (1.0 + 1e-9) * error * scale + ROUNDINGS * ROUNDING * value;
    (error_bound < 1.0).then_some(FormFactor { value, error_bound })
}

/// Heights over the horizon, none of them negative.
#[derive(Debug)]
struct Heights {
    normal: DVec3,
    values: Vec<f64>,
    /// A bound on the error of each, besides roundings of itself.
    error: f64,
}

impl Heights {
    fn over_horizon(from: &DifferentialArea, offsets: &[Offset]) -> Self {
        let normal = from.given_normal();
        let along = Offset(normal.to_array().map(DoubleDouble::from));
        let values = offsets.iter().map(|offset| along.dot(*offset).round().max(0.0)).collect();
        let terms = offsets.iter().map(|offset| sizes(normal).dot(offset.sizes()));
        Self { normal, values, error: PRODUCT * terms.fold(0.0, f64::max) }
    }

    fn of(&self, corners: [usize; 3]) -> [f64; 3] {
        corners.map(|i| self.values[i])
    }
}

fn triangle(corners: [Offset; 3], heights: [f64; 3]) -> Triangle {
    let [a, b, c] = corners;
    let (normal, terms) = a.to(b).cross(a.to(c));
    let volume = [normal.dot(a).round().abs(), PRODUCT * terms.dot(a.sizes())];
    Triangle { corners: corners.map(Offset::round), heights, volume }
}

impl Triangle {
    /// The integrals of (N . r) / |r|^4 x and of x / |r|^4; `None` when the triangle is too long for its distance.
    fn integrals(&self) -> Option<[f64; 2]> {
        let [a, b, c] = self.corners;
        let longest = (b - a).length().max((c - a).length()).max((c - b).length());
        let nearest = a.length().min(b.length()).min(c.length()) - longest;
        if longest <= TINY * nearest {
            Some(self.by_rule(&RULE_5))
        } else if longest <= SMALL * nearest {
            Some(self.by_rule(&RULE_8))
        } else {
            None
        }
    }

    fn by_rule(&self, rule: &[[f64; 2]]) -> [f64; 2] {
        let [a, b, c] = self.corners;
        let [p, q, r] = self.heights;
        let (mut part, mut mass) = (0.0, 0.0);
        for &[y, y_weight] in rule {
            // From the first corner to a point of the opposite edge.
            let (far, high) = (b + y * (c - b), (1.0 - y) * q + y * r);
            let (mut row, mut row_mass) = (0.0, 0.0);
            for &[x, x_weight] in rule {
                let square = (a + x * (far - a)).length_squared();
                let weight = x * x_weight / (square * square);
                row += weight * ((1.0 - x) * p + x * high);
                row_mass += weight;
            }
            part += y_weight * row;
            mass += y_weight * row_mass;
        }
        [part, mass]
    }

    /// Two halves, cut at the middle of the longest edge.
    fn halves(&self) -> [Self; 2] {
        let length = |i: usize| self.corners[i].distance_squared(self.corners[(i + 1) % 3]);
        let longest = (1..3).fold(0, |best, i| if length(i) > length(best) { i } else { best });
        let [i, j] = [longest, (longest + 1) % 3];
        let corner = self.corners[i].midpoint(self.corners[j]);
        let height = self.heights[i].midpoint(self.heights[j]);
        [i, j].map(|replaced| {
            let mut half = Self { volume: self.volume.map(|v| v / 2.0), ..*self };
            (half.corners[replaced], half.heights[replaced]) = (corner, height);
            half
        })
    }
}
