//! Logarithmic axes: decades, and how they are written.

/// Decades between two powers of ten, to a range of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    /// The decades at the ends.
    low: f64,
    high: f64,
    /// The pixels there.
    from: f64,
    to: f64,
}

impl Axis {
    /// Over all positive values, ends on whole decades; at least one decade.
    pub(crate) fn over(values: impl Iterator<Item = f64>, [from, to]: [f64; 2]) -> Axis {
        let logs = values.filter(|value| *value > 0.0 && value.is_finite()).map(f64::log10);
        let ends = logs.map(|log| [log, log]).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        let [low, high] = ends.unwrap_or([0.0, 1.0]);
        let low = (low + 1e-9).floor();
        Axis { low, high: (high - 1e-9).ceil().max(low + 1.0), from, to }
    }

    /// The pixel of a value; what is outside, and 0, stands at the nearer end.
    pub(crate) fn place(&self, value: f64) -> f64 {
        let log = if value > 0.0 { value.log10() } else { self.low };
        let share = (log.clamp(self.low, self.high) - self.low) / (self.high - self.low);
        self.from + share * (self.to - self.from)
    }

    /// The decades to be named, at steps of 1, 2, 3, 5, 10, … so that there is room for `most`.
    pub(crate) fn ticks(&self, most: usize) -> Vec<i32> {
        #[allow(clippy::cast_possible_truncation, reason = "decades of doubles")]
        let [low, high] = [self.low as i32, self.high as i32];
        let count = |step: i32| (low..=high).filter(|k| k.rem_euclid(step) == 0).count();
        let steps = [1, 2, 3, 5, 10, 20, 50, 100];
        let step = steps.into_iter().find(|step| count(*step) <= most).unwrap_or(200);
        (low..=high).filter(|k| k.rem_euclid(step) == 0).collect()
    }
}

/// 10⁻³ and the like.
pub(crate) fn power(exponent: i32) -> String {
    let raised = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        other => char::from_u32(0x2070 + other.to_digit(10).unwrap_or(0)).unwrap_or(other),
    };
    match exponent {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        _ => format!("10{}", exponent.to_string().chars().map(raised).collect::<String>()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_whole_decades_and_places_are_even_in_logarithms() {
        let axis = Axis::over([2e-3, 0.5].into_iter(), [100.0, 400.0]);
        assert_eq!((axis.low, axis.high), (-3.0, 0.0));
        assert_eq!(axis.place(1e-3), 100.0);
        assert!((axis.place(1e-2) - 200.0).abs() < 1e-9);
        assert_eq!((axis.place(0.0), axis.place(1e9)), (100.0, 400.0));
        assert_eq!(axis.ticks(9), [-3, -2, -1, 0]);
    }

    #[test]
    fn wide_axes_name_few_decades() {
        for (decades, most) in [1, 5, 12, 24, 48, 300].into_iter().flat_map(|k| [(k, 7), (k, 9)]) {
            let axis = Axis::over([10f64.powi(-decades), 1.0].into_iter(), [0.0, 1.0]);
            let ticks = axis.ticks(most);
            assert!((2..=most).contains(&ticks.len()), "{decades}: {ticks:?}");
        }
        assert!(Axis::over([1.0].into_iter(), [0.0, 1.0]).ticks(9).len() == 2);
        assert!(Axis::over([].into_iter(), [0.0, 1.0]).ticks(9).len() == 2);
    }

    #[test]
    fn powers_are_raised() {
        assert_eq!([-12, 0, 1, 2, 40].map(power), ["10⁻¹²", "1", "10", "10²", "10⁴⁰"]);
    }
}
