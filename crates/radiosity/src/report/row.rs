//! What is measured: one row for each method, setting and subject.
use serde::Serialize;

/// A line of `report.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "row", rename_all = "kebab-case")]
pub(super) enum Row {
    /// An error and what it cost.
    Measured(Measured),
    /// What was left out in a scene, and what that saved.
    LeftOut(super::left_out::LeftOut),
    /// A row of a published table, measured anew.
    Published(super::published::Published),
}

/// The chapter that a row is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Chapter {
    /// Light from the lamps at points of a scene.
    Scenes,
    /// Single points with references of 34 digits, by kind.
    Points,
    /// Form factors along one axis of stress.
    Stability,
    /// Solvers on stiff scenes.
    Solvers,
    /// Polygon Booleans along one axis of stress.
    Booleans,
}

/// An error and what it cost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Measured {
    /// Where it belongs.
    pub(super) chapter: Chapter,
    /// The scene, the kind of points, or the axis.
    pub(super) subject: String,
    /// The method.
    pub(super) series: String,
    /// The method's setting.
    pub(super) setting: String,
    /// What the setting or the axis amounts to.
    pub(super) amount: f64,
    /// How wrong it is.
    pub(super) error: Error,
    /// A bound that the method itself gives with its result: on the largest error.
    pub(super) bound: Option<f64>,
    /// From how many points it was asked; none where no points are asked.
    pub(super) points: Option<usize>,
    /// From how many of them something hides the targets, but not all of them.
    pub(super) in_part: Option<usize>,
    /// Whether the result passes an exact check, where there is one.
    pub(super) valid: Option<bool>,
    /// Seconds for one point (scenes, points, stability), one solution or one Boolean.
    pub(super) time: Time,
}

/// Deviations from the reference: absolute ones of form factors in scenes and points, else relative ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(super) struct Error {
    /// The largest.
    pub(super) max: f64,
    /// The mean.
    pub(super) mean: f64,
    /// The share of points whose deviation is above 1e-3.
    pub(super) beyond: f64,
}

/// Seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(super) struct Time {
    /// Of the whole process, on all its threads.
    pub(super) cpu: Spread,
    /// By the clock on the wall.
    pub(super) wall: Spread,
    /// How many times it was measured.
    pub(super) rounds: usize,
}

/// The middle and the ends of what was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(super) struct Spread {
    /// The middle one.
    pub(super) median: f64,
    /// The least.
    pub(super) low: f64,
    /// The most.
    pub(super) high: f64,
}

/// What counts as wrong to the eye.
const WRONG: f64 = 1e-3;

impl Error {
    /// Of many deviations; none is no error.
    pub(super) fn of(deviations: &[f64]) -> Error {
        let count = deviations.len().max(1) as f64;
        Error {
            max: deviations.iter().copied().fold(0.0, f64::max),
            mean: deviations.iter().sum::<f64>() / count,
            beyond: deviations.iter().filter(|off| **off > WRONG).count() as f64 / count,
        }
    }
}

impl Spread {
    /// Of samples, at least one.
    pub(super) fn of(mut samples: Vec<f64>) -> Spread {
        samples.sort_by(f64::total_cmp);
        Spread { median: samples[samples.len() / 2], low: samples[0], high: samples[samples.len() - 1] }
    }

    /// The same for a part of the work.
    pub(super) fn over(self, parts: usize) -> Spread {
        let parts = parts.max(1) as f64;
        Spread { median: self.median / parts, low: self.low / parts, high: self.high / parts }
    }
}

impl Time {
    /// The same for a part of the work.
    pub(super) fn over(self, parts: usize) -> Time {
        Time { cpu: self.cpu.over(parts), wall: self.wall.over(parts), rounds: self.rounds }
    }
}
