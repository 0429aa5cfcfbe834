//! What to measure.
use radiosity::Scene;

/// How often what is timed takes its turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rounds {
    /// Turns of a short job.
    pub(crate) count: usize,
    /// What takes so many seconds of CPU is its own mean: it is not measured again.
    pub(crate) long: f64,
}

impl Rounds {
    /// One turn for every job.
    pub(crate) const ONCE: Rounds = Rounds { count: 1, long: 0.0 };
}

/// A plan of what to measure.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The scenes, by name.
    pub scenes: Vec<(String, Scene)>,
    /// Whether to use fewer points, settings and rounds: a minute or two instead of half an hour.
    pub quick: bool,
    /// Whether to measure also without a scene: single points, axes of stress, solvers, Booleans,
    /// matrices.
    pub general: bool,
}

impl Plan {
    /// Rounds in which all methods take turns.
    pub(crate) fn rounds(&self) -> Rounds {
        if self.quick { Rounds { count: 3, long: 0.005 } } else { Rounds { count: 5, long: 0.5 } }
    }

    /// A number for the full report, or a share of it.
    pub(crate) fn scaled(&self, full: usize, share: usize) -> usize {
        if self.quick { full / share } else { full }
    }
}
