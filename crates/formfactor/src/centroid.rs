//! Where the light that a point receives from a target comes from: the first moments of the form factor's kernel.
//!
//! In polar coordinates r, phi about the foot of the perpendicular from dA to the target's plane, h below it, the kernel is
//! h (a + r w) / (pi (h^2 + r^2)^2), with a the height of the foot over the horizon and w(phi) the cosine between dA's normal and the
//! direction e(phi) in the plane. Integrated over r to the boundary at R = z h it leaves
//!
//! ```text
//! integral of y K dA = (1 / pi) sum over edges of the integral of e (a J2(z) + h w J3(z)) dphi,
//! J2 = (atan z - z / (1 + z^2)) / 2,   J3 = (ln(1 + z^2) - z^2 / (1 + z^2)) / 2,
//! ```
//!
//! which Gauss's rule finds to four digits and more.
use crate::buffers::Buffers;
use crate::form_factor::FormFactor;
use crate::numeric::gauss::{RULE_2, RULE_4};
use crate::occluders::each;
use crate::pipeline::past;
use crate::quick;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use crate::visible_part::visible_part;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Rules of four and of two nodes find an edge's integral over its line to about 1e-5 where what is not analytic is so many times half the edge
/// away: they err by (d + (d^2 + 1)^(1/2))^(-2n) (Trefethen 2008, theorem 4.5).
const CLEAR: [f64; 2] = [2.0, 8.0];

/// The form factor, and the mean of the target's visible points, each weighed by what it contributes; of a target that is not seen
/// some point.
pub(crate) fn with_centroid(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: &[&PlanarPolygon],
    buffers: &mut Buffers,
) -> (FormFactor, DVec3) {
    let plane = PolarPlane::seen_from(from, to);
    let others = || occluders.iter().copied().enumerate();
    let (factor, moment) = match quick::parts(from, to, |_, taker| each(others(), taker), &mut buffers.quick)
    {
        Some(factor) => (factor, buffers.quick.recorded().iter().map(|edge| plane.moment(*edge)).sum()),
        None => (
            past(from, to, |_, taker| each(others(), taker), None, buffers),
            plane.moment_of_part(from, to, occluders),
        ),
    };
    let centroid = if factor.value > 0.0 { moment / factor.value } else { DVec2::ZERO };
    (factor, plane.place(from, centroid))
}

/// A target's plane relative to dA.
struct PolarPlane {
    /// dA's height over it.
    height: f64,
    /// The foot of the perpendicular, relative to dA.
    foot: DVec3,
    /// Directions in the plane, counter-clockwise seen from its front.
    axes: [DVec3; 2],
    /// dA's normal, along the plane, and the height of the foot over the horizon.
    tilt: DVec2,
    rise: f64,
}

impl PolarPlane {
    fn seen_from(from: &DifferentialArea, to: &PlanarPolygon) -> Self {
        let normal = to.normal();
        let height = normal.dot(from.position() - to.points()[0]);
        let foot = -normal * height;
        let x = normal.any_orthonormal_vector();
        let axes = [x, normal.cross(x)];
        let tilt = DVec2::from(axes.map(|axis| axis.dot(from.normal())));
        Self { height, foot, axes, tilt, rise: from.normal().dot(foot) }
    }

    /// Where a line from dA meets the plane.
    fn project(&self, toward: DVec3) -> DVec2 {
        let reach = self.height * self.height / self.foot.dot(toward);
        DVec2::from(self.axes.map(|axis| axis.dot(toward))) * reach
    }

    fn place(&self, from: &DifferentialArea, point: DVec2) -> DVec3 {
        from.position() + self.foot + self.axes[0] * point.x + self.axes[1] * point.y
    }

    /// The moment over the triangle between the foot and an edge, negative for one that runs clockwise.
    fn moment(&self, edge: [DVec3; 2]) -> DVec2 {
        let [start, end] = edge.map(|end| self.project(end));
        let along = (end - start).normalize_or_zero();
        let away = -along.perp();
        let distance = start.dot(away);
        let size = start.abs().max(end.abs()).max_element();
        if !size.is_finite() || distance.abs() <= 1e-9 * size {
            return DVec2::ZERO;
        }
        let (away, across) = (away * distance.signum(), distance.abs());
        let ends = [start, end].map(|end| end.dot(along));
        // As a function of the place on the edge's line the integrand is analytic but where r^2 = -h^2.
        let half = (ends[1] - ends[0]).abs() / 2.0;
        let beyond = (f64::midpoint(ends[0], ends[1]).abs() - half).max(0.0);
        let clear = across.hypot(self.height).hypot(beyond) / half;
        let sum = if clear >= CLEAR[1] {
            self.over_line([away, along], across, ends, &RULE_2)
        } else if clear >= CLEAR[0] {
            self.over_line([away, along], across, ends, &RULE_4)
        } else {
            self.over_angle([away, along], across, ends)
        };
        sum * distance.signum() / PI
    }

    /// The integral over the angle, by its place on the edge: ds = (r^2 / across) dphi.
    fn over_line(
        &self,
        [away, along]: [DVec2; 2],
        across: f64,
        [low, high]: [f64; 2],
        rule: &[[f64; 2]],
    ) -> DVec2 {
        let step = high - low;
        let at = |[node, weight]: &[f64; 2]| {
            let place = low + step * node;
            let radius = across.hypot(place);
            let toward = (away * across + along * place) / radius;
            toward * (weight * step * across / (radius * radius) * self.within(radius, self.tilt.dot(toward)))
        };
        rule.iter().map(at).sum()
    }

    /// The same by equal angles.
    fn over_angle(&self, [away, along]: [DVec2; 2], across: f64, ends: [f64; 2]) -> DVec2 {
        let [low, high] = ends.map(|end| end.atan2(across));
        let halves = ((high - low).abs() / (PI / 4.0)).ceil().clamp(1.0, 4.0);
        let step = (high - low) / halves;
        let mut sum = DVec2::ZERO;
        let mut first = low;
        while (first - high).abs() > 0.5 * step.abs() {
            for [node, weight] in RULE_4 {
                let (sine, cosine) = (first + step * node).sin_cos();
                let toward = away * cosine + along * sine;
                sum += toward * (weight * step * self.within(across / cosine, self.tilt.dot(toward)));
            }
            first += step;
        }
        sum
    }

    /// a J2 + h w J3.
    fn within(&self, radius: f64, lean: f64) -> f64 {
        let z = radius / self.height;
        let q = z * z;
        let [second, third] = if q < 1e-2 {
            [z * q * (2.0 / 3.0 - q * (0.8 - q * 6.0 / 7.0)), q * q * (0.5 - q * (2.0 / 3.0 - q * 0.75))]
        } else {
            [z.atan() - z / (1.0 + q), q.ln_1p() - q / (1.0 + q)]
        };
        (self.rise * second + self.height * lean * third) / 2.0
    }

    /// The moment over the visible part as polygon Booleans find it.
    fn moment_of_part(
        &self,
        from: &DifferentialArea,
        to: &PlanarPolygon,
        occluders: &[&PlanarPolygon],
    ) -> DVec2 {
        let all: Vec<PlanarPolygon> = occluders.iter().copied().cloned().collect();
        let of_ring = |ring: Vec<DVec3>| {
            let relative: Vec<DVec3> = ring.into_iter().map(|p| p - from.position()).collect();
            let next = relative.iter().cycle().skip(1);
            relative.iter().zip(next).map(|(a, b)| self.moment([*a, *b])).sum::<DVec2>()
        };
        visible_part(from, to, &all).rings().map(of_ring).sum()
    }
}
