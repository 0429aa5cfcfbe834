//! A job that is loaded and can be timed.

use cpu_time::ProcessTime;
use serde::{Deserialize, Serialize};
use std::hint::black_box;

/// What a result looks like, to tell whether results agree.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Outcome {
    /// The enclosed area.
    pub area: f64,
    /// The number of rings; 0 when only a boundary was built.
    pub rings: usize,
    /// Whether the result passes its library's own exact check; only polycsg's is asked.
    pub valid: Option<bool>,
}

impl Outcome {
    /// An outcome without a check.
    pub fn of(area: f64, rings: usize) -> Outcome {
        Outcome { area, rings, valid: None }
    }
}

/// A loaded job.
pub trait Task {
    /// CPU seconds of the whole process per call, over that many calls in a row.
    fn seconds(&mut self, calls: usize) -> Result<f64, String>;

    /// One call, and what came out.
    fn outcome(&mut self) -> Result<Outcome, String>;
}

/// A loaded job made of its prepared input, the timed call and the measure of a result.
pub(super) struct Call<I, C, M> {
    input: I,
    call: C,
    measure: M,
}

/// A task from its parts; the call receives copies of `input` that were made beforehand.
pub(super) fn task<I, R, C, M>(input: I, call: C, measure: M) -> Box<dyn Task>
where
    I: Clone + 'static,
    C: FnMut(I) -> Result<R, String> + 'static,
    M: Fn(&R) -> Outcome + 'static,
    R: 'static,
{
    Box::new(Call { input, call, measure })
}

impl<I, R, C, M> Task for Call<I, C, M>
where
    I: Clone,
    C: FnMut(I) -> Result<R, String>,
    M: Fn(&R) -> Outcome,
{
    fn seconds(&mut self, calls: usize) -> Result<f64, String> {
        let inputs = vec![self.input.clone(); calls];
        let start = ProcessTime::now();
        for input in inputs {
            drop(black_box((self.call)(black_box(input))?));
        }
        Ok(start.elapsed().as_secs_f64() / calls as f64)
    }

    fn outcome(&mut self) -> Result<Outcome, String> {
        let result = (self.call)(self.input.clone())?;
        Ok((self.measure)(&result))
    }
}

/// Twice the signed area of a closed chain of points, seen from its first point.
#[cfg(any(feature = "i_overlay", feature = "geo", feature = "linesweeper", feature = "polyops"))]
pub(super) fn doubled_area(points: impl Iterator<Item = [f64; 2]> + Clone) -> f64 {
    let Some(origin) = points.clone().next() else { return 0.0 };
    let relative = points.map(|p| [p[0] - origin[0], p[1] - origin[1]]);
    relative.clone().zip(relative.skip(1)).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}
