//! The sources' scenes, as code: each is built as a list of named faces, which becomes a COLLADA text.
mod cornell_box;
mod text;

use glam::DVec3;

type Builder = fn() -> Model;

/// Every scene's name and what builds it.
const SCENES: [(&str, Builder); 1] = [("cornell-box", cornell_box::cornell_box)];

/// The names that [`write_scene`] knows.
pub fn names() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|(name, _)| *name)
}

/// The scene of that name as COLLADA 1.4 text, always the same bytes; `None` for a name that is not one of [`names`].
#[must_use]
pub fn write_scene(name: &str) -> Option<String> {
    let (_, model) = SCENES.iter().find(|(known, _)| *known == name)?;
    Some(text::text(&model()))
}

/// A scene before it becomes a file.
struct Model {
    /// What it is and where its numbers come from.
    title: &'static str,
    /// `X_UP`, `Y_UP` or `Z_UP`.
    up_axis: &'static str,
    /// The unit's name and its length in metres.
    unit: (&'static str, f64),
    materials: Vec<Material>,
    faces: Vec<Face>,
    view: View,
}

struct Material {
    name: &'static str,
    reflectance: [f64; 3],
    /// Radiance.
    emission: [f64; 3],
}

/// A node: polygons of one material, each an outline, counter-clockwise seen from the front, with its holes.
struct Face {
    name: String,
    material: &'static str,
    polygons: Vec<Vec<Vec<DVec3>>>,
}

/// A camera, its vertical field of view in degrees.
struct View {
    eye: DVec3,
    interest: DVec3,
    up: DVec3,
    degrees: f64,
    aspect: f64,
}
