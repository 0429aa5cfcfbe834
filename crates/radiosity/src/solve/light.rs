//! What every element receives and sends.
use super::{magnitude::mean_by_itself, state::Column};
use crate::mesh::element::{Element, Mesh};
use crate::scene::Scene;
use std::{f64::consts::PI, ops::Range};

/// Radiosity and irradiance, elements × bands, and what they are made of.
#[derive(Clone, Debug)]
pub(super) struct Light {
    pub(super) bands: usize,
    pub(super) radiosity: Vec<f64>,
    pub(super) irradiance: Vec<f64>,
    pub(super) areas: Vec<f64>,
    pub(super) reflectance: Vec<f64>,
    /// Emitted radiosity E = πL.
    pub(super) emittance: Vec<f64>,
    /// The irradiance straight from lights without surfaces: it does not change.
    pub(super) direct: Vec<f64>,
    /// Emitted power per band.
    pub(super) emitted: Vec<f64>,
}

/// What lights without surfaces bring to the elements, as far as it is known.
#[derive(Clone, Debug, Default)]
pub(super) struct DirectLight {
    /// Irradiance, elements × bands.
    pub(super) irradiance: Vec<f64>,
    /// What comes from beyond the scene: the part of it that counts as emitted.
    pub(super) beyond: Vec<f64>,
}

impl Light {
    /// Only what the patches emit.
    pub(super) fn new(scene: &Scene, mesh: &Mesh) -> Light {
        let patch = |element: &Element| &scene.patches[element.patch];
        let emission = mesh.elements.iter().flat_map(|element| &patch(element).emission);
        let emittance: Vec<_> = emission.map(|radiance| PI * radiance).collect();
        let reflectance = |(index, element)| patch(element).reflectance_over(mesh.triangle(index));
        let mut light = Light {
            bands: scene.bands,
            radiosity: Vec::new(),
            irradiance: Vec::new(),
            areas: (0..mesh.elements.len()).map(|element| mesh.area(element)).collect(),
            reflectance: mesh.elements.iter().enumerate().flat_map(reflectance).collect(),
            emittance,
            direct: Vec::new(),
            emitted: Vec::new(),
        };
        light.shine(DirectLight::default(), &vec![0.0; scene.bands]);
        light
    }

    /// What the patches emit, and reflect of what lights bring, B = E + ρH: where that is not known they bring nothing. `power` is that of the
    /// lamps per band.
    pub(super) fn shine(&mut self, mut direct: DirectLight, power: &[f64]) {
        let count = self.emittance.len();
        direct.irradiance.resize(count, 0.0);
        direct.beyond.resize(count, 0.0);
        let (own, beyond) = (self.total(&self.emittance), self.total(&direct.beyond));
        let emitted = own.iter().zip(beyond).zip(power);
        self.emitted = emitted.map(|((own, beyond), lamps)| own + beyond + lamps).collect();
        self.direct = direct.irradiance;
        self.receive_all(vec![0.0; count]);
    }

    /// The bands in which something emits: no other needs to be solved.
    pub(super) fn live(&self) -> impl Iterator<Item = usize> {
        (0..self.bands).filter(|&band| self.emitted[band] > 0.0)
    }

    /// The largest reflectance of an element in a band that something emits in.
    pub(super) fn largest_reflectance(&self, element: usize) -> f64 {
        self.live().map(|band| self.reflectance[element * self.bands + band]).fold(0.0, f64::max)
    }

    /// Adds a shot: H += F ΔB for every element and band, and B = E + ρH.
    pub(super) fn receive(&mut self, column: &Column, shot: &[f64]) {
        let bands = self.bands;
        for (element, factor) in column.iter() {
            for (band, power) in shot.iter().enumerate().filter(|(_, power)| **power != 0.0) {
                let at = element * bands + band;
                self.irradiance[at] += factor * power;
                self.radiosity[at] = self.emittance[at] + self.reflectance[at] * self.irradiance[at];
            }
        }
    }

    /// Takes the irradiance of every element and band from other elements; B = E + ρH.
    pub(super) fn receive_all(&mut self, mut irradiance: Vec<f64>) {
        irradiance.iter_mut().zip(&self.direct).for_each(|(h, direct)| *h += direct);
        let reflected = irradiance.iter().zip(&self.reflectance).map(|(h, rho)| h * rho);
        self.radiosity = reflected.zip(&self.emittance).map(|(reflected, e)| e + reflected).collect();
        self.irradiance = irradiance;
    }

    /// What an element sends before anything is exchanged, E + ρH for the H of lights: elements × bands.
    pub(super) fn given(&self) -> Vec<f64> {
        let reflected = self.reflectance.iter().zip(&self.direct).map(|(rho, h)| rho * h);
        self.emittance.iter().zip(reflected).map(|(e, reflected)| e + reflected).collect()
    }

    /// Of the power that is emitted, what lights bring to the elements and these absorb, and what misses them: per band.
    pub(super) fn spent_directly(&self) -> [Vec<f64>; 2] {
        let kept: Vec<f64> =
            self.direct.iter().zip(&self.reflectance).map(|(h, rho)| h * (1.0 - rho)).collect();
        let (own, received) = (self.total(&self.emittance), self.total(&self.direct));
        let missed = self.emitted.iter().zip(own).zip(received);
        [self.total(&kept), missed.map(|((emitted, own), received)| emitted - own - received).collect()]
    }

    /// Σ A·value over some elements, for each band.
    pub(super) fn power(&self, values: &[f64], elements: Range<usize>) -> Vec<f64> {
        let mut sums = vec![0.0; self.bands];
        for element in elements {
            for (sum, value) in sums.iter_mut().zip(&values[element * self.bands..]) {
                *sum += self.areas[element] * value;
            }
        }
        sums
    }

    /// What some elements send on average, per band.
    pub(super) fn mean_radiosity(&self, elements: Range<usize>) -> Vec<f64> {
        let area: f64 = self.areas[elements.clone()].iter().sum();
        self.power(&self.radiosity, elements).iter().map(|power| power / area).collect()
    }

    /// Σ A·value over all elements, for each band.
    pub(super) fn total(&self, values: &[f64]) -> Vec<f64> {
        self.power(values, 0..self.areas.len())
    }

    /// How bright reflected light is, per band: the mean of ρH weighted by the power ρHA itself, so that what lies in
    /// the dark does not count, however large it is. 0 where nothing is reflected.
    pub(super) fn brightness(&self) -> Vec<f64> {
        let reflected: Vec<_> =
            self.radiosity.iter().zip(&self.emittance).map(|(b, e)| (b - e).abs()).collect();
        mean_by_itself(&reflected, &self.areas, self.bands)
    }
}
