//! The sky, past all that hides it.
use crate::scene::Scene;
use crate::scene::sky::{Sky, SkyKind};
use formfactor::{DifferentialArea, Enclosure, PlanarPolygon};
use glam::DVec3;
use std::f64::consts::PI;

/// The ceiling is so many sizes of the scene wide for each that it is high: what it leaves open above the horizon.
const WIDE: f64 = 16_777_216.0;

/// The sky as a level ceiling above the scene that reaches to the horizon: what of it is seen past the scene's polygons is what of the sky is.
#[derive(Debug)]
pub(super) struct Dome<'s> {
    pub(super) sky: &'s Sky,
    up: DVec3,
    /// The scene's polygons, and the ceiling.
    enclosure: Enclosure,
    ceiling: usize,
}

impl<'s> Dome<'s> {
    /// The sky over a scene whose patches hide as these polygons do.
    pub(super) fn over(scene: &Scene, sky: &'s Sky, polygons: &[PlanarPolygon]) -> Dome<'s> {
        let up = scene.asset.up.try_normalize().unwrap_or(DVec3::Y);
        let ceiling = polygons.len();
        let polygons = [polygons, &[ceiling_over(scene, up)]].concat();
        Dome { sky, up, enclosure: Enclosure::new(polygons), ceiling }
    }

    /// The irradiance of a point where the zenith has a radiance of 1.
    pub(super) fn share(&self, point: &DifferentialArea) -> f64 {
        match self.sky.kind {
            SkyKind::Uniform => PI * self.enclosure.form_factor(point, self.ceiling).value,
            SkyKind::Overcast => {
                let ceiling = &self.enclosure.polygons()[self.ceiling];
                let seen = self.enclosure.visible_part(point, self.ceiling, ceiling);
                let [even, rising] = self.moments(point, seen.rings());
                ((even + 2.0 * rising) / 3.0).max(0.0)
            }
        }
    }

    /// The integrals of n·ω and of (n·ω)(z·ω) over the directions ω within rings of the ceiling, z up.
    ///
    /// Lambert's sum ½ Σ β n·c over the edges, each of angle β in a plane of unit normal c; and, as the divergence on the sphere of
    /// (z·ω) ∇(n·ω) is n·z − 3 (n·ω)(z·ω), a third of n·z Ω + Σ (n·c) z·(v + w) tan β/2 for edges from v to w (cf. Arvo 1995).
    fn moments(&self, point: &DifferentialArea, rings: impl Iterator<Item = Vec<DVec3>>) -> [f64; 2] {
        let (normal, up) = (point.normal(), self.up);
        let [mut even, mut rising, mut solid] = [0.0; 3];
        for ring in rings {
            // Rings run counter-clockwise as seen from below.
            let ways: Vec<DVec3> = ring.iter().rev().map(|p| (*p - point.position()).normalize()).collect();
            for (v, w) in ways.iter().zip(ways.iter().cycle().skip(1)) {
                let cross = v.cross(*w);
                let (sine, cosine) = (cross.length(), v.dot(*w));
                if sine == 0.0 {
                    continue;
                }
                let tilt = normal.dot(cross) / sine;
                even += sine.atan2(cosine) * tilt / 2.0;
                rising += tilt * up.dot(*v + *w) * sine / (1.0 + cosine);
                solid += 2.0 * up.dot(cross).atan2(1.0 + cosine + up.dot(*v + *w));
            }
        }
        [even, (normal.dot(up) * solid + rising) / 3.0]
    }
}

/// A square of the plane above all patches; its front is below.
fn ceiling_over(scene: &Scene, up: DVec3) -> PlanarPolygon {
    let [low, high] = scene.extent();
    let (middle, size) = (low.midpoint(high), (high - low).length());
    let (u, v) = up.any_orthonormal_pair();
    let corner = |[a, b]: [f64; 2]| middle + size * (up + WIDE * (a * u + b * v));
    // u, v and up are right-handed: seen from below these run counter-clockwise.
    let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]].map(corner);
    PlanarPolygon::new([corners]).expect("a square")
}
