//! Exposure: from radiosity, which has no upper limit, to the colours of a screen.
use crate::spectrum::Colours;

/// The intensity that the middle of what is seen gets: mid grey.
const MID_GREY: f64 = 0.18;
/// What a twentieth of what is seen exceeds gets an intensity between these.
const BRIGHT: [f64; 2] = [0.5, 0.9];

/// An exposure: it turns a radiosity B into the intensity 1 − exp(−K·B). A small K is dark, a large K bright (Gomes 2010,
/// equation 2.17).
///
/// Of a colour the largest part gets that intensity, and the others keep their shares of it: bright colours stay as saturated as
/// dark ones, and no part exceeds 1.
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

    /// The automatic exposure of what is seen: colours, each given as red, green and blue radiosity, how much of the picture it
    /// covers, and whether it is an emitter's.
    ///
    /// The median brightness becomes mid grey, 0.18 of full intensity, as far as the 95th percentile stays between 0.5 and 0.9.
    /// The brightness of a colour is its largest part. What is not lit does not count, and emitters only where nothing else is
    /// lit; where nothing is lit, K is 1. K has four digits, so that it can be given again. O(n log n).
    ///
    /// ```
    /// use radiosity::expose::Exposure;
    ///
    /// let wall = |brightness: f64| ([brightness; 3], 1.0, false);
    /// let lamp = ([1e4; 3], 1.0, true);
    /// let exposure = Exposure::of([wall(2.0), wall(3.0), wall(4.0), lamp].into_iter());
    /// assert!((exposure.intensity([3.0; 3])[0] - 0.4054).abs() < 1e-4); // the brightest wall gets 0.5
    /// ```
    #[must_use]
    pub fn of(seen: impl Iterator<Item = ([f64; 3], f64, bool)>) -> Self {
        let brightness = |colour: [f64; 3]| colour.into_iter().fold(0.0, f64::max);
        let lit = seen.map(|(colour, area, emitter)| (brightness(colour), area, emitter));
        let (emitters, others): (Vec<_>, Vec<_>) =
            lit.filter(|(bright, area, _)| *bright > 0.0 && *area > 0.0).partition(|(.., emitter)| *emitter);
        let mut lit = if others.is_empty() { emitters } else { others };
        lit.sort_by(|a, b| a.0.total_cmp(&b.0));
        let k_at = |intensity: f64, brightness: f64| -(-intensity).ln_1p() / brightness;
        let k = percentile(&lit, 0.5).zip(percentile(&lit, 0.95)).map(|(middle, bright)| {
            let [least, most] = BRIGHT.map(|intensity| k_at(intensity, bright));
            k_at(MID_GREY, middle).clamp(least, most)
        });
        k.and_then(rounded).and_then(Self::new).unwrap_or(Self { k: 1.0 })
    }

    /// K, in m²/W.
    #[must_use]
    pub fn k(self) -> f64 {
        self.k
    }

    /// The linear intensities, 0 to 1, of a red, green and blue radiosity.
    #[must_use]
    pub fn intensity(self, radiosity: [f64; 3]) -> [f64; 3] {
        let brightest = radiosity.into_iter().fold(0.0, f64::max);
        let intensity = -(-self.k * brightest).exp_m1();
        let share = |part: f64| if brightest > 0.0 { part.max(0.0) / brightest } else { 0.0 };
        radiosity.map(|part| intensity * share(part))
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

/// A number to four digits.
fn rounded(number: f64) -> Option<f64> {
    format!("{number:.3e}").parse().ok()
}

/// The brightness that a share of the area does not exceed; `sorted` holds brightness and area.
fn percentile(sorted: &[(f64, f64, bool)], share: f64) -> Option<f64> {
    let whole: f64 = sorted.iter().map(|(_, area, _)| area).sum();
    let mut below = 0.0;
    let reached = sorted.iter().find(|(_, area, _)| {
        below += area;
        below >= share * whole
    });
    reached.or(sorted.last()).map(|(brightness, ..)| *brightness)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intensity_starts_at_zero_rises_and_never_passes_one() {
        let exposure = Exposure::new(2.0).unwrap();
        let grey = |radiosity: f64| exposure.intensity([radiosity; 3]);
        assert_eq!((grey(0.0), grey(1e300)), ([0.0; 3], [1.0; 3]));
        assert!((grey(std::f64::consts::LN_2 / 2.0)[0] - 0.5).abs() < 1e-15);
        assert_eq!(grey(-1.0), [0.0; 3]);
    }

    #[test]
    fn colours_keep_their_shares_however_bright_they_are() {
        let exposure = Exposure::new(1.0).unwrap();
        for height in [1e-6, 1.0, 1e3] {
            let [red, green, blue] = exposure.intensity([4.0 * height, 2.0 * height, -height]);
            assert!((green / red - 0.5).abs() < 1e-15 && blue == 0.0 && red <= 1.0, "{height}");
        }
    }

    #[test]
    fn faint_light_and_lamps_do_not_change_an_exposure() {
        let wall = |brightness: f64| ([brightness; 3], 1.0, false);
        let walls = || (1..=99).map(|step| wall(f64::from(step)));
        let plain = Exposure::of(walls());
        assert!((plain.intensity([50.0; 3])[0] - 0.306).abs() < 0.01, "the 95th percentile holds it at 0.5");
        let lamp = std::iter::once(([1e6; 3], 50.0, true));
        assert_eq!(Exposure::of(walls().chain(lamp)), plain);
        // Four fifths of the picture is a dark room; what is lit is not burnt out.
        let dim = Exposure::of(walls().chain((0..400).map(|_| wall(1e-17))));
        assert!(dim.intensity([95.0; 3])[0] < 0.95, "{}", dim.k());
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
