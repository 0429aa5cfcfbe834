//! Where the light that a point receives from a target comes from: the first moments of the form factor's kernel.
//!
//! In polar coordinates r, phi about the foot of the perpendicular from dA to the target's plane, h below it, the kernel is
//! h (a + r w) / (pi (h^2 + r^2)^2), with a the height of the foot over the horizon and w(phi) the cosine between dA's normal and the
//! direction e(phi) in the plane. Integrated over r to the boundary it leaves a line integral along every edge.
use crate::buffers::Buffers;
use crate::edge_moment::EdgeLine;
use crate::exact::pyramid::Pyramid;
use crate::far_centroid::far_centroid;
use crate::form_factor::FormFactor;
use crate::occluders::{Reach, Taker};
use crate::pipeline::past;
use crate::quick;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use crate::visible_part::seen_past;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// Ends of edges that are nearer to each other than this share of how far away they are, are one corner.
const NEAR: f64 = 1e-12;

/// The form factor, and the mean of the target's visible points, each weighed by what it contributes; of a target that is not seen
/// some point.
pub(crate) fn with_centroid<'a>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl Fn(&Reach, Taker<'_, 'a>),
    buffers: &mut Buffers,
) -> (FormFactor, DVec3) {
    let plane = PolarPlane::seen_from(from, to);
    let mean = |factor: &FormFactor, moment: DVec2| {
        if factor.value > 0.0 { moment / factor.value } else { DVec2::ZERO }
    };
    let (factor, centroid) = match quick::parts(from, to, &occluders, &mut buffers.quick) {
        Some(factor) => {
            let edges = buffers.quick.recorded();
            let centroid = plane.far_centroid(edges);
            (factor, centroid.unwrap_or_else(|| mean(&factor, plane.moment_within(edges))))
        }
        None => {
            let factor = past(from, to, &occluders, None, buffers);
            (factor, mean(&factor, plane.moment_of_part(from, to, occluders)))
        }
    };
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

    /// The centroid between the edges of one ring of three or four that is far for its size.
    fn far_centroid(&self, edges: &[[DVec3; 2]]) -> Option<DVec2> {
        let follows = |[edge, next]: [&[DVec3; 2]; 2]| edge[1].distance(next[0]) <= NEAR * next[0].length();
        let is_ring = |edges: &[[DVec3; 2]]| {
            edges.iter().zip(edges.iter().cycle().skip(1)).all(|(edge, next)| follows([edge, next]))
        };
        let corners = match edges {
            [a, b, c] if is_ring(edges) => [a, b, c, c],
            [a, b, c, d] if is_ring(edges) => [a, b, c, d],
            _ => return None,
        };
        let weight = |place: DVec2| {
            let square = self.height * self.height + place.length_squared();
            (self.rise + self.tilt.dot(place)) / (square * square)
        };
        far_centroid(self.height, corners.map(|edge| self.project(edge[0])), weight)
    }

    /// The moment over what edges bound.
    fn moment_within(&self, edges: &[[DVec3; 2]]) -> DVec2 {
        edges.iter().map(|edge| self.moment(*edge)).sum()
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
        let lean = [self.tilt.dot(away) * across, self.tilt.dot(along)];
        let line = EdgeLine::new([across, self.height], self.rise, lean);
        let [outward, forward] = line.integral([start, end].map(|end| end.dot(along)));
        (away * (across * outward) + along * forward) * distance / PI
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
