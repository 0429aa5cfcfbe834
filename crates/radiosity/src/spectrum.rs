//! From bands to the colours that a screen shows.

/// What each band adds to red, green and blue.
#[derive(Clone, Debug)]
pub(crate) struct Colours(Vec<[f64; 3]>);

impl Colours {
    /// Of bands around these wavelengths in nm, each counted by its width: what a standard observer sees of them, as red,
    /// green and blue of sRGB's primaries, balanced so that a flat spectrum is a grey of its own height.
    ///
    /// Without wavelengths, or where these are not seen in all three colours, the first three bands are red, green and
    /// blue; of fewer, the last is repeated.
    pub(crate) fn of(bands: usize, wavelengths: &[f64]) -> Colours {
        let shares: Vec<[f64; 3]> = (0..wavelengths.len())
            .map(|band| primaries(observer(wavelengths[band])).map(|share| share * width(wavelengths, band)))
            .collect();
        let sums: [f64; 3] = std::array::from_fn(|colour| shares.iter().map(|share| share[colour]).sum());
        if shares.len() == bands && sums.iter().all(|sum| *sum > 0.0) {
            let balanced = |share: [f64; 3]| std::array::from_fn(|colour| share[colour] / sums[colour]);
            return Colours(shares.into_iter().map(balanced).collect());
        }
        let plain = |band| std::array::from_fn(|colour: usize| f64::from(colour.min(bands - 1) == band));
        Colours((0..bands).map(plain).collect())
    }

    /// Red, green and blue of values that stand band by band; of light whose colour no screen can show, parts are
    /// negative.
    pub(crate) fn rows(&self, values: &[f64]) -> Vec<[f64; 3]> {
        values.chunks(self.0.len().max(1)).map(|row| self.row(row)).collect()
    }

    /// The same of one row.
    pub(crate) fn row(&self, values: &[f64]) -> [f64; 3] {
        let add = |sum: [f64; 3], (value, share): (&f64, &[f64; 3])| -> [f64; 3] {
            std::array::from_fn(|colour| sum[colour] + share[colour] * value)
        };
        values.iter().zip(&self.0).fold([0.0; 3], add)
    }

    /// The shares of each band.
    pub(crate) fn shares(&self) -> &[[f64; 3]] {
        &self.0
    }
}

/// Half of the way to the neighbours on both sides; 1 for a band without any.
fn width(wavelengths: &[f64], band: usize) -> f64 {
    let (before, after) = (band.saturating_sub(1), (band + 1).min(wavelengths.len() - 1));
    if before == after {
        1.0
    } else {
        (wavelengths[after] - wavelengths[before]).abs() / (after - before) as f64
    }
}

/// The CIE 1931 standard observer's x, y and z at a wavelength in nm, by the sums of Gaussian lobes of Wyman, Sloan and
/// Shirley (2013), within 1 % of the largest.
fn observer(nm: f64) -> [f64; 3] {
    let lobe = |height: f64, middle: f64, below: f64, above: f64| {
        let off = (nm - middle) * if nm < middle { below } else { above };
        height * (-0.5 * off * off).exp()
    };
    [
        lobe(0.362, 442.0, 0.0624, 0.0374) + lobe(1.056, 599.8, 0.0264, 0.0323)
            - lobe(0.065, 501.1, 0.0490, 0.0382),
        lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
        lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725),
    ]
}

/// How bright light of a wavelength in nm is to the eye: 1 at the peak.
pub(crate) fn eye(nm: f64) -> f64 {
    observer(nm)[1]
}

/// Linear sRGB of x, y and z (IEC 61966-2-1).
fn primaries([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.2406 * x - 1.5372 * y - 0.4986 * z,
        -0.9689 * x + 1.8758 * y + 0.0415 * z,
        0.0557 * x - 0.2040 * y + 1.0570 * z,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 400, 404, … 700 nm.
    fn visible() -> Vec<f64> {
        (0..76).map(|band| 400.0 + 4.0 * f64::from(band)).collect()
    }

    #[test]
    fn the_observer_is_the_published_one() {
        // CIE 1931, 2 degrees, as tabulated.
        for (nm, [x, y, z]) in [
            (450.0, [0.3362, 0.0380, 1.7721]),
            (520.0, [0.0633, 0.7100, 0.0783]),
            (555.0, [0.5121, 1.0000, 0.0057]),
            (600.0, [1.0622, 0.6310, 0.0008]),
        ] {
            for (found, tabulated) in observer(nm).into_iter().zip([x, y, z]) {
                assert!((found - tabulated).abs() < 0.03, "{found} {tabulated} at {nm}");
            }
        }
        let seen: f64 = (360..=830).map(|nm| observer(f64::from(nm))[1]).sum();
        assert!((seen / 106.857 - 1.0).abs() < 0.01, "{seen}");
    }

    #[test]
    fn a_flat_spectrum_is_grey_and_a_narrow_one_has_its_colour() {
        let colours = Colours::of(76, &visible());
        for band in colours.row(&[0.7; 76]) {
            assert!((band - 0.7).abs() < 1e-12);
        }
        let line =
            |nm: f64| colours.row(&visible().iter().map(|at| f64::from(*at == nm)).collect::<Vec<_>>());
        let [red, green, blue] = [line(620.0), line(540.0), line(452.0)];
        assert!(red[0] > red[1] && red[0] > red[2] && green[1] > green[0] && green[1] > green[2]);
        assert!(blue[2] > blue[0] && blue[2] > blue[1]);
    }

    #[test]
    fn how_finely_a_spectrum_is_cut_does_not_matter() {
        let fine: Vec<f64> = (0..301).map(|band| 400.0 + f64::from(band)).collect();
        let rise = |nm: &f64| nm / 400.0 - 1.0;
        let row = |wavelengths: &[f64]| {
            Colours::of(wavelengths.len(), wavelengths).row(&wavelengths.iter().map(rise).collect::<Vec<_>>())
        };
        for (a, b) in row(&fine).into_iter().zip(row(&visible())) {
            assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
        }
    }

    #[test]
    fn what_is_not_light_is_shown_band_by_band() {
        assert_eq!(Colours::of(4, &[]).row(&[1.0, 2.0, 3.0, 4.0]), [1.0, 2.0, 3.0]);
        assert_eq!(Colours::of(2, &[9000.0, 10_000.0]).row(&[1.0, 2.0]), [1.0, 2.0, 2.0]);
    }
}
