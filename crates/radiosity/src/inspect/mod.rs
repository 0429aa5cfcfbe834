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
pub(crate) mod overlap;
mod surface;

pub use crate::scene::finding::{Finding, Kind};
pub use cost::Cost;
pub use openness::Opening;

use crate::scene::Scene;
use crate::scene::asset::Asset;
use crate::scene::patch::Patch;
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
    pub emitters: Vec<Emitter>,
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
pub struct Emitter {
    /// The patch's name.
    pub name: String,
    /// Emitted power per band, W in a file in metres: π L A.
    pub power: Vec<f64>,
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
        emitters: emitters(scene),
        closed: opening.as_ref().is_some_and(Opening::is_none),
        opening,
        findings: findings.into_iter().flatten().collect(),
        cost,
    }
}

fn emitters(scene: &Scene) -> Vec<Emitter> {
    let power = |patch: &Patch| {
        let area = patch.polygon.area();
        patch.emission.iter().map(|radiance| std::f64::consts::PI * radiance * area).collect()
    };
    let lit = scene.patches.iter().filter(|patch| patch.emits());
    lit.map(|patch| Emitter { name: patch.name.clone(), power: power(patch) }).collect()
}
