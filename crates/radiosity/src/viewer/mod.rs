//! An HTML page that shows a solution: one file, plain WebGL 2, no network.
//!
//! ```text
//! page.html     what is on the page, and page.css how it looks
//! light.js      the light, and the mesh that it is on
//! surfaces.js   surfaces and what is shown of them
//! lines.js      lines over the surfaces
//! camera.js     who looks
//! draw.js       drawing, false colours, saving a picture
//! probe.js      what is under the pointer
//! pointers.js   mouse and touch
//! walk.js       a run, step by step
//! controls.js   keys and the panel
//! ```
use crate::expose::Exposure;
use crate::record::Record;

/// The page without its light.
const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// The parts of its program, in order.
const PROGRAM: [&str; 9] = [
    include_str!("light.js"),
    include_str!("surfaces.js"),
    include_str!("lines.js"),
    include_str!("camera.js"),
    include_str!("draw.js"),
    include_str!("probe.js"),
    include_str!("pointers.js"),
    include_str!("walk.js"),
    include_str!("controls.js"),
];

/// An HTML page of a solution, complete in one file.
///
/// The page shows patches, elements or interpolated light, radiosity and irradiance in false colours with a scale in W/m² or lx, the
/// wireframe, textures, the backs of faces, any exposure, and what is under the pointer: patch, element, radiosity, irradiance and
/// bound. It starts at the scene's first camera, goes to the others, and saves pictures. The view turns with the mouse or a finger,
/// shifts with the right button or two fingers, zooms with the wheel; keys do all of that, too, and the page lists them.
///
/// Lux are 179 times the W/m² of what looks as bright as a grey: the luminous efficacy of white light of equal energy.
#[must_use]
pub fn page(record: &Record, exposure: Exposure) -> String {
    let (shown, view) = (record.shown(), record.camera(None));
    let light =
        serde_json::json!({"k": exposure.k(), "shares": shown.shares(), "view": view, "record": record});
    // Within a script nothing may look like the end of one.
    let text = light.to_string().replace("</", "<\\/").replace("<!--", "<\\!--");
    let page = PAGE.replacen("/*STYLE*/", STYLE, 1).replacen("/*PROGRAM*/", &PROGRAM.join("\n"), 1);
    page.replacen("/*LIGHT*/null", &text, 1)
}
