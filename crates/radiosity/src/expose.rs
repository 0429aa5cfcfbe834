//! Exposure: from radiosity, which has no upper limit, to the colours of a screen.
use crate::scene::Scene;
use crate::solve::solution::Solution;
use crate::spectrum::Colours;

/// The intensity that the average surface gets: mid grey.
const MID_GREY: f64 = 0.18;

/// An exposure: it turns a radiosity B into the intensity 1 − exp(−K·B). A small K is dark, a large K bright (Gomes 2010,
/// equation 2.17).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposure {
    k: f64,
}

impl Exposure {
    /// The exposure of a given K in m²/W; `None` unless K is positive and finite.
    #[must_use]
    pub fn new(k: f64) -> Option<Self> {
        (k.is_finite() && k > 0.0).then_some(Self { k })
    }

    /// The exposure at which the average radiosity of patches that do not emit becomes mid grey, 0.18 of full intensity.
    ///
    /// The average is the geometric mean of the luminance (Rec. 709) over lit elements, weighted by area. Where nothing but
    /// emitters is lit, the emitters count; where nothing is lit, K is 1.
    #[must_use]
    pub fn automatic(scene: &Scene, solution: &Solution) -> Self {
        let mesh = &solution.mesh;
        let colours = Colours::of(solution.bands, &scene.wavelengths).rows(&solution.radiosity);
        Self::of(colours.into_iter().enumerate().map(|(index, colour)| {
            (colour, mesh.area(index), scene.patches[mesh.elements[index].patch].emits())
        }))
    }

    /// The automatic exposure of any colours, each given as red, green and blue radiosity, the area that it covers, and whether
    /// it is an emitter's; see [`Exposure::automatic`].
    #[must_use]
    pub fn of(lit: impl Iterator<Item = ([f64; 3], f64, bool)> + Clone) -> Self {
        let others = lit.clone().filter(|(_, _, emitter)| !emitter);
        let mean = mean_luminance(others).or_else(|| mean_luminance(lit));
        let k = mean.map(|luminance| -(-MID_GREY).ln_1p() / luminance);
        k.and_then(Self::new).unwrap_or(Self { k: 1.0 })
    }

    /// K, in m²/W.
    #[must_use]
    pub fn k(self) -> f64 {
        self.k
    }

    /// The linear intensities, 0 to 1, of a red, green and blue radiosity.
    #[must_use]
    pub fn intensity(self, radiosity: [f64; 3]) -> [f64; 3] {
        radiosity.map(|band| -(-self.k * band.max(0.0)).exp_m1())
    }
}

/// Red, green and blue out of values that stand band by band.
///
/// `wavelengths` are those of the bands, in nm: what an observer sees of them, as linear sRGB; parts are negative where no
/// screen can show the colour. Without them the first three bands are red, green and blue; of fewer, the last is repeated.
///
/// ```
/// use radiosity::expose::rgb;
///
/// assert_eq!(rgb(&[1.0, 2.0, 3.0, 4.0], 2, &[]), [[1.0, 2.0, 2.0], [3.0, 4.0, 4.0]]);
/// ```
#[must_use]
pub fn rgb(values: &[f64], bands: usize, wavelengths: &[f64]) -> Vec<[f64; 3]> {
    Colours::of(bands, wavelengths).rows(values)
}

/// The sRGB transfer function: what an 8-bit channel stores for a linear intensity from 0 to 1 (IEC 61966-2-1).
#[must_use]
pub fn srgb(intensity: f64) -> f64 {
    if intensity <= 0.003_130_8 { 12.92 * intensity } else { 1.055 * intensity.powf(1.0 / 2.4) - 0.055 }
}

/// The geometric mean, weighted by area, over what is lit.
fn mean_luminance(lit: impl Iterator<Item = ([f64; 3], f64, bool)>) -> Option<f64> {
    let (mut sum, mut weight) = (0.0, 0.0);
    for (colour, area, _) in lit {
        let luminance = 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2];
        if luminance > 0.0 {
            sum += area * luminance.ln();
            weight += area;
        }
    }
    (weight > 0.0).then(|| (sum / weight).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intensity_starts_at_zero_rises_and_never_passes_one() {
        let exposure = Exposure::new(2.0).unwrap();
        let [none, some, all] = exposure.intensity([0.0, std::f64::consts::LN_2 / 2.0, 1e300]);
        assert_eq!((none, all), (0.0, 1.0));
        assert!((some - 0.5).abs() < 1e-15);
        assert_eq!(exposure.intensity([-1.0; 3]), [0.0; 3]);
    }

    #[test]
    fn k_is_positive_and_finite() {
        assert!([0.0, -1.0, f64::NAN, f64::INFINITY].iter().all(|k| Exposure::new(*k).is_none()));
    }

    #[test]
    fn fewer_bands_than_three_repeat_the_last() {
        assert_eq!(rgb(&[1.0, 2.0], 1, &[]), [[1.0; 3], [2.0; 3]]);
        assert_eq!(rgb(&[1.0, 2.0], 2, &[]), [[1.0, 2.0, 2.0]]);
        assert_eq!(rgb(&[1.0, 2.0, 3.0, 4.0], 4, &[]), [[1.0, 2.0, 3.0]]);
    }

    #[test]
    fn the_transfer_function_meets_its_known_values() {
        assert_eq!(srgb(0.0), 0.0);
        assert!((srgb(1.0) - 1.0).abs() < 1e-12);
        assert!((srgb(0.18) - 0.461_356).abs() < 1e-6);
        assert!((srgb(0.003_130_8 + 1e-12) - srgb(0.003_130_8)).abs() < 1e-6);
    }
}
