//! What a file says that changes its light or its look and is not read.
use super::file::{File, XmlNode, child};
use crate::scene::finding::Finding;

/// Notes each feature, with every place.
pub(super) fn tell(file: &File<'_>, warnings: &mut Vec<Finding>) {
    for element in file.root.descendants() {
        if let Some((what, repair)) = feature(element) {
            Finding::note(warnings, file.place(element), what, repair);
        }
    }
}

/// What an element is that is not read, and what to do about it.
fn feature(element: XmlNode<'_>) -> Option<(&'static str, &'static str)> {
    match element.tag_name().name() {
        "channel" => Some((
            "animations are left out; everything stands where its node is",
            "export the moment that you want",
        )),
        "input" if element.attribute("semantic") == Some("COLOR") => {
            Some(("vertex colours are left out; the material's colour is taken", "give it a texture"))
        }
        "reflectivity" if number(element).is_some_and(|share| share > 0.0) => {
            Some(("shine is left out; surfaces reflect diffusely", "check that the light is what you mean"))
        }
        "transparent" | "transparency" if is_clear(element) => Some((
            "transparency is left out; the surface is opaque",
            "remove surfaces that should let light through",
        )),
        "bump" => Some(("bumps are left out", "make them geometry where they matter")),
        _ => None,
    }
}

/// The number in a shader's slot.
fn number(slot: XmlNode<'_>) -> Option<f64> {
    child(slot, "float")?.text()?.trim().parse().ok()
}

/// Programs do not agree whether 0 or 1 is opaque: what lies between, or a picture, is neither.
fn is_clear(slot: XmlNode<'_>) -> bool {
    child(slot, "texture").is_some() || number(slot).is_some_and(|share| share > 0.0 && share < 1.0)
}
