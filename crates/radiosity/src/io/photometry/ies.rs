//! IES LM-63.
//!
//! ```text
//! IESNA:LM-63-2002                                  the edition; the first one has no such line
//! [TEST] …                                          labels, as many as there are
//! TILT=NONE                                         or INCLUDE, and four rows of numbers that a fixed lamp has no use for
//! lamps lumens multiplier γs Cs type unit w l h     γs and Cs are how many angles there are
//! ballast future watts
//! γ …   C …   cd …                                  all γ of the first C, then of the second, …
//! ```
use super::angles::{LineFault, Number, count, number, table};
use crate::io::error::Fault;
use crate::scene::photometry::{Photometry, Symmetry};

/// Photometry of type C, the only one that is read.
const TYPE_C: f64 = 1.0;

pub(super) fn parse(text: &str) -> Result<Photometry, LineFault> {
    let mut lines = text.lines().zip(1..);
    let last = text.lines().count();
    let missing = || (last, Fault::Word { found: "the end".into(), wanted: "TILT=NONE or TILT=INCLUDE" });
    let (tilt, line) = lines.find(|(line, _)| line.trim_start().starts_with("TILT")).ok_or_else(missing)?;
    let mut words = Words { numbers: words(lines)?.into_iter(), last };
    match tilt.split_once('=').map(|(_, kind)| kind.trim()) {
        Some("NONE") => {}
        Some("INCLUDE") => words.skip_tilt()?,
        other => {
            let found = other.unwrap_or(tilt).chars().take(40).collect();
            return Err((line, Fault::Word { found, wanted: "NONE or INCLUDE after TILT=" }));
        }
    }
    words.photometry()
}

/// All numbers that follow, with their lines.
fn words<'t>(lines: impl Iterator<Item = (&'t str, usize)>) -> Result<Vec<Number>, LineFault> {
    let is_gap = |c: char| c.is_whitespace() || c == ',';
    let each = lines.flat_map(|(text, line)| text.split(is_gap).map(move |word| (word, line)));
    each.filter(|(word, _)| !word.is_empty()).map(|(word, line)| Ok((line, number(line, word)?))).collect()
}

/// The numbers that are left.
struct Words {
    numbers: std::vec::IntoIter<Number>,
    /// The last line, for what is missing.
    last: usize,
}

impl Words {
    /// The next numbers.
    fn take(&mut self, wanted: usize) -> Result<Vec<Number>, LineFault> {
        let found = self.numbers.len();
        if found < wanted {
            return Err((self.last, Fault::Count { found, wanted }));
        }
        Ok(self.numbers.by_ref().take(wanted).collect())
    }

    fn skip_tilt(&mut self) -> Result<(), LineFault> {
        let head = self.take(2)?;
        let angles = count(head[1])?;
        self.take(2 * angles).map(drop)
    }

    fn photometry(&mut self) -> Result<Photometry, LineFault> {
        let head = self.take(13)?;
        let (multiplier, kind, ballast) = (head[2].1, head[5], head[10].1);
        if kind.1 != TYPE_C {
            return Err((
                kind.0,
                Fault::Word { found: kind.1.to_string(), wanted: "photometric type 1 (C)" },
            ));
        }
        let factor = multiplier * ballast;
        if factor < 0.0 {
            return Err((
                head[2].0,
                Fault::Negative { what: "product of multiplier and ballast", value: factor },
            ));
        }
        let [heights, azimuths] = [count(head[3])?, count(head[4])?];
        let (gammas, planes) = (self.take(heights)?, self.take(azimuths)?);
        let candela = self.take(heights.saturating_mul(azimuths))?;
        table(&gammas, &planes, &candela, factor, symmetry(&planes)?)
    }
}

/// How the planes go on, by where they start and end.
fn symmetry(planes: &[Number]) -> Result<Symmetry, LineFault> {
    let (first, last) = (planes[0], planes[planes.len() - 1]);
    match (first.1, last.1) {
        (0.0, end) if end > 180.0 || planes.len() == 1 => Ok(Symmetry::None),
        (0.0, 90.0) => Ok(Symmetry::Quarter),
        (0.0, 180.0) => Ok(Symmetry::Half),
        (90.0, 270.0) => Ok(Symmetry::Across),
        _ => {
            let found = format!("{} to {}", first.1, last.1);
            Err((
                first.0,
                Fault::Word { found, wanted: "0, 0 to 90, 0 to 180, 90 to 270 or 0 to 360 degrees" },
            ))
        }
    }
}
