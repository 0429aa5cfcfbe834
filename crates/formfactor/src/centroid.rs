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
//! which Gauss's rule finds to ten digits along every edge.
use crate::buffers::Buffers;
use crate::exact::pyramid::Pyramid;
use crate::form_factor::FormFactor;
use crate::numeric::gauss::{RULE_2, RULE_3, RULE_4, RULE_6};
use crate::occluders::{Reach, Taker};
use crate::pipeline::past;
use crate::quick;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use crate::visible_part::seen_past;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// Gauss's rules, and the longest stretches over which they find an integral to 1e-10 that is analytic but from pi / 2 aside on: where that is d
/// times half the stretch they err by (d + (d^2 + 1)^(1/2))^(-2n) (Trefethen 2008, theorem 4.5). The moments of a strip's edges cancel but for its
/// width: their errors may not be as large as what is left.
const RULES: [(f64, &[[f64; 2]]); 4] =
    [(0.02, &RULE_2), (0.13, &RULE_3), (0.35, &RULE_4), (LONGEST, &RULE_6)];
const LONGEST: f64 = 0.9;

/// The form factor, and the mean of the target's visible points, each weighed by what it contributes; of a target that is not seen
/// some point.
pub(crate) fn with_centroid<'a>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl Fn(&Reach, Taker<'_, 'a>),
    buffers: &mut Buffers,
) -> (FormFactor, DVec3) {
    let plane = PolarPlane::seen_from(from, to);
    let (factor, moment) = match quick::parts(from, to, &occluders, &mut buffers.quick) {
        Some(factor) => (factor, buffers.quick.recorded().iter().map(|edge| plane.moment(*edge)).sum()),
        None => (past(from, to, &occluders, None, buffers), plane.moment_of_part(from, to, occluders)),
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
        self.over_line([away, along], across, ends) * distance.signum() / PI
    }

    /// The integral over the angle, by the place on the edge's line: ds = (r^2 / across) dphi.
    ///
    /// It is analytic but where r^2 = -h^2, at s = i c and -i c, c^2 = across^2 + h^2: with s = c sinh t at pi / 2 aside of every real t.
    fn over_line(&self, [away, along]: [DVec2; 2], across: f64, ends: [f64; 2]) -> DVec2 {
        let clear = across.hypot(self.height);
        let [low, high] = ends.map(|end| (end / clear).asinh());
        let count = ((high - low).abs() / LONGEST).ceil().max(1.0);
        let step = (high - low) / count;
        let rule =
            RULES.iter().find(|(longest, _)| step.abs() <= *longest).map_or(&RULE_6[..], |(_, rule)| rule);
        let at = |stretch: f64| {
            let of_node = move |[node, weight]: &[f64; 2]| {
                let sinh = (low + step * (stretch + node)).sinh();
                let (place, speed) = (clear * sinh, clear * sinh.hypot(1.0));
                let radius = across.hypot(place);
                let toward = (away * across + along * place) / radius;
                let within = self.within(radius, self.tilt.dot(toward));
                toward * (weight * step * speed * across / (radius * radius) * within)
            };
            rule.iter().map(of_node).sum::<DVec2>()
        };
        (0_u32..).map(f64::from).take_while(|stretch| *stretch < count).map(at).sum()
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
    fn moment_of_part<'a>(
        &self,
        from: &DifferentialArea,
        to: &PlanarPolygon,
        occluders: impl Fn(&Reach, Taker<'_, 'a>),
    ) -> DVec2 {
        let within = |pyramid: &Pyramid| {
            let mut near = Vec::new();
            occluders(&Reach::Exact { pyramid, deviation: to.deviation() }, &mut |_, occluder| {
                near.push(occluder);
                ControlFlow::Continue(())
            });
            near
        };
        let of_ring = |ring: Vec<DVec3>| {
            let relative: Vec<DVec3> = ring.into_iter().map(|p| p - from.position()).collect();
            let next = relative.iter().cycle().skip(1);
            relative.iter().zip(next).map(|(a, b)| self.moment([*a, *b])).sum::<DVec2>()
        };
        seen_past(from, to, within).rings().map(of_ring).sum()
    }
}
