//! Built-in scenes from the literature. Each is built in code as a list of named faces, which becomes a COLLADA text.
//!
//! - The Cornell box as published: `cornell-box`, and `cornell-76` in the 76 bands of its spectra.
//! - Barreto (2008, chapter 4; coordinates are this project's, as the thesis prints none): `emission`, `obstruction`, `beams`,
//!   `small-occluders`, `perforated`, and `perforated-cut` with its panel cut into rectangles.
//! - Gomes (2010): `wall`, `chessboard`, `cornell-3842`.
//! - Scenes with a known answer: `furnace` (reflectance 0.5; `furnace-0.99` has another one), `cube`, `separating-wall`,
//!   `colour-bleeding`, `sphere-lamp`.
mod barreto;
mod cornell_76;
mod cornell_box;
mod gomes;
mod rooms;
mod shapes;

use crate::io::{collada::Collada, collada::compose::text, collada::model::Model};
use crate::scene::Scene;

type Builder = fn() -> Model;

/// Every scene's name and what builds it.
const SCENES: [(&str, Builder); 16] = [
    ("cornell-box", cornell_box::cornell_box),
    ("cornell-76", cornell_76::cornell_76),
    ("cornell-3842", gomes::cornell_3842),
    ("emission", barreto::emission),
    ("obstruction", barreto::obstruction),
    ("beams", barreto::beams),
    ("small-occluders", barreto::small_occluders),
    ("perforated", barreto::perforated),
    ("perforated-cut", barreto::perforated_cut),
    ("wall", gomes::wall),
    ("chessboard", gomes::chessboard),
    ("furnace", rooms::furnace),
    ("cube", rooms::cube),
    ("separating-wall", rooms::separating_wall),
    ("colour-bleeding", rooms::colour_bleeding),
    ("sphere-lamp", rooms::sphere_lamp),
];

/// The names of all built-in scenes.
pub fn names() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|(name, _)| *name)
}

/// A built-in scene as COLLADA 1.4 text, always the same bytes; `None` for a name that is not one of [`names`].
///
/// `furnace-R` is the furnace with reflectance R, from 0 to below 1.
#[must_use]
pub fn write_scene(name: &str) -> Option<String> {
    let known = SCENES.iter().find(|(known, _)| *known == name).map(|(_, build)| build());
    known.or_else(|| furnace(name)).map(|model| text(&model))
}

/// What a built-in scene is and where its numbers come from; `None` for a name that is not one of [`names`].
#[must_use]
pub fn title(name: &str) -> Option<String> {
    let known = SCENES.iter().find(|(known, _)| *known == name);
    known.map(|(_, build)| build().title)
}

/// A built-in scene; `None` for a name that is not one of [`names`].
///
/// ```
/// let scene = radiosity::scenes::scene("small-occluders").expect("a built-in scene");
/// assert_eq!(scene.patches.len(), 1 + 1 + 25);
/// ```
#[must_use]
pub fn scene(name: &str) -> Option<Scene> {
    let file = Collada::from_text(name, write_scene(name)?);
    Some(file.scene().expect("what is written here can be read"))
}

/// `furnace-0.999` and the like.
fn furnace(name: &str) -> Option<Model> {
    let reflectance: f64 = name.strip_prefix("furnace-")?.parse().ok()?;
    (0.0..1.0).contains(&reflectance).then(|| rooms::furnace_of(reflectance))
}
