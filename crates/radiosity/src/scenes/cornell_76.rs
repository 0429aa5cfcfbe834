//! The Cornell box in 76 bands: the published spectra, 400 to 700 nm in steps of 4 nm.
use super::cornell_box::{GREEN, LAMP, RED, WHITE, cornell_box};
use crate::io::collada::model::{Material, Model};

/// How many bands.
const BANDS: usize = 76;
/// The lamp's reflectance is not published; its file assumes this.
const LAMP_REFLECTANCE: f64 = 0.78;
/// The lamp's radiance at wavelengths in nm, linear between.
const LAMP_RADIANCE: [[f64; 2]; 4] = [[400.0, 0.0], [500.0, 8.0], [600.0, 15.6], [700.0, 18.4]];

const WHITE_SPECTRUM: [f64; BANDS] = [
    0.343, 0.445, 0.551, 0.624, 0.665, 0.687, 0.708, 0.723, 0.715, 0.710, 0.745, 0.758, 0.739, 0.767, 0.777,
    0.765, 0.751, 0.745, 0.748, 0.729, 0.745, 0.757, 0.753, 0.750, 0.746, 0.747, 0.735, 0.732, 0.739, 0.734,
    0.725, 0.721, 0.733, 0.725, 0.732, 0.743, 0.744, 0.748, 0.728, 0.716, 0.733, 0.726, 0.713, 0.740, 0.754,
    0.764, 0.752, 0.736, 0.734, 0.741, 0.740, 0.732, 0.745, 0.755, 0.751, 0.744, 0.731, 0.733, 0.744, 0.731,
    0.712, 0.708, 0.729, 0.730, 0.727, 0.707, 0.703, 0.729, 0.750, 0.760, 0.751, 0.739, 0.724, 0.730, 0.740,
    0.737,
];
const GREEN_SPECTRUM: [f64; BANDS] = [
    0.092, 0.096, 0.098, 0.097, 0.098, 0.095, 0.095, 0.097, 0.095, 0.094, 0.097, 0.098, 0.096, 0.101, 0.103,
    0.104, 0.107, 0.109, 0.112, 0.115, 0.125, 0.140, 0.160, 0.187, 0.229, 0.285, 0.343, 0.390, 0.435, 0.464,
    0.472, 0.476, 0.481, 0.462, 0.447, 0.441, 0.426, 0.406, 0.373, 0.347, 0.337, 0.314, 0.285, 0.277, 0.266,
    0.250, 0.230, 0.207, 0.186, 0.171, 0.160, 0.148, 0.141, 0.136, 0.130, 0.126, 0.123, 0.121, 0.122, 0.119,
    0.114, 0.115, 0.117, 0.117, 0.118, 0.120, 0.122, 0.128, 0.132, 0.139, 0.144, 0.146, 0.150, 0.152, 0.157,
    0.159,
];
const RED_SPECTRUM: [f64; BANDS] = [
    0.040, 0.046, 0.048, 0.053, 0.049, 0.050, 0.053, 0.055, 0.057, 0.056, 0.059, 0.057, 0.061, 0.061, 0.060,
    0.062, 0.062, 0.062, 0.061, 0.062, 0.060, 0.059, 0.057, 0.058, 0.058, 0.058, 0.056, 0.055, 0.056, 0.059,
    0.057, 0.055, 0.059, 0.059, 0.058, 0.059, 0.061, 0.061, 0.063, 0.063, 0.067, 0.068, 0.072, 0.080, 0.090,
    0.099, 0.124, 0.154, 0.192, 0.255, 0.287, 0.349, 0.402, 0.443, 0.487, 0.513, 0.558, 0.584, 0.620, 0.606,
    0.609, 0.651, 0.612, 0.610, 0.650, 0.638, 0.627, 0.620, 0.630, 0.628, 0.642, 0.639, 0.657, 0.639, 0.635,
    0.642,
];

/// The Cornell box as measured, band by band.
pub(super) fn cornell_76() -> Model {
    let whole = cornell_box();
    let mut materials = whole.materials;
    for (index, spectrum) in [(WHITE, WHITE_SPECTRUM), (RED, RED_SPECTRUM), (GREEN, GREEN_SPECTRUM)] {
        let plain =
            Material { reflectance: spectrum.into(), emission: vec![0.0; BANDS], ..materials[index].clone() };
        materials[index] = plain;
    }
    materials[LAMP].reflectance = vec![LAMP_REFLECTANCE; BANDS];
    materials[LAMP].emission = wavelengths().map(radiance).collect();
    Model {
        title: "The Cornell box in the 76 bands of its published spectra".into(),
        wavelengths: wavelengths().collect(),
        materials,
        ..whole
    }
}

/// 400, 404, … 700 nm.
fn wavelengths() -> impl Iterator<Item = f64> {
    (400..=700).step_by(4).map(f64::from)
}

/// The lamp's radiance at a wavelength.
fn radiance(nm: f64) -> f64 {
    let below = LAMP_RADIANCE.iter().rposition(|[known, _]| *known <= nm).unwrap_or(0);
    let [[from, low], [to, high]] =
        [LAMP_RADIANCE[below], LAMP_RADIANCE[(below + 1).min(LAMP_RADIANCE.len() - 1)]];
    if nm == from { low } else { low + (high - low) * (nm - from) / (to - from) }
}
