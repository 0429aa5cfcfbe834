//! What `--json` prints.
use radiosity::inspect::{Finding, KindSummary};
use radiosity::{Record, Scene, Solution, Transfers, Units};
use serde::Serialize;

/// The figures of a solution.
#[derive(Debug, Serialize)]
pub(crate) struct Figures<'s> {
    scene: &'s str,
    /// What was repaired while reading.
    repairs: &'s [KindSummary],
    elements: usize,
    shots: usize,
    products: usize,
    seconds: f64,
    bound: &'s [f64],
    closure: Option<f64>,
    scaling: Option<f64>,
    /// How light was taken between parts of patches, by levels.
    #[serde(skip_serializing_if = "Option::is_none")]
    transfers: Option<Transfers>,
    /// What powers are counted in: W or lm.
    units: &'static str,
    energy: Energy<'s>,
    /// What was left out of the file, or read as something else.
    #[serde(skip_serializing_if = "<[Finding]>::is_empty")]
    warnings: &'s [Finding],
    patches: Vec<PatchFigures<'s>>,
}

/// A `.json` file: the figures and the light itself.
#[derive(Debug, Serialize)]
pub(crate) struct SolutionFile<'s> {
    #[serde(flatten)]
    pub(crate) figures: Option<&'s Figures<'s>>,
    pub(crate) light: &'s Record,
}

/// The ledger.
#[derive(Debug, Serialize)]
struct Energy<'s> {
    emitted: &'s [f64],
    absorbed: &'s [f64],
    escaped: &'s [f64],
    unshot: &'s [f64],
    defect: &'s [f64],
    /// What is emitted, in lm.
    luminous: f64,
}

/// A patch and its means.
#[derive(Debug, Serialize)]
struct PatchFigures<'s> {
    name: &'s str,
    area: f64,
    irradiance: Vec<f64>,
    /// What the irradiance may be off by.
    #[serde(skip_serializing_if = "<[f64]>::is_empty")]
    estimate: &'s [f64],
    /// Whether the camera sees it for which the light was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    in_view: Option<bool>,
    radiosity: Vec<f64>,
    /// In lx.
    illuminance: f64,
}

impl<'s> Figures<'s> {
    /// The figures of `solution`, the solution of `scene`, read with some repairs and written as `record`.
    pub(crate) fn new(
        record: &'s Record,
        scene: &'s Scene,
        repairs: &'s [KindSummary],
        solution: &'s Solution,
    ) -> Figures<'s> {
        let ledger = &solution.ledger;
        let irradiance = solution.patch_means(&solution.irradiance, scene.patches.len());
        let radiosity = solution.patch_means(&solution.radiosity, scene.patches.len());
        let patches = scene.patches.iter().zip(irradiance).zip(radiosity).enumerate();
        Figures {
            scene: &record.scene,
            repairs,
            elements: record.elements.len(),
            shots: solution.shots,
            products: solution.products,
            seconds: solution.seconds,
            bound: &solution.bound,
            closure: solution.closure,
            scaling: solution.scaling,
            transfers: solution.transfers,
            units: if scene.units == Units::Luminous { "lm" } else { "W" },
            energy: Energy {
                emitted: &ledger.emitted,
                absorbed: &ledger.absorbed,
                escaped: &ledger.escaped,
                unshot: &ledger.unshot,
                defect: &ledger.defect,
                luminous: scene.luminous(&ledger.emitted),
            },
            warnings: &scene.warnings,
            patches: patches
                .map(|(index, ((patch, irradiance), radiosity))| PatchFigures {
                    name: &patch.name,
                    area: patch.polygon.area(),
                    illuminance: scene.luminous(&irradiance),
                    irradiance,
                    estimate: solution.patch_estimate(index),
                    in_view: solution.in_view.as_ref().map(|in_view| in_view[index]),
                    radiosity,
                })
                .collect(),
        }
    }
}

/// One line of JSON, ended by a newline.
pub(crate) fn line(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("plain numbers and names can be written") + "\n"
}

/// The word that stands for a plain value in JSON.
pub(crate) fn word(value: &impl Serialize) -> String {
    line(value).trim().trim_matches('"').to_owned()
}
