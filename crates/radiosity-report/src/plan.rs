//! What to measure.
use radiosity::Scene;

/// A plan of what to measure.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The scenes, by name.
    pub scenes: Vec<(String, Scene)>,
    /// Whether to use fewer points, settings and rounds: some minutes instead of half an hour.
    pub quick: bool,
    /// Whether to measure also without a scene: single points, axes of stress, solvers, Booleans,
    /// matrices.
    pub general: bool,
}

impl Plan {
    /// Rounds in which all methods take turns.
    pub(crate) fn rounds(&self) -> usize {
        if self.quick { 3 } else { 5 }
    }

    /// A number for the full report, or a share of it.
    pub(crate) fn scaled(&self, full: usize, share: usize) -> usize {
        if self.quick { full / share } else { full }
    }
}
