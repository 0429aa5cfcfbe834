//! Angles and candela as both formats have them.
use crate::io::error::Fault;
use crate::scene::photometry::{Photometry, Symmetry};

/// A fault, and the line of it.
pub(super) type LineFault = (usize, Fault);

/// A number of a file, and its line.
pub(super) type Number = (usize, f64);

/// No luminaire has more candela.
const MOST: f64 = 1e30;

/// The table of angles in degrees, and the candela of each half-plane, each times a factor.
pub(super) fn table(
    heights: &[Number],
    azimuths: &[Number],
    candela: &[Number],
    factor: f64,
    symmetry: Symmetry,
) -> Result<Photometry, LineFault> {
    ascending(heights, 180.0)?;
    ascending(azimuths, 360.0)?;
    if let Some(&(line, value)) = candela.iter().find(|(_, value)| *value < 0.0) {
        return Err((line, Fault::Negative { what: "intensity", value }));
    }
    let beyond = |number: &&Number| number.1 * factor > MOST || !(number.1 * factor).is_finite();
    if let Some((line, _)) = candela.iter().find(beyond) {
        return Err((*line, Fault::Huge("the intensity")));
    }
    let radians =
        |numbers: &[Number]| numbers.iter().map(|number| number.1.to_radians()).collect::<Vec<f64>>();
    let rows =
        candela.chunks_exact(heights.len()).map(|rows| rows.iter().map(|number| number.1 * factor).collect());
    let planes = radians(azimuths).into_iter().zip(rows).collect();
    Ok(Photometry::new(radians(heights), planes, symmetry))
}

/// Refuses angles that do not ascend from 0 or more to `last` or less.
fn ascending(angles: &[Number], last: f64) -> Result<(), LineFault> {
    let wrong = |number: &Number| {
        Err((number.0, Fault::Word { found: number.1.to_string(), wanted: "an ascending angle" }))
    };
    if let Some(number) = angles.iter().find(|number| !(0.0..=last).contains(&number.1)) {
        return wrong(number);
    }
    match angles.windows(2).find(|pair| pair[1].1 <= pair[0].1) {
        Some(pair) => wrong(&pair[1]),
        None => Ok(()),
    }
}

/// A finite number.
pub(super) fn number(line: usize, word: &str) -> Result<f64, LineFault> {
    // Some exporters write decimal commas.
    let number = word.trim().replace(',', ".").parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| (line, Fault::Number(word.chars().take(40).collect())))
}

/// A count of 1 or more.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number from 1 on")]
pub(super) fn count((line, number): Number) -> Result<usize, LineFault> {
    let is_whole = number >= 1.0 && number.fract() == 0.0 && number <= 1e6;
    if is_whole { Ok(number as usize) } else { Err((line, Fault::Whole(number.to_string()))) }
}
