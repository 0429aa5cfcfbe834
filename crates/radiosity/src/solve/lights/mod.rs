//! Light that comes from no surface: lamps, the sun and the sky.
//!
//! ```text
//! beam        light from one place, or from one direction
//! dome        the sky, past all that hides it
//! cubature    integrals over what is lit
//! ```
//!
//! What a point receives is exact: a beam meets it or does not, and of the sky it sees the visible parts of a ceiling and four walls. What a polygon
//! receives from a beam is the integral over its lit part, another polygon: its shadows have exact edges.
mod beam;
mod cubature;
mod dome;

use crate::scene::Scene;
use beam::Beam;
pub(super) use cubature::Moments;
use dome::Dome;
use formfactor::{DifferentialArea, Enclosure, PlanarPolygon};
use glam::DVec3;

/// The lights of a scene without surfaces.
#[derive(Debug)]
pub(super) struct Lights<'s> {
    bands: usize,
    beams: Vec<Beam<'s>>,
    dome: Option<Dome<'s>>,
    /// The power of the lamps, per band, in the scene's unit of area.
    power: Vec<f64>,
}

/// What a beam brings to a convex polygon.
#[derive(Clone, Debug)]
pub(super) struct LitPolygon {
    /// Which beam.
    pub(super) beam: usize,
    pub(super) moments: Moments,
    /// What it lights: counter-clockwise seen from the front, holes clockwise.
    pub(super) rings: Vec<Vec<DVec3>>,
}

impl<'s> Lights<'s> {
    /// The lights of a scene whose patches hide as these polygons do.
    pub(super) fn new(scene: &'s Scene, polygons: &[PlanarPolygon]) -> Lights<'s> {
        let area = scene.asset.unit * scene.asset.unit;
        let mut power = vec![0.0; scene.bands];
        for lamp in &scene.lamps {
            power.iter_mut().zip(lamp.power()).for_each(|(sum, power)| *sum += power / area);
        }
        Lights {
            bands: scene.bands,
            beams: Beam::all(scene),
            dome: scene.sky.as_ref().map(|sky| Dome::over(scene, sky, polygons)),
            power,
        }
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.beams.is_empty() && self.dome.is_none()
    }

    /// Whether there is a sky.
    pub(super) fn has_sky(&self) -> bool {
        self.dome.is_some()
    }

    /// The power of all lamps per band. The sun and the sky have as much as the scene receives of them.
    pub(super) fn power(&self) -> &[f64] {
        &self.power
    }

    /// The irradiance of a point among the polygons of an enclosure, per band: from lamps, and from beyond the scene.
    pub(super) fn irradiance(&self, enclosure: &Enclosure, point: &DifferentialArea) -> [Vec<f64>; 2] {
        let mut sums = [vec![0.0; self.bands], vec![0.0; self.bands]];
        for beam in &self.beams {
            let share = beam.share(point.position(), point.normal());
            if share > 0.0 && enclosure.sees(point, beam.eye) {
                add(&mut sums[usize::from(beam.is_sun())], beam.bands, share);
            }
        }
        add(&mut sums[1], self.sky_radiance(), self.sky(point));
        sums
    }

    /// The irradiance of a point from the sky, where its radiance at the zenith is 1.
    pub(super) fn sky(&self, point: &DifferentialArea) -> f64 {
        self.dome.as_ref().map_or(0.0, |dome| dome.share(point))
    }

    /// The radiance of the sky at its zenith, per band; nothing where there is none.
    pub(super) fn sky_radiance(&self) -> &[f64] {
        self.dome.as_ref().map_or(&[], |dome| &dome.sky.radiance)
    }

    /// What every beam brings to a convex part of a surface of the enclosure, past all others; for a strength of 1. `linear` gives two linear
    /// functions of places on it.
    pub(super) fn lit(
        &self,
        enclosure: &Enclosure,
        (surface, part): (usize, &PlanarPolygon),
        linear: impl Fn(DVec3) -> [f64; 2],
    ) -> Vec<LitPolygon> {
        let lit = |(index, beam): (usize, &Beam<'_>)| {
            let (rings, moments) = beam.lit(enclosure, (surface, part), &linear)?;
            Some(LitPolygon { beam: index, moments, rings })
        };
        self.beams.iter().enumerate().filter_map(lit).collect()
    }

    /// The strength of a beam per band, and whether it comes from beyond the scene.
    pub(super) fn beam(&self, index: usize) -> (&[f64], bool) {
        (self.beams[index].bands, self.beams[index].is_sun())
    }
}

/// About how much the lights bring to a surface in a band; for a choice of unit.
pub(super) fn magnitude(scene: &Scene, band: usize) -> f64 {
    let [low, high] = scene.extent();
    let size = (high - low).length() * scene.asset.unit;
    let lamps = scene.lamps.iter().map(|lamp| lamp.power()[band] / (size * size));
    let suns = scene.suns.iter().map(|sun| sun.irradiance[band]);
    let sky = scene.sky.iter().map(|sky| std::f64::consts::PI * sky.radiance[band]);
    lamps.chain(suns).chain(sky).fold(0.0, f64::max)
}

fn add(sums: &mut [f64], bands: &[f64], share: f64) {
    sums.iter_mut().zip(bands).for_each(|(sum, band)| *sum += share * band);
}
