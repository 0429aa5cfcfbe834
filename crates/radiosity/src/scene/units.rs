//! Watts and lumens.
use super::Scene;
use crate::spectrum::eye;

/// What the powers of a scene are counted in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Units {
    /// Watts: radiance in W/m²/sr, irradiance in W/m².
    #[default]
    Radiant,
    /// Lumens: luminance in cd/m², illuminance in lx.
    Luminous,
}

/// Lumens in a watt of white light, as of a spectrum that is even from 380 to 780 nm. (683 lm/W, which defines the candela, holds for
/// 555 nm alone.)
const WHITE: f64 = 179.0;
/// Lumens in a watt at the peak of the eye's response.
const PEAK: f64 = 683.0;
/// How much red, green and blue count, of which white has one each (IEC 61966-2-1).
const RGB: [f64; 3] = [0.2126, 0.7152, 0.0722];

impl Scene {
    /// Lumens in a unit of power of each band: as many values as bands.
    ///
    /// A watt of grey is 179 lm, whatever the shade; of bands with wavelengths each has what the eye sees of it, 683 lm/W at most.
    #[must_use]
    pub fn lumens(&self) -> Vec<f64> {
        let is_luminous = self.units == Units::Luminous;
        let white = if is_luminous { 1.0 } else { WHITE };
        if self.wavelengths.len() == self.bands && self.bands > 0 {
            let of = |nm: &f64| if is_luminous { 1.0 } else { PEAK * eye(*nm) };
            return self.wavelengths.iter().map(of).collect();
        }
        match self.bands {
            3 => RGB.map(|share| share * white).to_vec(),
            bands => vec![white / bands as f64; bands],
        }
    }

    /// The luminous value of one per band: lx of an irradiance, lm of a power.
    #[must_use]
    pub fn luminous(&self, values: &[f64]) -> f64 {
        self.lumens().iter().zip(values).map(|(lumens, value)| lumens * value).sum()
    }

    /// What a unit of luminous light that is white is in each band: the inverse of [`Scene::lumens`] for a spectrum as even as the bands.
    #[must_use]
    pub fn white(&self) -> f64 {
        let whole: f64 = self.lumens().iter().sum();
        if whole > 0.0 { 1.0 / whole } else { 0.0 }
    }
}
