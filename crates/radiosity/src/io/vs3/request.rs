//! What a file asks of a program beside its geometry.
use super::fields::Fields;
use crate::io::error::{Fault, Wrong};
use crate::scene::finding::Finding;

/// What a `.vs3` file asks of a program that computes view factors, beside its geometry.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Request {
    /// `encl=1`: the surfaces enclose a volume, so that the rows are to add to 1.
    pub closes: bool,
    /// `emit=1`: total exchange factors of gray surfaces, with all reflections.
    pub emittances: bool,
    /// Per surface of the file, counted from 0, the surface that it is one with in the results: itself, or the one that `cmb`
    /// names. Nothing for null surfaces and obstructions, which have no row.
    pub combined: Vec<Option<usize>>,
}

/// What a control line may say, and what becomes of it.
const READ_ELSEWHERE: [&str; 7] = ["eps", "epsu", "epso", "maxu", "maxo", "mino", "list"];

impl Request {
    /// Reads a control line, `name=value` by `name=value`.
    pub(super) fn read(&mut self, fields: &Fields<'_>, warnings: &mut Vec<Finding>) -> Result<(), Wrong> {
        let text = fields.words[1..].join(" ").replace('=', " ");
        let words: Vec<&str> = text.split_whitespace().collect();
        for pair in words.chunks(2) {
            let name = pair[0].to_ascii_lowercase();
            let value = pair.get(1).ok_or((fields.line, Fault::Count { found: 1, wanted: 2 }))?;
            let is_asked = || {
                let number = value.parse::<i64>().map(|number| number != 0);
                number.map_err(|_| (fields.line, Fault::Whole(value.chars().take(40).collect())))
            };
            match name.as_str() {
                "encl" => self.closes = is_asked()?,
                "emit" => self.emittances = is_asked()?,
                known if READ_ELSEWHERE.contains(&known) => {}
                _ if !is_asked().unwrap_or(true) => {}
                _ => warnings.push(Finding::of_file(
                    format!("line {}: {name}={value} is not done", fields.line),
                    "leave it out; rows, columns and formats are options of `radiosity factors`",
                )),
            }
        }
        Ok(())
    }
}
