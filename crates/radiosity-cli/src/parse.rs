//! Numbers on the command line.

/// A finite number above zero.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if number > 0.0 && number.is_finite() {
        Ok(number)
    } else {
        Err("give a finite number above 0".to_owned())
    }
}

/// A finite number of zero or more.
pub(crate) fn strength(text: &str) -> Result<f64, String> {
    let number: f64 = text.trim().parse().map_err(|_| format!("{text:?} is not a number"))?;
    if number >= 0.0 && number.is_finite() {
        Ok(number)
    } else {
        Err("give a finite number of 0 or more".to_owned())
    }
}

/// A share above zero, as a number or in percent.
pub(crate) fn share(text: &str) -> Result<f64, String> {
    match text.trim().strip_suffix('%') {
        Some(percent) => positive(percent.trim()).map(|number| number / 100.0),
        None => positive(text),
    }
}

/// A number of elements that fits in memory.
pub(crate) fn count(text: &str) -> Result<usize, String> {
    let number = text.parse().map_err(|_| "not a whole number".to_owned())?;
    if (1..=10_000_000).contains(&number) { Ok(number) } else { Err("give 1 to 10 000 000".to_owned()) }
}
