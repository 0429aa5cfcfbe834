//! Light from one place, or from one direction.
use super::cubature::{Moments, Place, moments};
use crate::scene::{Scene, lamp::Distribution, lamp::Lamp};
use formfactor::{DifferentialArea, Enclosure, PlanarPolygon};
use glam::DVec3;

/// The sun stands so many sizes of the scene away: its shadows are as of parallel light within so small a share of the scene.
const FAR: f64 = 134_217_728.0;
/// Parts of polygons are no larger than this, as seen from a lamp.
const WIDE: f64 = 1.0;
/// And no larger than this share of its cone.
const OF_CONE: f64 = 0.5;
/// What is measured changes within such an angle.
const FINE: f64 = 0.2;

/// Light from one place.
#[derive(Debug)]
pub(super) struct Beam<'s> {
    /// Where it comes from.
    pub(super) eye: DVec3,
    kind: BeamKind<'s>,
    /// Its strength per band.
    pub(super) bands: &'s [f64],
    /// Square metres in the square of the scene's unit.
    area: f64,
}

#[derive(Debug)]
enum BeamKind<'s> {
    Lamp(&'s Lamp),
    /// The unit vector along which light goes.
    Sun(DVec3),
}

impl<'s> Beam<'s> {
    /// Of all lamps and suns of a scene.
    pub(super) fn all(scene: &'s Scene) -> Vec<Beam<'s>> {
        let area = scene.asset.unit * scene.asset.unit;
        let [low, high] = scene.extent();
        let far = FAR * (high - low).length();
        let lamp = |lamp: &'s Lamp| Beam {
            eye: lamp.position,
            kind: BeamKind::Lamp(lamp),
            bands: &lamp.intensity,
            area,
        };
        let suns = scene.suns.iter().map(|sun| {
            let way = sun.direction.normalize();
            Beam {
                eye: low.midpoint(high) - far * way,
                kind: BeamKind::Sun(way),
                bands: &sun.irradiance,
                area,
            }
        });
        scene.lamps.iter().map(lamp).chain(suns).collect()
    }

    /// Whether it comes from beyond the scene.
    pub(super) fn is_sun(&self) -> bool {
        matches!(self.kind, BeamKind::Sun(_))
    }

    /// The irradiance at a place with nothing in between, for a strength of 1.
    ///
    /// I cos θ / d², d in metres.
    pub(super) fn share(&self, place: DVec3, normal: DVec3) -> f64 {
        match self.kind {
            BeamKind::Sun(way) => (-way.dot(normal)).max(0.0),
            BeamKind::Lamp(lamp) => {
                let way = place - self.eye;
                let square = way.length_squared();
                let cosine = -way.dot(normal) / square.sqrt();
                if cosine > 0.0 { lamp.share(way) * cosine / (square * self.area) } else { 0.0 }
            }
        }
    }

    /// The rings of the lit part of a convex polygon, a part of a surface, and the integrals over it; nothing where it turns its back.
    pub(super) fn lit(
        &self,
        enclosure: &Enclosure,
        (surface, part): (usize, &PlanarPolygon),
        linear: impl Fn(DVec3) -> [f64; 2],
    ) -> Option<(Vec<Vec<DVec3>>, Moments)> {
        let normal = part.normal();
        let corners = part.loops().next()?;
        let eye = DifferentialArea::new(self.eye, -normal).ok()?;
        let place = |at: DVec3| Place { at, linear: linear(at) };
        let apex = corners.iter().sum::<DVec3>() / corners.len() as f64;
        // Signed triangles from a common apex make up each ring: what lies in a hole is taken off.
        let fan = |ring: &Vec<DVec3>| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(a, b)| [apex, *a, *b].map(place)).collect::<Vec<_>>()
        };
        let rings: Vec<Vec<DVec3>> = enclosure.visible_part(&eye, surface, part).rings().collect();
        let triangles: Vec<[Place; 3]> = rings.iter().flat_map(fan).collect();
        let size = |triangle: &[Place; 3]| self.size(triangle);
        let moments = moments(&triangles, normal, |at| self.share(at, normal), size);
        (moments.square > 0.0).then_some((rings, moments))
    }

    /// How large a triangle is beside what can be taken at once: 0 where the beam misses it.
    fn size(&self, triangle: &[Place; 3]) -> f64 {
        let BeamKind::Lamp(lamp) = self.kind else { return 0.0 };
        let [a, b, c] = triangle.map(|place| place.at);
        let middle = (a + b + c) / 3.0;
        let radius = [a, b, c].map(|p| p.distance(middle)).into_iter().fold(0.0, f64::max);
        let way = middle - self.eye;
        // An upper bound on the angle that it is seen under: a half turn close by.
        let angle = (radius / way.length()).min(1.0).asin();
        match &lamp.distribution {
            Distribution::Even => 2.0 * angle / WIDE,
            Distribution::Measured(_) => 2.0 * angle / FINE,
            Distribution::Cone(cone) => {
                let outer = cone.outer.acos();
                let off = way.angle_between(lamp.frame.z_axis) - angle;
                if off > outer { 0.0 } else { 2.0 * angle / WIDE.min(OF_CONE * outer) }
            }
        }
    }
}
