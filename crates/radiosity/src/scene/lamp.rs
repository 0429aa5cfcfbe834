//! Lamps that are points.
use super::photometry::Photometry;
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// A lamp without a surface, and how bright it is in each direction.
#[derive(Clone, Debug)]
pub struct Lamp {
    /// The name in the file.
    pub name: String,
    /// Where it is.
    pub position: DVec3,
    /// Which way it points: the columns are the direction from which azimuths are counted (C0), that at a quarter turn from it
    /// counter-clockwise seen from ahead (C90), and the way ahead (the nadir of a luminaire that hangs). Orthonormal.
    pub frame: DMat3,
    /// How its intensity depends on the direction.
    pub distribution: Distribution,
    /// Radiant intensity per band, W/sr, where the distribution is 1. Irradiance is W/m² at distances in metres, whatever the scene's unit.
    pub intensity: Vec<f64>,
}

/// How the intensity of a lamp depends on the direction.
#[derive(Clone, Debug)]
pub enum Distribution {
    /// 1 in all directions.
    Even,
    /// A cone around the way ahead.
    Cone(Cone),
    /// As measured; 1 stands for 1 cd.
    Measured(Arc<Photometry>),
}

/// Intensity that falls from the axis: cosᵉ of the angle to it, and to 0 between an inner and an outer cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The power of the cosine: 0 is even, 1 as of a Lambertian surface.
    pub exponent: f64,
    /// The cosine of the angle from which on it falls to 0.
    pub inner: f64,
    /// The cosine of the angle from which on it is 0; at most `inner`.
    pub outer: f64,
    /// How it falls.
    pub rim: Rim,
}

/// How the intensity of a cone falls from 1 to 0 while t falls from 1 to 0; t is linear in the cosine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rim {
    /// t², as `KHR_lights_punctual` recommends.
    Squared,
    /// 3t² − 2t³, as Blender has it.
    Smooth,
}

/// Intervals and nodes of the rule for the power of a cone.
const PARTS: usize = 64;

impl Lamp {
    /// A lamp of even intensity in all directions.
    #[must_use]
    pub fn even(name: impl Into<String>, position: DVec3, intensity: Vec<f64>) -> Lamp {
        Lamp {
            name: name.into(),
            position,
            frame: DMat3::IDENTITY,
            distribution: Distribution::Even,
            intensity,
        }
    }

    /// What the intensity is multiplied by along a way from the lamp, of any length but 0.
    #[must_use]
    pub fn share(&self, way: DVec3) -> f64 {
        match &self.distribution {
            Distribution::Even => 1.0,
            Distribution::Cone(cone) => cone.share(way.dot(self.frame.z_axis) / way.length()),
            Distribution::Measured(table) => table.candela(self.frame.transpose() * way),
        }
    }

    /// Radiant power per band, W.
    #[must_use]
    pub fn power(&self) -> Vec<f64> {
        let whole = match &self.distribution {
            Distribution::Even => 4.0 * PI,
            Distribution::Cone(cone) => cone.integral(),
            Distribution::Measured(table) => table.lumens(),
        };
        self.intensity.iter().map(|intensity| intensity * whole).collect()
    }
}

impl Cone {
    /// Of a Lambertian surface.
    pub const LAMBERTIAN: Cone = Cone { exponent: 1.0, inner: 0.0, outer: 0.0, rim: Rim::Squared };

    /// The intensity at an angle to the axis of such a cosine.
    fn share(&self, cosine: f64) -> f64 {
        if cosine <= self.outer {
            return 0.0;
        }
        let t = if cosine < self.inner { (cosine - self.outer) / (self.inner - self.outer) } else { 1.0 };
        let rim = match self.rim {
            Rim::Squared => t * t,
            Rim::Smooth => t * t * (3.0 - 2.0 * t),
        };
        // Behind the plane of the lamp there is no power of a cosine.
        if self.exponent == 0.0 { rim } else { rim * cosine.max(0.0).powf(self.exponent) }
    }

    /// The integral over the sphere, by Simpson's rule in the cosine on both parts of the cone.
    fn integral(&self) -> f64 {
        let low = if self.exponent == 0.0 { self.outer } else { self.outer.max(0.0) };
        let part = |from: f64, to: f64| {
            let step = (to - from) / PARTS as f64;
            // At the rim itself a lamp without a penumbra jumps: what is just within counts.
            let inside = |c: f64| self.share(c.max(from + f64::EPSILON).min(to));
            let of = |k: usize| {
                let start = from + step * k as f64;
                inside(start) + 4.0 * inside(start + step / 2.0) + inside(start + step)
            };
            if step > 0.0 { step / 6.0 * (0..PARTS).map(of).sum::<f64>() } else { 0.0 }
        };
        let middle = self.inner.max(low);
        TAU * (part(low, middle) + part(middle, 1.0))
    }
}
