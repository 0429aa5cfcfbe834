//! A description of a scene, and findings: what will trouble a solution.
//!
//! ```text
//! openness     how much of the view from the patches leaves the scene
//! cost         how long the form factors will take
//! overlap      patches that cover each other in one plane
//! orientation  neighbours that face opposite ways
//! surface      what the reader told, whether there is light, and what repair finds
//! summary      findings by kind: how many, and whether they matter
//! ```
//! A solution depends on nothing here, so a tolerance is good enough: 64 roundings of the largest coordinate, as in
//! [`PlanarPolygon`](formfactor::PlanarPolygon).
mod cost;
mod openness;
mod orientation;
mod overlap;
mod summary;
mod surface;

pub use crate::scene::finding::{Finding, Kind, in_one_line};
pub use cost::Cost;
pub use openness::Opening;
pub use overlap::coplanar_overlaps;
pub use summary::{KindSummary, summary};

use crate::scene::{Scene, asset::Asset, patch::Patch};
use serde::Serialize;
use std::sync::atomic::{AtomicBool, Ordering};

/// A description of a scene.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Inspection {
    /// Number of patches.
    pub patches: usize,
    /// Number of vertices, counted patch by patch.
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
    /// The patches that emit, and the lamps.
    pub emitters: Vec<Emitter>,
    /// Whether the scene is closed: no opening is wider than rounding.
    pub closed: bool,
    /// The widest opening.
    pub opening: Option<Opening>,
    /// The findings by kind, those first that trouble a solution most.
    pub summary: Vec<KindSummary>,
    /// What will trouble a solution, and how to repair it, in the order of the summary.
    pub findings: Vec<Finding>,
    /// The predicted cost of the form factors.
    pub cost: Cost,
    /// Whether it was stopped before all was looked at; see [`inspect_until`].
    #[serde(skip_serializing_if = "is_false")]
    pub stopped: bool,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_false(value: &bool) -> bool {
    !value
}

/// A patch that emits, or a lamp.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Emitter {
    /// Its name.
    pub name: String,
    /// Emitted power per band, of a patch πLA: in W where the unit is a metre.
    pub power: Vec<f64>,
}

/// Describes a scene and finds what will trouble a solution.
///
/// Takes O(n log n) for n patches that are spread out, and one row of form factors from each of up to 256 patches.
///
/// ```
/// use radiosity::{inspect::inspect, scenes};
///
/// let inspection = inspect(&scenes::scene("furnace").expect("a built-in scene"));
/// assert!(inspection.closed && inspection.findings.is_empty());
/// ```
#[must_use]
pub fn inspect(scene: &Scene) -> Inspection {
    inspect_until(scene, &|| false)
}

/// Describes a scene as [`inspect`] does, until `stop` says to stop: what was not looked at then is left out, and where the view from no patch
/// is known there is no opening. `stop` is asked between stages, in repair and, by any thread, between form factors.
#[must_use]
pub fn inspect_until(scene: &Scene, stop: &(dyn Fn() -> bool + Sync)) -> Inspection {
    let stopped = AtomicBool::new(false);
    let stop = &|| {
        let stops = stop();
        stopped.fetch_or(stops, Ordering::Relaxed);
        stops
    };
    let mut findings = surface::findings(scene, stop);
    if !stop() {
        findings.extend(orientation::findings(scene));
    }
    findings.sort_by_key(|finding| finding.kind);
    let (opening, cost) = openness::openness(scene, stop);
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
        summary: summary(&findings),
        findings,
        cost,
        stopped: stopped.into_inner(),
    }
}

fn emitters(scene: &Scene) -> Vec<Emitter> {
    let power = |patch: &Patch| {
        let area = patch.polygon.area();
        patch.emission.iter().map(|radiance| std::f64::consts::PI * radiance * area).collect()
    };
    let lit = scene.patches.iter().filter(|patch| patch.emits());
    let area = scene.asset.unit * scene.asset.unit;
    let lamps = scene.lamps.iter().map(|lamp| Emitter {
        name: lamp.name.clone(),
        power: lamp.power().into_iter().map(|power| power / area).collect(),
    });
    lit.map(|patch| Emitter { name: patch.name.clone(), power: power(patch) }).chain(lamps).collect()
}
