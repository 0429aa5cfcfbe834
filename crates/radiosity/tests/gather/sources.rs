//! All that sends light to a point, as the solution left it: an exact gather.
use radiosity::formfactor::{DifferentialArea, Enclosure, Error, PlanarPolygon};
use radiosity::glam::DVec3;
use radiosity::{Scene, SkyKind, Solution};
use std::f64::consts::PI;

/// How far beyond the scene the sides of the sky stand, in its sizes.
const FAR: f64 = 3.0;
/// The sun stands so many sizes of the scene away.
const SUN: f64 = 1e8;

/// All that sends light.
pub(crate) struct Sources<'s> {
    scene: &'s Scene,
    /// The patches, and the sides of the sky.
    enclosure: Enclosure,
    /// For each patch its elements, and what each sends beyond what the patch emits, band by band.
    elements: Vec<Vec<(PlanarPolygon, Vec<f64>)>>,
    middle: DVec3,
    size: f64,
}

impl<'s> Sources<'s> {
    pub(crate) fn new(scene: &'s Scene, solution: &Solution) -> Result<Sources<'s>, Error> {
        let mut elements = vec![Vec::new(); scene.patches.len()];
        for (index, element) in solution.mesh.elements.iter().enumerate() {
            let patch = &scene.patches[element.patch];
            let emitted = patch.emission.iter().map(|radiance| PI * radiance);
            let sent = &solution.radiosity[index * scene.bands..][..scene.bands];
            let reflected: Vec<f64> =
                sent.iter().zip(emitted).map(|(sent, emitted)| sent - emitted).collect();
            if reflected.iter().any(|band| *band > 0.0) {
                // Slivers of no area send nothing.
                let Ok(polygon) = PlanarPolygon::new([solution.mesh.triangle(index)]) else { continue };
                elements[element.patch].push((polygon, reflected));
            }
        }
        let [low, high] = scene.extent();
        let (middle, size) = (low.midpoint(high), FAR * (high - low).length());
        let mut sources = Sources { scene, enclosure: Enclosure::new(Vec::new()), elements, middle, size };
        let mut polygons: Vec<PlanarPolygon> =
            scene.patches.iter().map(|patch| patch.polygon.clone()).collect();
        if scene.sky.is_some() {
            polygons.extend(sources.sides(-size)?);
        }
        sources.enclosure = Enclosure::new(polygons);
        Ok(sources)
    }

    /// The ceiling of the sky, and its walls from a height over the middle on; fronts inside.
    fn sides(&self, height: f64) -> Result<Vec<PlanarPolygon>, Error> {
        let up = self.scene.asset.up.normalize();
        let (u, v) = up.any_orthonormal_pair();
        let at = |[a, b]: [f64; 2], height: f64| self.middle + self.size * (a * u + b * v) + height * up;
        let rim = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        let mut sides = vec![PlanarPolygon::new([[0, 3, 2, 1].map(|k| at(rim[k], self.size))])?];
        for k in 0..4 {
            let (from, to) = (rim[k], rim[(k + 1) % 4]);
            let wall = [at(from, height), at(from, self.size), at(to, self.size), at(to, height)];
            sides.push(PlanarPolygon::new([wall])?);
        }
        Ok(sides)
    }

    /// The irradiance of a point of a patch, band by band.
    pub(crate) fn gather(&self, patch: usize, point: DVec3) -> Result<Vec<f64>, Error> {
        let normal = self.scene.patches[patch].polygon.normal();
        let here = DifferentialArea::new(point, normal)?.owned_by(patch);
        let (direct, reflected) = (self.direct(&here)?, self.reflected(&here));
        Ok(direct.iter().zip(reflected).map(|(direct, reflected)| direct + reflected).collect())
    }

    fn reflected(&self, here: &DifferentialArea) -> Vec<f64> {
        let mut light = vec![0.0; self.scene.bands];
        for (source, patch) in self.scene.patches.iter().enumerate() {
            if !patch.emits() && self.elements[source].is_empty() {
                continue;
            }
            let whole = self.enclosure.form_factor(here, source).value;
            if whole == 0.0 {
                continue;
            }
            let emitted = patch.emission.iter().map(|radiance| PI * radiance);
            light.iter_mut().zip(emitted).for_each(|(light, emitted)| *light += whole * emitted);
            for (polygon, sent) in &self.elements[source] {
                let factor = self.enclosure.form_factor_to_part(here, source, polygon).value;
                light.iter_mut().zip(sent).for_each(|(light, sent)| *light += factor * sent);
            }
        }
        light
    }

    /// What lamps, suns and the sky bring.
    ///
    /// # Panics
    /// For a sky that is not uniform.
    fn direct(&self, here: &DifferentialArea) -> Result<Vec<f64>, Error> {
        let mut light = vec![0.0; self.scene.bands];
        let mut add = |share: f64, bands: &[f64]| {
            light.iter_mut().zip(bands).for_each(|(light, band)| *light += share * band);
        };
        for lamp in &self.scene.lamps {
            let way = here.position() - lamp.position;
            let metres = way.length_squared() * self.scene.asset.unit.powi(2);
            let cosine = -way.normalize().dot(here.normal());
            if cosine > 0.0 && self.enclosure.sees(here, lamp.position) {
                add(lamp.share(way) * cosine / metres, &lamp.intensity);
            }
        }
        for sun in &self.scene.suns {
            let way = sun.direction.normalize();
            let cosine = -way.dot(here.normal());
            if cosine > 0.0 && self.enclosure.sees(here, self.middle - SUN * self.size * way) {
                add(cosine, &sun.irradiance);
            }
        }
        if let Some(sky) = &self.scene.sky {
            assert!(sky.kind == SkyKind::Uniform, "this gather knows uniform skies alone");
            let first = self.scene.patches.len();
            let level = (here.position() - self.middle).dot(self.scene.asset.up.normalize());
            for (side, part) in self.sides(level)?.iter().enumerate() {
                let factor = self.enclosure.form_factor_to_part(here, first + side, part).value;
                add(PI * factor, &sky.radiance);
            }
        }
        Ok(light)
    }
}
