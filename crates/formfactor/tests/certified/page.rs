//! The page `docs/certified.md`: written here, and read again.
use crate::key::{Key, Published, Setup};
use std::fmt::Write as _;

/// What the library says of a key.
pub(crate) struct Found {
    pub(crate) value: f64,
    /// A point's bound, an area's estimate.
    pub(crate) error: f64,
}

/// A row as it stands on the page.
#[derive(Debug, PartialEq)]
pub(crate) struct Row<'p> {
    pub(crate) name: &'p str,
    pub(crate) value: f64,
    pub(crate) error: f64,
    /// All that is no number of the library's.
    pub(crate) rest: Vec<&'p str>,
}

const HEAD: &str = "# Certified values\n\n\
Form factors of `formfactor` beside exact values and values of others. The tests in `crates/formfactor/tests/certified/` compute\n\
each row anew and compare it with its exact value, with the other value and with this page.\n\n\
± is the proven bound of a form factor from a point. From area to area it is an *estimate*; the tolerance asked for stands behind\n\
the derivation. *Derivation* says how the exact value comes about; rays are no derivation, and what they give is known within three\n\
of their standard errors only. *Other value* is what a paper or a program gives, as its source stands there; it counts as right when\n\
it is the exact value rounded to its digits, or one off in the last.\n\n\
The cases of CIE 171:2006 have its configurations; the other values there were recomputed for this project, as the tables of the\n\
standard were not at hand. That its Table 19 (case 5.7) is wrong is said by Ian Ashdown's errata\n\
(<https://lightinganalysts.com/cie-1712006-errata>). The polygonal verification cases of OpenViewFactor stand here by their\n\
configurations: squares in parallel, rectangles at right angles with a common side or 0.1 apart, and a plate that hides all.\n";

const COLUMNS: &str = "| configuration | value | ± | derivation | other value | its source |\n| --- | --- | --- | --- | --- | --- |\n";

pub(crate) fn write(parts: &[(&str, Vec<(&Key, Found)>)]) -> String {
    let mut text = HEAD.to_owned();
    for (title, rows) in parts {
        let _ = write!(text, "\n## {title}\n\n{COLUMNS}");
        for (key, found) in rows {
            text.push_str(&line(key, found));
        }
    }
    text
}

fn line(key: &Key, found: &Found) -> String {
    let (factor, unit) = key.unit;
    if found.value == 0.0 && found.error == 0.0 {
        return format!("| {} | 0 | 0 | {} |\n", key.name, rest(key).join(" | "));
    }
    let error = round_up((found.error * factor).max(f64::MIN_POSITIVE));
    // To the place of the error's only digit.
    let digits = (0..17).find(|d| 10.0_f64.powi(-d) <= error).unwrap_or(17);
    let digits = usize::try_from(digits).unwrap_or(0);
    let value = format!("{:.digits$}", found.value * factor);
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    format!("| {} | {value}{unit} | {error:e} | {} |\n", key.name, rest(key).join(" | "))
}

/// One digit, no less; nothing is said to be better than a double.
fn round_up(error: f64) -> f64 {
    let step = 10.0_f64.powf(error.max(1e-16).log10().floor());
    let digit = (error.max(1e-16) / step * (1.0 - 1e-9)).ceil();
    format!("{:.0e}", digit * step).parse().unwrap_or(error)
}

/// The columns after the numbers.
pub(crate) fn rest(key: &Key) -> Vec<String> {
    let asked = match key.setup {
        Setup::Point { .. } => key.derivation.to_owned(),
        Setup::Area { tolerance, .. } => format!("{} (asked: {tolerance:e})", key.derivation),
    };
    let (printed, source) = match key.published {
        None => (String::new(), String::new()),
        Some(Published { text, source, is_right: true }) => (text.to_owned(), source.to_owned()),
        Some(Published { text, source, is_right: false }) => (format!("{text}: wrong"), source.to_owned()),
    };
    vec![asked, printed, source]
}

/// All rows of a page.
pub(crate) fn read(text: &str) -> Vec<Row<'_>> {
    text.lines().filter_map(row).collect()
}

fn row(line: &str) -> Option<Row<'_>> {
    let mut cells = line.strip_prefix("| ")?.strip_suffix(" |")?.split(" | ").map(str::trim);
    let name = cells.next()?;
    let value = cells.next()?.split(' ').next()?.parse().ok()?;
    let error = cells.next()?.parse().ok()?;
    Some(Row { name, value, error, rest: cells.collect() })
}
