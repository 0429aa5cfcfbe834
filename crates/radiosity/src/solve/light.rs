//! What every element receives and sends.
use crate::{Mesh, Patch, Scene};
use std::{f64::consts::PI, ops::Range};

/// Radiosity and irradiance, elements × bands, and what they are made of.
#[derive(Debug)]
pub(super) struct Light {
    pub(super) bands: usize,
    pub(super) radiosity: Vec<f64>,
    pub(super) irradiance: Vec<f64>,
    pub(super) areas: Vec<f64>,
    pub(super) reflectance: Vec<f64>,
    /// Emitted radiosity E = πL.
    pub(super) emittance: Vec<f64>,
}

impl Light {
    /// Only what the patches emit: B = E.
    pub(super) fn new(scene: &Scene, mesh: &Mesh) -> Light {
        let spread = |value: fn(&Patch) -> &Vec<f64>| -> Vec<f64> {
            mesh.elements.iter().flat_map(|element| value(&scene.patches[element.patch])).copied().collect()
        };
        let emittance: Vec<_> =
            spread(|patch| &patch.emission).iter().map(|radiance| PI * radiance).collect();
        Light {
            bands: scene.bands,
            radiosity: emittance.clone(),
            irradiance: vec![0.0; emittance.len()],
            areas: (0..mesh.elements.len()).map(|element| mesh.area(element)).collect(),
            reflectance: spread(|patch| &patch.reflectance),
            emittance,
        }
    }

    /// Adds a shot: H += F ΔB for every element and band, and B = E + ρH.
    pub(super) fn receive(&mut self, column: &[f64], shot: &[f64]) {
        let bands = self.bands;
        for (element, factor) in column.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
            for (band, power) in shot.iter().enumerate() {
                let at = element * bands + band;
                self.irradiance[at] += factor * power;
                self.radiosity[at] = self.emittance[at] + self.reflectance[at] * self.irradiance[at];
            }
        }
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

    /// Σ A·value over all elements, for each band.
    pub(super) fn total(&self, values: &[f64]) -> Vec<f64> {
        self.power(values, 0..self.areas.len())
    }
}
