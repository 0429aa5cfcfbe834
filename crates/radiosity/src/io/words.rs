//! Lists and numbers as text.
use std::fmt::{Display, Write};

/// What files say they were made with.
pub(crate) const TOOL: &str = concat!("radiosity ", env!("CARGO_PKG_VERSION"));

/// The byte order mark that some programs put before UTF-8.
pub(super) const MARK: &[u8] = b"\xef\xbb\xbf";

/// Words with a space between them.
pub(crate) fn list(words: impl Iterator<Item = impl Display>) -> String {
    let mut text = String::new();
    for (index, word) in words.enumerate() {
        let gap = if index == 0 { "" } else { " " };
        // Writing to a string cannot fail.
        let _ = write!(text, "{gap}{word}");
    }
    text
}

/// The shortest decimal that reads back as the same number; −0 is written as 0.
pub(crate) fn decimal(number: &f64) -> String {
    let text = format!("{:?}", number + 0.0);
    text.strip_suffix(".0").map(Into::into).unwrap_or(text)
}
