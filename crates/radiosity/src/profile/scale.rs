//! Axes with round numbers.

/// How many numbers an axis has room for.
const MOST: f64 = 8.0;
/// Steps of these numbers, times a power of ten.
const ROUND: [f64; 4] = [1.0, 2.0, 5.0, 10.0];

/// From 0 to some value, to a range of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    high: f64,
    step: f64,
    pixels: [f64; 2],
}

impl Scale {
    /// From 0 to a value, or to the next round number above it.
    pub(super) fn to(value: f64, pixels: [f64; 2], is_round: bool) -> Scale {
        let value = if value > 0.0 && value.is_finite() { value } else { 1.0 };
        let power = 10f64.powf((value / MOST).log10().floor());
        let step = ROUND.map(|round| round * power).into_iter().find(|step| value / step <= MOST);
        let step = step.unwrap_or(value);
        let high = if is_round { (value / step - 1e-9).ceil() * step } else { value };
        Scale { high, step, pixels }
    }

    pub(super) fn place(&self, value: f64) -> f64 {
        self.pixels[0] + value / self.high * (self.pixels[1] - self.pixels[0])
    }

    /// The round numbers, and how they are written.
    pub(super) fn ticks(&self) -> impl Iterator<Item = (f64, String)> {
        let step = self.step;
        let count = (self.high / step + 1e-9).floor();
        let numbers = (0..=8).map(f64::from).take_while(move |k| *k <= count);
        numbers.map(move |k| (k * step, written(k * step, step)))
    }
}

/// With as many digits as the step needs.
fn written(value: f64, step: f64) -> String {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 4")]
    let digits = (-step.log10().floor()).clamp(0.0, 4.0) as usize;
    match step {
        _ if value == 0.0 => "0".to_owned(),
        step if (1e-4..1e6).contains(&step) => format!("{value:.digits$}"),
        _ => format!("{value:.1e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_round_few_and_cover_the_value() {
        for value in [1.0, 0.37, 8.1, 123.0, 5.5e-7, 9.9e12, 556.0] {
            let scale = Scale::to(value, [0.0, 100.0], true);
            let ticks: Vec<f64> = scale.ticks().map(|(tick, _)| tick).collect();
            assert!((2..=9).contains(&ticks.len()), "{value}: {ticks:?}");
            assert!(ticks[ticks.len() - 1] >= value * (1.0 - 1e-9), "{value}: {ticks:?}");
            let mut texts: Vec<String> = scale.ticks().map(|(_, text)| text).collect();
            texts.dedup();
            assert_eq!(texts.len(), ticks.len(), "{texts:?}");
        }
        let names: Vec<String> = Scale::to(0.37, [0.0, 1.0], true).ticks().map(|(_, text)| text).collect();
        assert_eq!(names, ["0", "0.05", "0.10", "0.15", "0.20", "0.25", "0.30", "0.35", "0.40"]);
        assert_eq!(Scale::to(0.0, [0.0, 10.0], false).place(0.5), 5.0);
    }
}
