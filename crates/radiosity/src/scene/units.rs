//! Watts and lumens.
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

impl Units {
    /// Lumens in a unit of power of each band.
    pub(super) fn lumens(self, bands: usize, wavelengths: &[f64]) -> Vec<f64> {
        let is_luminous = self == Units::Luminous;
        if wavelengths.len() == bands {
            let of = |nm: &f64| if is_luminous { 1.0 } else { PEAK * eye(*nm) };
            return wavelengths.iter().map(of).collect();
        }
        let white = if is_luminous { 1.0 } else { WHITE };
        match bands {
            3 => RGB.map(|share| share * white).to_vec(),
            bands => vec![white / bands as f64; bands],
        }
    }
}
