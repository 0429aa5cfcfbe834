//! What the form factors will cost.
use crate::scene::Scene;
use crate::solve::options::Options;
use serde::Serialize;
use std::time::Duration;

/// A prediction from some rows of form factors that were measured here.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Cost {
    /// Elements that `solve` cuts the scene into by default.
    pub elements: usize,
    /// Form factors from every element to every patch: once around. Patches that are split need more, up to a hundred times
    /// as many where a few large ones light each other; patches that never shoot need fewer.
    pub factors: usize,
    /// Seconds that these will take on these threads.
    pub seconds: f64,
}

impl Cost {
    /// From the time that some rows took.
    pub(super) fn measured(scene: &Scene, rows: usize, time: Duration) -> Cost {
        let elements = Options::default().elements.max(scene.patches.len());
        let row = time.as_secs_f64() / rows.max(1) as f64;
        Cost { elements, factors: elements * scene.patches.len(), seconds: row * elements as f64 }
    }
}
