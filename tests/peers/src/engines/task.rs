//! A job that is loaded and can be timed.

use crate::job::{Job, Operand, pairs};
use cpu_time::ProcessTime;
use serde::{Deserialize, Serialize};
use std::hint::black_box;

/// What results look like, to tell whether they agree.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Outcome {
    /// The area of each result.
    pub areas: Vec<f64>,
    /// The number of rings of all; 0 when only boundaries were built.
    pub rings: usize,
    /// Whether all pass their library's own exact check; only polycsg's are asked.
    pub valid: Option<bool>,
}

impl Outcome {
    /// One result without a check.
    pub fn of(area: f64, rings: usize) -> Outcome {
        Outcome { areas: vec![area], rings, valid: None }
    }

    /// How far the areas are from `other`'s: the sum of differences over the sum of `other`'s areas.
    pub fn error(&self, other: &Outcome) -> f64 {
        let difference: f64 = self.areas.iter().zip(&other.areas).map(|(a, b)| (a - b).abs()).sum();
        let total: f64 = other.areas.iter().map(|area| area.abs()).sum();
        if difference == 0.0 { 0.0 } else { difference / total }
    }

    fn add(&mut self, next: Outcome) {
        self.areas.extend(next.areas);
        self.rings += next.rings;
        self.valid = self.valid.map_or(next.valid, |valid| next.valid.map(|next| valid && next));
    }
}

/// A loaded job.
pub trait Task {
    /// CPU seconds of the whole process per Boolean, over that many calls in a row.
    fn seconds(&mut self, calls: usize) -> Result<f64, String>;

    /// One call, and what came out.
    fn outcome(&mut self) -> Result<Outcome, String>;
}

/// Receives the results of a call one by one.
pub(super) type Sink<'a, R> = &'a mut dyn FnMut(R);

/// A loaded job made of its prepared input, the timed call and the measure of a result.
struct Call<I, R, C> {
    input: I,
    call: C,
    measure: Measure<R>,
}

type Measure<R> = Box<dyn Fn(&R) -> Outcome>;

/// A task from its parts; the call receives copies of `input` that were made beforehand.
pub(super) fn task<I: Clone + 'static, R: 'static>(
    input: I,
    call: impl FnMut(I, Sink<'_, R>) -> Result<(), String> + 'static,
    measure: impl Fn(&R) -> Outcome + 'static,
) -> Box<dyn Task> {
    Box::new(Call { input, call, measure: Box::new(measure) })
}

/// The operands of a job in an engine's own type.
pub(super) fn operands<T>(job: &Job, load: impl Fn(&Operand) -> T) -> [Vec<T>; 2] {
    [&job.subjects, &job.clips].map(|operands| operands.iter().map(&load).collect())
}

/// One Boolean after the other, for engines that read their operands.
pub(super) fn reading<T: 'static, R: 'static>(
    [subjects, clips]: [Vec<T>; 2],
    mut boolean: impl FnMut(&T, &T) -> Result<R, String> + 'static,
    measure: impl Fn(&R) -> Outcome + 'static,
) -> Box<dyn Task> {
    let call = move |(), sink: Sink<'_, R>| {
        pairs(&subjects, &clips).try_for_each(|(subject, clip)| boolean(subject, clip).map(&mut *sink))
    };
    task((), call, measure)
}

/// The same for engines that consume their operands: copies are made beforehand, those of a common clip within the call.
#[cfg(any(feature = "clipper2", feature = "polyops"))]
pub(super) fn consuming<T: Clone + 'static, R: 'static>(
    [subjects, clips]: [Vec<T>; 2],
    mut boolean: impl FnMut(T, T) -> Result<R, String> + 'static,
    measure: impl Fn(&R) -> Outcome + 'static,
) -> Box<dyn Task> {
    let common = clips.first().filter(|_| clips.len() < subjects.len()).cloned();
    let own = if common.is_some() { vec![] } else { clips };
    let call = move |[subjects, clips]: [Vec<T>; 2], sink: Sink<'_, R>| {
        let mut clips = clips.into_iter();
        subjects.into_iter().try_for_each(|subject| {
            let clip = clips.next().or_else(|| common.clone()).ok_or("a subject without a clip")?;
            boolean(subject, clip).map(&mut *sink)
        })
    };
    task([subjects, own], call, measure)
}

impl<I: Clone, R, C: FnMut(I, Sink<'_, R>) -> Result<(), String>> Task for Call<I, R, C> {
    fn seconds(&mut self, calls: usize) -> Result<f64, String> {
        let inputs = vec![self.input.clone(); calls];
        let mut results = 0_u32;
        let start = ProcessTime::now();
        for input in inputs {
            (self.call)(black_box(input), &mut |result| {
                drop(black_box(result));
                results += 1;
            })?;
        }
        Ok(start.elapsed().as_secs_f64() / f64::from(results))
    }

    fn outcome(&mut self) -> Result<Outcome, String> {
        let (mut outcome, measure) = (Outcome::default(), &self.measure);
        (self.call)(self.input.clone(), &mut |result| outcome.add(measure(&result)))?;
        Ok(outcome)
    }
}

/// Twice the signed area of a closed chain of points, seen from its first point.
#[cfg(any(feature = "i_overlay", feature = "geo", feature = "linesweeper", feature = "polyops"))]
pub(super) fn doubled_area(points: impl Iterator<Item = [f64; 2]> + Clone) -> f64 {
    let Some(origin) = points.clone().next() else { return 0.0 };
    let relative = points.map(|p| [p[0] - origin[0], p[1] - origin[1]]);
    relative.clone().zip(relative.skip(1)).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}
