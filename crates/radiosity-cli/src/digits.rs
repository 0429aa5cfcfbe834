//! Numbers for people.

/// The digits that a number of a file has: those of single precision where it came from there, and no more than tell it apart.
#[allow(clippy::cast_possible_truncation, reason = "compared with what it was")]
pub(crate) fn own_digits(number: f64) -> String {
    let single = number as f32;
    if f64::from(single) == number { (single + 0.0).to_string() } else { number.to_string() }
}

/// As C's `%g`: six digits without trailing zeros, with an exponent below 1e-4 and from 1e6 on.
pub(crate) fn six_digits(number: f64) -> String {
    let scientific = format!("{number:.5e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or_default();
    let trimmed = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    match usize::try_from(5 - exponent) {
        Ok(decimals) if exponent >= -4 => trimmed(&format!("{number:.decimals$}")),
        _ => format!("{}e{exponent:+03}", trimmed(digits)),
    }
}

#[cfg(test)]
mod tests {
    use super::{own_digits, six_digits};

    #[test]
    fn six_digits_are_those_of_c() {
        let cases = [
            (6.25, "6.25"),
            (0.432_897_4, "0.432897"),
            (1.0, "1"),
            (0.0, "0"),
            (123_456.7, "123457"),
            (999_999.7, "1e+06"),
            (1_234_567.0, "1.23457e+06"),
            (0.000_123_456_78, "0.000123457"),
            (0.000_012_3, "1.23e-05"),
            (1e-105, "1e-105"),
        ];
        for (number, text) in cases {
            assert_eq!(six_digits(number), text);
        }
    }

    #[test]
    fn a_number_has_the_digits_of_its_file() {
        let single = |number: f32| f64::from(number);
        for (number, text) in [
            (single(0.1), "0.1"),
            (0.1, "0.1"),
            (single(-2.6), "-2.6"),
            (549.6, "549.6"),
            (0.1 + 0.2, "0.30000000000000004"),
            (-0.0, "0"),
            (2.0, "2"),
        ] {
            assert_eq!(own_digits(number), text);
        }
    }
}
