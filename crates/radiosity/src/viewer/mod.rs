//! An HTML page that shows a solution: one file, plain WebGL 2, no network.
use crate::expose::Exposure;
use crate::record::Record;

/// The page without its light.
const PAGE: &str = include_str!("page.html");
/// What the light stands in for.
const PLACE: &str = "/*LIGHT*/null";

/// An HTML page of a solution, complete in one file.
///
/// The page shows patches, elements or interpolated light, the wireframe, textures, any exposure, and what is under the
/// pointer: patch, element, radiosity, irradiance and bound. The view starts at the scene's first camera. It turns with the mouse
/// or a finger, shifts with the right button or two fingers, zooms with the wheel, and moves with the keys w, a, s, d, q, e.
///
/// # Panics
/// Never: a record can always be written.
#[must_use]
pub fn page(record: &Record, exposure: Exposure) -> String {
    let light = serde_json::json!({"k": exposure.k(), "shares": record.shown().shares(), "record": record});
    // Within a script nothing may look like the end of one.
    let text = light.to_string().replace("</", "<\\/").replace("<!--", "<\\!--");
    PAGE.replacen(PLACE, &text, 1)
}
