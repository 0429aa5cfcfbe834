//! The words of a line.
use crate::io::error::{Fault, Wrong};

/// A line that says something.
#[derive(Clone, Debug)]
pub(super) struct Fields<'l> {
    pub(super) line: usize,
    pub(super) words: Vec<&'l str>,
}

impl<'l> Fields<'l> {
    /// The lines that say something; none behind the one that ends the data.
    pub(super) fn lines(text: &'l str) -> Vec<Fields<'l>> {
        let is_between = |c: char| c.is_whitespace() || c == ',';
        let words = |line: &'l str| line.split(is_between).filter(|word| !word.is_empty()).collect();
        let lines = text.lines().zip(1..).map(|(text, line)| Fields { line, words: words(text) });
        let said = lines.filter(|fields| !fields.words.is_empty());
        said.take_while(|fields| !fields.words[0].starts_with(['E', 'e', '*'])).collect()
    }

    /// The first letter, which says what the line is.
    pub(super) fn letter(&self) -> char {
        self.words[0].chars().next().unwrap_or_default().to_ascii_uppercase()
    }

    pub(super) fn word(&self, at: usize) -> Result<&'l str, Wrong> {
        let found = self.words.get(at).copied();
        found.ok_or((self.line, Fault::Count { found: self.words.len(), wanted: at + 1 }))
    }

    pub(super) fn number(&self, at: usize) -> Result<f64, Wrong> {
        let word = self.word(at)?;
        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| (self.line, Fault::Number(word.chars().take(40).collect())))
    }

    pub(super) fn whole(&self, at: usize) -> Result<usize, Wrong> {
        let word = self.word(at)?;
        word.parse().map_err(|_| (self.line, Fault::Whole(word.chars().take(40).collect())))
    }

    /// Vertices and surfaces are numbered from 1, in order.
    pub(super) fn numbered(&self, expected: usize) -> Result<(), Wrong> {
        match self.whole(1)? {
            number if number == expected => Ok(()),
            number => Err((
                self.line,
                Fault::Word { found: number.to_string(), wanted: "the next number in sequence" },
            )),
        }
    }
}
