//! EULUMDAT.
//!
//! ```text
//! line 3  symmetry: 0 none, 1 around, 2 about C0-C180, 3 about C90-C270, 4 both
//!      4  half-planes Mc, 6 angles Ng      26  sets of lamps n; 29 of the first its flux
//! then, after n sets of six lines and ten ratios: Mc angles C, Ng angles γ, and cd per 1000 lm, half-plane by half-plane
//! ```
use super::angles::{LineFault, Number, count, number, table};
use crate::io::error::Fault;
use crate::scene::photometry::{Photometry, Symmetry};

/// Lines, from 0, of what is read of the head.
const SYMMETRY: usize = 2;
const PLANES: usize = 3;
const ANGLES: usize = 5;
const CONVERSION: usize = 23;
const SETS: usize = 25;
/// Lines of a set of lamps, and which of them is the flux.
const SET: usize = 6;
const FLUX: usize = 2;
/// Direct ratios of rooms, of which nothing is read.
const RATIOS: usize = 10;

pub(super) fn parse(text: &str) -> Result<Photometry, LineFault> {
    let lines = Lines(text.lines().collect());
    let (planes, angles) = (count(lines.at(PLANES)?)?, count(lines.at(ANGLES)?)?);
    let start = SETS + 1 + count(lines.at(SETS)?)?.saturating_mul(SET) + RATIOS;
    let (kept, symmetry) = stored(lines.at(SYMMETRY)?, planes)?;
    let azimuths = lines.range(start, planes)?;
    let gammas = lines.range(start + planes, angles)?;
    let candela = lines.range(start + planes + angles, kept.len().saturating_mul(angles))?;
    let (flux, conversion) = (lines.at(SETS + 1 + FLUX)?, lines.at(CONVERSION)?);
    let factor = flux.1 / 1000.0 * if conversion.1 > 0.0 { conversion.1 } else { 1.0 };
    if factor < 0.0 {
        return Err((flux.0, Fault::Negative { what: "flux", value: flux.1 }));
    }
    table(&gammas, &azimuths[kept], &candela, factor, symmetry)
}

/// Which of the half-planes stand in the file, and what the others are.
fn stored((line, number): Number, planes: usize) -> Result<(std::ops::Range<usize>, Symmetry), LineFault> {
    let known = [0.0, 1.0, 2.0, 3.0, 4.0].iter().position(|known| *known == number);
    match known {
        Some(0) => Ok((0..planes, Symmetry::None)),
        Some(1) => Ok((0..1, Symmetry::None)),
        Some(2) if planes % 2 == 0 => Ok((0..planes / 2 + 1, Symmetry::Half)),
        Some(3) if planes % 4 == 0 => Ok((planes / 4..3 * planes / 4 + 1, Symmetry::Across)),
        Some(4) if planes % 4 == 0 => Ok((0..planes / 4 + 1, Symmetry::Quarter)),
        _ => {
            let found = format!("{number} with {planes} half-planes");
            Err((line, Fault::Word { found, wanted: "a symmetry from 0 to 4 that divides the half-planes" }))
        }
    }
}

/// The lines of a file.
struct Lines<'t>(Vec<&'t str>);

impl Lines<'_> {
    /// The number on a line, counted from 0.
    fn at(&self, line: usize) -> Result<Number, LineFault> {
        let found = self.0.len();
        let text = self.0.get(line).ok_or((found, Fault::Count { found, wanted: line + 1 }))?;
        Ok((line + 1, number(line + 1, text)?))
    }

    /// The numbers on lines that follow each other.
    fn range(&self, start: usize, count: usize) -> Result<Vec<Number>, LineFault> {
        let (found, wanted) = (self.0.len(), start.saturating_add(count));
        if found < wanted {
            return Err((found, Fault::Count { found, wanted }));
        }
        (start..wanted).map(|line| self.at(line)).collect()
    }
}
