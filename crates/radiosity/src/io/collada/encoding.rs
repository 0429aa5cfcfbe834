//! Bytes to text: UTF-8, UTF-16 with or without a mark, and what the declaration names.
use crate::io::error::FileError;
use encoding_rs::{DecoderResult, Encoding, UTF_8, UTF_16BE, UTF_16LE};

/// The text of an XML file. What was not UTF-8 gets a declaration that says that it is now.
pub(super) fn text(name: &str, bytes: Vec<u8>) -> Result<String, FileError> {
    let encoding = encoding(&bytes);
    if encoding == UTF_8 {
        let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes).trim_ascii_start();
        if !start.is_empty() && !start.starts_with(b"<") {
            let reason = "it does not begin with <, so it is no XML";
            return Err(FileError::Garbled { file: name.into(), wanted: "COLLADA", reason });
        }
        return String::from_utf8(bytes).map_err(|wrong| {
            let (encoding, position) = (UTF_8.name().to_owned(), wrong.utf8_error().valid_up_to());
            FileError::Encoding { file: name.into(), encoding, position }
        });
    }
    decoded(encoding, &bytes).map(|text| declared_utf_8(&text)).map_err(|position| {
        let encoding = encoding.name().to_owned();
        FileError::Encoding { file: name.into(), encoding, position }
    })
}

/// By the mark at the start, by where the zeros of `<` stand, or by the declaration. One that says UTF-16 of bytes that are
/// none is wrong: it was written by a program that wrote UTF-8 afterwards.
fn encoding(bytes: &[u8]) -> &'static Encoding {
    let marked = Encoding::for_bom(bytes).map(|(encoding, _)| encoding);
    let shaped = match bytes {
        [b'<', 0, ..] => Some(UTF_16LE),
        [0, b'<', ..] => Some(UTF_16BE),
        _ => None,
    };
    let declared = || declared(bytes).filter(|encoding| *encoding != UTF_16LE && *encoding != UTF_16BE);
    marked.or(shaped).or_else(declared).unwrap_or(UTF_8)
}

/// What the XML declaration names.
fn declared(bytes: &[u8]) -> Option<&'static Encoding> {
    let bytes = bytes.trim_ascii_start();
    let end = bytes.iter().take(200).position(|byte| *byte == b'>')?;
    let declaration = std::str::from_utf8(bytes.get(..end)?).ok()?.strip_prefix("<?xml")?;
    let value = declaration.split_once("encoding")?.1.trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next().filter(|quote| matches!(quote, '"' | '\''))?;
    Encoding::for_label(value[1..].split(quote).next()?.as_bytes())
}

/// The text without its mark; where the bytes are wrong, the offset of the first of these.
fn decoded(encoding: &'static Encoding, bytes: &[u8]) -> Result<String, usize> {
    let mut decoder = encoding.new_decoder();
    let mut text = String::new();
    text.reserve(decoder.max_utf8_buffer_length_without_replacement(bytes.len()).unwrap_or_default());
    match decoder.decode_to_string_without_replacement(bytes, &mut text, true) {
        (DecoderResult::InputEmpty, _) => Ok(text),
        (DecoderResult::Malformed(wrong, behind), read) => {
            Err(read.saturating_sub(usize::from(wrong) + usize::from(behind)))
        }
        (DecoderResult::OutputFull, read) => Err(read),
    }
}

/// The text with a declaration of its own, on the same line as the old one.
fn declared_utf_8(text: &str) -> String {
    let body = match text.trim_start().strip_prefix("<?xml") {
        Some(rest) => rest.split_once("?>").map_or(rest, |(_, body)| body),
        None => text,
    };
    format!("<?xml version=\"1.0\" encoding=\"utf-8\"?>{body}")
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "<a b=\"ü 𝄞\"/>";

    fn utf_16(text: &str, mark: bool, order: fn(u16) -> [u8; 2]) -> Vec<u8> {
        let mark = mark.then_some(0xfeff);
        mark.into_iter().chain(text.encode_utf16()).flat_map(order).collect()
    }

    #[test]
    fn utf_16_is_read_with_and_without_a_mark() {
        let whole = format!("<?xml version=\"1.0\" encoding=\"utf-16\"?>\n{TEXT}");
        for order in [u16::to_le_bytes, u16::to_be_bytes] {
            for mark in [true, false] {
                let read = text("a.dae", utf_16(&whole, mark, order)).unwrap();
                assert_eq!(read, format!("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n{TEXT}"));
            }
        }
    }

    #[test]
    fn a_declaration_counts_unless_it_must_be_wrong() {
        let latin = b"<?xml version='1.0' encoding='ISO-8859-1'?><a b='\xfc'/>".to_vec();
        assert!(text("a.dae", latin).unwrap().ends_with("<a b='ü'/>"));
        let wrong = format!("<?xml version=\"1.0\" encoding=\"utf-16\"?>{TEXT}");
        assert_eq!(text("a.dae", wrong.clone().into_bytes()).unwrap(), wrong);
    }

    #[test]
    fn the_first_wrong_byte_is_told() {
        let mut bytes = utf_16("<a/>", true, u16::to_le_bytes);
        bytes.extend([0x00, 0xd8, b'<', 0]);
        let position = bytes.len() - 4;
        assert!(
            matches!(text("a.dae", bytes), Err(FileError::Encoding { position: found, .. }) if found == position)
        );
    }
}
