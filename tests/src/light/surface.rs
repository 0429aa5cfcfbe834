//! Planar surfaces, and where rays meet them.
use super::Bands;
use crate::random::Random;
use glam::{DVec2, DVec3};

/// A planar polygon that reflects diffusely and may emit.
#[derive(Clone, Debug)]
pub struct Surface {
    /// A name within the room.
    pub name: String,
    /// The outline and holes; a point is inside by the even-odd rule.
    pub loops: Vec<Vec<DVec3>>,
    /// The share of light that is reflected.
    pub reflectance: Bands,
    /// Emitted radiance, W/m²/sr.
    pub radiance: Bands,
}

/// A surface in a frame of its own.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    pub(super) normal: DVec3,
    origin: DVec3,
    axes: [DVec3; 2],
    edges: Vec<[DVec2; 2]>,
    low: DVec2,
    high: DVec2,
    pub(super) area: f64,
}

impl Plane {
    pub(super) fn of(surface: &Surface) -> Plane {
        let outline = &surface.loops[0];
        let origin = outline[0];
        let normal = (1..outline.len() - 1)
            .map(|i| (outline[i] - origin).cross(outline[i + 1] - origin))
            .sum::<DVec3>()
            .normalize();
        let x = (outline[1] - origin).normalize();
        let axes = [x, normal.cross(x)];
        let flat = |p: DVec3| DVec2::new((p - origin).dot(axes[0]), (p - origin).dot(axes[1]));
        let edges: Vec<[DVec2; 2]> = surface
            .loops
            .iter()
            .flat_map(|points| {
                (0..points.len()).map(|i| [points[i], points[(i + 1) % points.len()]].map(flat))
            })
            .collect();
        let corners = || edges.iter().map(|[a, _]| *a);
        let area = edges.iter().map(|[a, b]| a.perp_dot(*b)).sum::<f64>() / 2.0;
        let low = corners().fold(DVec2::INFINITY, DVec2::min);
        let high = corners().fold(DVec2::NEG_INFINITY, DVec2::max);
        Plane { normal, origin, axes, edges, low, high, area }
    }

    /// How far along a ray it is met, in lengths of its direction; nothing closer than `least` counts.
    pub(super) fn meets(&self, from: DVec3, direction: DVec3, least: f64) -> Option<f64> {
        let far = (self.origin - from).dot(self.normal) / direction.dot(self.normal);
        if !(far > least && far.is_finite()) {
            return None;
        }
        let arm = from + direction * far - self.origin;
        self.holds(DVec2::new(arm.dot(self.axes[0]), arm.dot(self.axes[1]))).then_some(far)
    }

    fn holds(&self, point: DVec2) -> bool {
        let is_crossed = |[a, b]: &[DVec2; 2]| {
            (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
        };
        self.low.cmple(point).all()
            && point.cmple(self.high).all()
            && self.edges.iter().filter(|edge| is_crossed(edge)).count() % 2 == 1
    }

    /// A point anywhere on it.
    pub(super) fn any_point(&self, random: &mut Random) -> DVec3 {
        loop {
            let point = self.low + (self.high - self.low) * DVec2::new(random.unit(), random.unit());
            if self.holds(point) {
                return self.origin + self.axes[0] * point.x + self.axes[1] * point.y;
            }
        }
    }

    /// A direction above it, by the cosine.
    pub(super) fn any_direction(&self, random: &mut Random) -> DVec3 {
        let (radius, angle) = (random.unit().sqrt(), random.angle());
        let [x, y] = [radius * angle.cos(), radius * angle.sin()];
        self.axes[0] * x + self.axes[1] * y + self.normal * (1.0 - radius * radius).max(0.0).sqrt()
    }
}
