//! What is measured: one row for each method, setting and subject.
use serde::Serialize;

/// A line of `report.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "row", rename_all = "kebab-case")]
pub(crate) enum Row {
    /// An error and what it cost.
    Measured(Measured),
    /// Work that was saved in a scene.
    LeftOut(LeftOut),
    /// A row of a published table, measured again.
    Published(Published),
}

/// The chapter that a row is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Chapter {
    /// Whole solutions against what faces truly receive.
    Solutions,
    /// Light from the emitters at points of a scene.
    Scenes,
    /// Single points with references of 34 digits, by kind.
    Points,
    /// Form factors along one axis of stress.
    Stability,
    /// Solvers on stiff scenes.
    Solvers,
    /// Polygon Booleans along one axis of stress.
    Booleans,
    /// Whole matrices from area to area.
    Matrices,
}

/// An error and what it cost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Measured {
    /// Where it belongs.
    pub(crate) chapter: Chapter,
    /// The scene, the kind of points, or the axis.
    pub(crate) subject: String,
    /// The method.
    pub(crate) series: String,
    /// The method's setting.
    pub(crate) setting: String,
    /// What the setting or the axis amounts to.
    pub(crate) amount: f64,
    /// How wrong it is.
    pub(crate) error: Deviation,
    /// Whether the error is a proven bound; others are measured.
    pub(crate) certified: bool,
    /// A bound that the method itself gives with its result: on the largest error.
    pub(crate) bound: Option<f64>,
    /// Of a matrix of a closed room: the largest |sum - 1| of a row.
    pub(crate) defect: Option<f64>,
    /// The number of points queried; `None` where no points are queried.
    pub(crate) points: Option<usize>,
    /// The number of points from which the targets are partly hidden.
    pub(crate) in_part: Option<usize>,
    /// Whether the result passes an exact check, where there is one.
    pub(crate) valid: Option<bool>,
    /// Seconds for one point (scenes, points, stability), one solution, one Boolean or one matrix.
    pub(crate) time: Time,
}

/// Work that was saved in a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct LeftOut {
    /// The scene.
    pub(crate) scene: String,
    /// What was left out.
    pub(crate) economy: &'static str,
    /// How many were left out, per form factor; of elements, how many in all.
    pub(crate) count: f64,
    /// The share of all.
    pub(crate) share: f64,
    /// Seconds that one costs where it is not left out, measured here.
    pub(crate) unit: f64,
    /// The time saved over the time taken.
    pub(crate) saved: f64,
}

/// A row of a published table, measured again.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Published {
    /// The table's number.
    pub(crate) table: &'static str,
    /// The scene.
    pub(crate) scene: &'static str,
    /// The method.
    pub(crate) method: String,
    /// What was published: elements and vertices or memory, time.
    pub(crate) published: &'static str,
    /// Number of elements here.
    pub(crate) elements: usize,
    /// Number of vertices here.
    pub(crate) vertices: usize,
    /// CPU seconds here.
    pub(crate) seconds: f64,
    /// Bytes of the form factors that were kept; none where none are.
    pub(crate) bytes: Option<usize>,
    /// The largest, and the mean, relative deviation of reflected light from the exact solution on the same elements.
    pub(crate) errors: [f64; 2],
}

/// Deviations from the reference: absolute ones of form factors in scenes and points, else relative ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Deviation {
    /// The largest.
    pub(crate) max: f64,
    /// The mean.
    pub(crate) mean: f64,
    /// The share of points whose deviation is above 1e-3.
    pub(crate) beyond: f64,
}

/// Seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Time {
    /// Of the whole process, on all its threads.
    pub(crate) cpu: Spread,
    /// By the clock on the wall.
    pub(crate) wall: Spread,
    /// How many times it was measured.
    pub(crate) rounds: usize,
}

/// The middle and the ends of what was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Spread {
    /// The middle one.
    pub(crate) median: f64,
    /// The least.
    pub(crate) low: f64,
    /// The most.
    pub(crate) high: f64,
}

/// A deviation that the eye sees.
const WRONG: f64 = 1e-3;

impl Deviation {
    /// Of many deviations; none is no error.
    pub(crate) fn of(deviations: &[f64]) -> Deviation {
        let count = deviations.len().max(1) as f64;
        Deviation {
            max: deviations.iter().copied().fold(0.0, f64::max),
            mean: deviations.iter().sum::<f64>() / count,
            beyond: deviations.iter().filter(|off| **off > WRONG).count() as f64 / count,
        }
    }
}

impl Spread {
    /// Of samples, at least one.
    pub(crate) fn of(mut samples: Vec<f64>) -> Spread {
        samples.sort_by(f64::total_cmp);
        Spread { median: samples[samples.len() / 2], low: samples[0], high: samples[samples.len() - 1] }
    }

    /// The same for a part of the work.
    pub(crate) fn over(self, parts: usize) -> Spread {
        let parts = parts.max(1) as f64;
        Spread { median: self.median / parts, low: self.low / parts, high: self.high / parts }
    }
}

impl Time {
    /// The same for a part of the work.
    pub(crate) fn over(self, parts: usize) -> Time {
        Time { cpu: self.cpu.over(parts), wall: self.wall.over(parts), rounds: self.rounds }
    }
}

/// A picture with what it shows.
#[derive(Clone, Debug)]
pub(crate) struct ErrorImage {
    pub(crate) scene: String,
    pub(crate) caption: String,
    /// A PNG as a `data:` address.
    pub(crate) address: String,
}
