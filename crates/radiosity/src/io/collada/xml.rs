//! Lists, numbers and names as XML text.
use std::fmt::{Display, Write};

/// What files say they were made with.
pub(super) const TOOL: &str = concat!("radiosity ", env!("CARGO_PKG_VERSION"));

/// Words with a space between them.
pub(super) fn list(words: impl Iterator<Item = impl Display>) -> String {
    let mut text = String::new();
    for (index, word) in words.enumerate() {
        let gap = if index == 0 { "" } else { " " };
        // Writing to a string cannot fail.
        let _ = write!(text, "{gap}{word}");
    }
    text
}

/// The shortest decimal that reads back as the same number; −0 is written as 0.
pub(super) fn decimal(number: &f64) -> String {
    let text = format!("{:?}", number + 0.0);
    text.strip_suffix(".0").map(Into::into).unwrap_or(text)
}

/// Text that may stand in an attribute or between tags and reads back as it was; characters that XML 1.0 has not are
/// replaced.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // As they are they would be read as blanks.
            '\t' => escaped.push_str("&#9;"),
            '\n' => escaped.push_str("&#10;"),
            '\r' => escaped.push_str("&#13;"),
            '\0'..' ' | '\u{fffe}' | '\u{ffff}' => escaped.push(char::REPLACEMENT_CHARACTER),
            other => escaped.push(other),
        }
    }
    escaped
}
