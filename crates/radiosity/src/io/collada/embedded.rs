//! The file with the pictures that it names in itself, so that it can stand in another folder.
use super::file::{File, child};
use super::images::hex;
use super::splice::{Edit, spliced};
use crate::image_file;
use std::path::Path;

/// The text with its pictures in it, as the file's version has it; what cannot be read stays where it is.
pub(super) fn embedded(text: &str, file: &File<'_>, folder: Option<&Path>) -> String {
    let mut edits: Vec<Edit> = Vec::new();
    for image in file.root.descendants().filter(|node| node.tag_name().name() == "image") {
        let Some(from) = child(image, "init_from") else { continue };
        let named = child(from, "ref");
        let address = named.unwrap_or(from).text().unwrap_or_default().trim();
        let Some(bytes) = image_file::beside(address, folder) else { continue };
        let digits = hex(&bytes);
        let data = match named {
            Some(_) => format!("<init_from><hex format=\"{}\">{digits}</hex></init_from>", kind(&bytes)),
            None => format!("<data>{digits}</data>"),
        };
        edits.push((from.range(), data));
    }
    spliced(text, 0..text.len(), &edits)
}

fn kind(bytes: &[u8]) -> &'static str {
    if bytes.starts_with(b"\x89PNG") { "PNG" } else { "JPG" }
}
