//! The sky, past all that hides it.
use crate::scene::Scene;
use crate::scene::sky::{Sky, SkyKind};
use formfactor::{DifferentialArea, Enclosure, PlanarPolygon};
use glam::DVec3;
use std::f64::consts::PI;

/// What a form factor to a side may be off by.
const ENOUGH: f64 = 1e-9;
/// A view of less is rounding: what a sealed room lets in would be solved for like any light.
const ROUNDING: f64 = 1e-12;

/// The sky as a level ceiling above the scene and four walls around it, which go down to the level of whoever looks: of the sky every point
/// sees what it sees of these past the scene's polygons.
#[derive(Debug)]
pub(super) struct Dome<'s> {
    pub(super) sky: &'s Sky,
    up: DVec3,
    /// The scene's polygons, the ceiling and the walls.
    enclosure: Enclosure,
    /// The number of the ceiling, after which the walls come.
    ceiling: usize,
    /// The middle of the scene, and how far from there ceiling and walls are.
    middle: DVec3,
    size: f64,
}

impl<'s> Dome<'s> {
    /// The sky over a scene whose patches hide as these polygons do.
    pub(super) fn over(scene: &Scene, sky: &'s Sky, polygons: &[PlanarPolygon]) -> Dome<'s> {
        let up = scene.asset.up.try_normalize().unwrap_or(DVec3::Y);
        let [low, high] = scene.extent();
        let (middle, size) = (low.midpoint(high), (high - low).length());
        let ceiling = polygons.len();
        let mut dome = Dome { sky, up, enclosure: Enclosure::default(), ceiling, middle, size };
        let sides = std::iter::once(dome.ceiling()).chain(dome.ways().map(|way| dome.wall(way, -size)));
        dome.enclosure = Enclosure::new(polygons.iter().cloned().chain(sides).collect());
        dome
    }

    /// Level directions from the middle to the walls.
    fn ways(&self) -> [DVec3; 4] {
        let (u, v) = self.up.any_orthonormal_pair();
        [u, v, -u, -v]
    }

    /// A square of the plane above all patches; its front is below.
    fn ceiling(&self) -> PlanarPolygon {
        let [u, v, ..] = self.ways();
        let corner = |[a, b]: [f64; 2]| self.middle + self.size * (self.up + a * u + b * v);
        // u, v and up are right-handed: seen from below these run counter-clockwise.
        let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]].map(corner);
        PlanarPolygon::new([corners]).expect("a square")
    }

    /// A wall from a height over the middle up to the ceiling; its front is inside.
    fn wall(&self, way: DVec3, height: f64) -> PlanarPolygon {
        let right = way.cross(self.up);
        let corner =
            |side: f64, height: f64| self.middle + self.size * (way + side * right) + height * self.up;
        let corners = [(-1.0, height), (1.0, height), (1.0, self.size), (-1.0, self.size)];
        PlanarPolygon::new([corners.map(|(side, height)| corner(side, height))]).expect("a rectangle")
    }

    /// The irradiance of a point where the zenith has a radiance of 1.
    pub(super) fn share(&self, point: &DifferentialArea) -> f64 {
        let level = (point.position() - self.middle).dot(self.up);
        let walls = self.ways().map(|way| self.wall(way, level));
        let sides = || std::iter::once(&self.enclosure.polygons()[self.ceiling]).chain(&walls);
        let numbered = || (self.ceiling..).zip(sides());
        let share = match self.sky.kind {
            SkyKind::Uniform => {
                let seen = |(id, side)| self.enclosure.form_factor_within(point, id, side, ENOUGH).value;
                PI * numbered().map(seen).sum::<f64>()
            }
            SkyKind::Overcast => {
                let seen = |(id, side)| self.enclosure.visible_boundary(point, id, side);
                let [even, rising] = self.moments(point, numbered().flat_map(seen));
                (even + 2.0 * rising) / 3.0
            }
        };
        if share > ROUNDING { share } else { 0.0 }
    }

    /// The integrals of n·ω and of (n·ω)(z·ω) over the directions ω within edges that have them to the left, z up.
    ///
    /// Lambert's sum ½ Σ β n·c over the edges, each of angle β in a plane of unit normal c; and, as the divergence on the sphere of
    /// (z·ω) ∇(n·ω) is n·z − 3 (n·ω)(z·ω), a third of n·z Ω + Σ (n·c) z·(v + w) tan β/2 for edges from v to w (cf. Arvo 1995).
    fn moments(&self, point: &DifferentialArea, edges: impl Iterator<Item = [DVec3; 2]>) -> [f64; 2] {
        let (normal, up) = (point.normal(), self.up);
        let [mut even, mut rising, mut solid] = [0.0; 3];
        for edge in edges {
            // Edges run counter-clockwise as seen from the front: the other way around as the formulas have it.
            let [w, v] = edge.map(DVec3::normalize);
            let cross = v.cross(w);
            let (sine, cosine) = (cross.length(), v.dot(w));
            if sine == 0.0 {
                continue;
            }
            let tilt = normal.dot(cross) / sine;
            even += sine.atan2(cosine) * tilt / 2.0;
            rising += tilt * up.dot(v + w) * sine / (1.0 + cosine);
            solid += 2.0 * up.dot(cross).atan2(1.0 + cosine + up.dot(v + w));
        }
        [even, (normal.dot(up) * solid + rising) / 3.0]
    }
}
