//! Statements of OBJ and MTL files: words on a line, which a backslash at its end continues.
use crate::io::error::{Fault, Wrong};
use glam::{DVec2, DVec3};

/// The byte order mark.
const MARK: char = '\u{feff}';

/// A statement: a keyword and what follows it.
#[derive(Debug)]
pub(super) struct Statement<'t> {
    pub(super) line: usize,
    pub(super) keyword: &'t str,
    pub(super) words: Vec<&'t str>,
}

impl<'t> Statement<'t> {
    /// The statements of a text, without comments and the mark that Windows puts before UTF-8.
    pub(super) fn all(text: &'t str) -> impl Iterator<Item = Statement<'t>> {
        let mut lines = (1..).zip(text.trim_start_matches(MARK).lines());
        std::iter::from_fn(move || {
            let (line, first) = lines.next()?;
            let (mut words, mut goes_on) = words(first);
            while goes_on {
                let Some((_, next)) = lines.next() else { break };
                let (more, further) = self::words(next);
                words.extend(more);
                goes_on = further;
            }
            Some((line, words))
        })
        .filter(|(_, words)| !words.is_empty())
        .map(|(line, mut words)| Statement { line, keyword: words.remove(0), words })
    }

    /// All that follows, as a name: names may hold spaces.
    pub(super) fn name(&self) -> String {
        self.words.join(" ")
    }

    pub(super) fn number(&self, at: usize) -> Result<f64, Wrong> {
        let found = Fault::Count { found: self.words.len(), wanted: at + 1 };
        let word = self.words.get(at).ok_or((self.line, found))?;
        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| (self.line, Fault::Number(shortened(word))))
    }

    pub(super) fn vector(&self) -> Result<DVec3, Wrong> {
        Ok(DVec3::new(self.number(0)?, self.number(1)?, self.number(2)?))
    }

    /// A place in a picture; the second number may be missing.
    pub(super) fn place(&self) -> Result<DVec2, Wrong> {
        let v = if self.words.len() > 1 { self.number(1)? } else { 0.0 };
        Ok(DVec2::new(self.number(0)?, v))
    }
}

/// The words before a comment, and whether the next line goes on.
fn words(line: &str) -> (Vec<&str>, bool) {
    let (said, goes_on) = match line.trim_end().strip_suffix('\\') {
        Some(said) => (said, true),
        None => (line, false),
    };
    // Within a name, the sign is a letter.
    (said.split_whitespace().take_while(|word| !word.starts_with('#')).collect(), goes_on)
}

/// A hostile word may be as long as the file.
pub(super) fn shortened(word: &str) -> String {
    word.chars().take(40).collect()
}
