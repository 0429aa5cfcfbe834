//! What the form factors will cost.
use crate::scene::Scene;
use crate::solve::options::Options;
use serde::Serialize;
use std::time::Duration;

/// A prediction of the cost of form factors, from some rows that were measured.
#[derive(Clone, Copy, Debug, Serialize)]
#[non_exhaustive]
pub struct Cost {
    /// Elements that `solve` cuts the scene into by default.
    pub elements: usize,
    /// Form factors from every element to every patch. A solution needs more where patches are split, up to a hundred times as
    /// many where a few large patches light each other, and fewer where patches never shoot.
    pub factors: usize,
    /// Seconds that these will take, on as many threads as now; 0 where there was no time to find any.
    pub seconds: f64,
}

impl Cost {
    /// From the time that so many form factors took.
    pub(super) fn measured(scene: &Scene, found: usize, time: Duration) -> Cost {
        let elements = Options::default().elements.max(scene.patches.len());
        let factors = elements * scene.patches.len();
        let each = time.as_secs_f64() / found.max(1) as f64;
        Cost { elements, factors, seconds: each * factors as f64 }
    }
}
