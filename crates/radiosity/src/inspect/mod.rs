//! What a scene is, and what about it will trouble a solution.
//!
//! ```text
//! surface      reflectances that cannot be, patches that are thinner than rounding
//! orientation  neighbours that face opposite ways
//! overlap      patches that cover each other in one plane, duplicates among them
//! junction     vertices that end in the middle of another patch's edge
//! openness     how much of the view from the patches leaves the scene
//! cost         how long the form factors will take
//! ```
//! Nothing is decided here that a solution depends on, so that nearness is judged by rounding: 64 roundings of the largest
//! coordinate, as in [`PlanarPolygon`](formfactor::PlanarPolygon).
mod cost;
mod junction;
mod openness;
mod orientation;
mod overlap;
mod surface;

pub use cost::Cost;
pub use openness::Opening;

pub(crate) use overlap::overlaps;

use crate::{Asset, Scene};
use serde::Serialize;

/// What a scene is.
#[derive(Clone, Debug, Serialize)]
pub struct Inspection {
    /// Number of patches.
    pub patches: usize,
    /// Number of vertices, those of each patch counted by themselves.
    pub vertices: usize,
    /// Number of bands.
    pub bands: usize,
    /// Number of cameras.
    pub cameras: usize,
    /// Area of all patches, in the file's unit squared.
    pub area: f64,
    /// Length of the file's unit in metres.
    pub unit: f64,
    /// The axis that points up.
    pub up: [f64; 3],
    /// The smallest and the largest coordinates.
    pub extent: [[f64; 3]; 2],
    /// The patches that emit.
    pub lamps: Vec<Lamp>,
    /// Whether no light can leave: no opening is wider than rounding.
    pub closed: bool,
    /// The widest opening.
    pub opening: Option<Opening>,
    /// What will trouble a solution.
    pub findings: Vec<Finding>,
    /// What the form factors will cost.
    pub cost: Cost,
}

/// A patch that emits.
#[derive(Clone, Debug, Serialize)]
pub struct Lamp {
    /// The patch's name.
    pub name: String,
    /// Emitted power per band, W in a file in metres: π L A.
    pub power: Vec<f64>,
}

/// Something that will trouble a solution.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// What kind of thing.
    pub kind: Kind,
    /// The patches concerned, by name.
    pub patches: Vec<String>,
    /// What it is, in a sentence.
    pub what: String,
    /// What to do about it.
    pub mend: String,
}

/// Kinds of findings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Kind {
    /// Something that the reader found odd: non-planar polygons, ones without area, what is not read.
    File,
    /// No patch emits.
    Dark,
    /// A reflectance of 1 or more, or below 0.
    Reflectance,
    /// Two neighbours that face opposite ways.
    Flipped,
    /// Two patches of the same outline that face the same way.
    Duplicate,
    /// Two patches that face the same way and cover each other in part, in one plane.
    Overlap,
    /// A lamp that lies in a larger patch.
    LampInFace,
    /// A vertex that ends in the middle of another patch's edge.
    TJunction,
    /// A patch so thin that its coordinates' rounding is a share of its width.
    Sliver,
}

/// Looks at a scene. O(n log n) where patches are spread out, plus one row of form factors from each of up to 256
/// patches.
#[must_use]
pub fn inspect(scene: &Scene) -> Inspection {
    let findings = [
        surface::findings(scene),
        orientation::findings(scene),
        overlap::findings(scene),
        junction::findings(scene),
    ];
    let (opening, cost) = openness::openness(scene);
    let Asset { up, unit } = scene.asset;
    Inspection {
        patches: scene.patches.len(),
        vertices: scene.patches.iter().map(|patch| patch.polygon.loops().flatten().count()).sum(),
        bands: scene.bands,
        cameras: scene.cameras.len(),
        area: scene.patches.iter().map(|patch| patch.polygon.area()).sum(),
        unit,
        up: up.to_array(),
        extent: scene.extent().map(|corner| corner.to_array()),
        lamps: lamps(scene),
        closed: opening.as_ref().is_some_and(Opening::is_none),
        opening,
        findings: findings.into_iter().flatten().collect(),
        cost,
    }
}

fn lamps(scene: &Scene) -> Vec<Lamp> {
    let power = |patch: &crate::Patch| {
        let area = patch.polygon.area();
        patch.emission.iter().map(|radiance| std::f64::consts::PI * radiance * area).collect()
    };
    let lit = scene.patches.iter().filter(|patch| patch.emits());
    lit.map(|patch| Lamp { name: patch.name.clone(), power: power(patch) }).collect()
}
