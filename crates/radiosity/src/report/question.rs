//! What is asked of every method: points, what they look at, and the exact answers.
use super::clock::{self, Job};
use super::jobs::Step;
use super::row::{Chapter, Error, Measured};
use formfactor::{DifferentialArea, Enclosure, unoccluded};

/// A point that looks at some polygons of an enclosure.
#[derive(Clone, Debug)]
pub(super) struct Ask {
    /// Which of the question's enclosures.
    pub(super) enclosure: usize,
    pub(super) from: DifferentialArea,
    pub(super) targets: Vec<usize>,
    /// The form factor to all targets together, and a bound on its error.
    pub(super) exact: f64,
    pub(super) bound: f64,
}

/// Points to ask from, and how their errors count.
#[derive(Clone, Debug)]
pub(super) struct Question {
    pub(super) chapter: Chapter,
    pub(super) subject: String,
    pub(super) enclosures: Vec<Enclosure>,
    pub(super) asks: Vec<Ask>,
    /// Whether errors are shares of the exact value.
    pub(super) relative: bool,
    /// Whether the exact values come from elsewhere than the exact method: then its error is measured like any other's,
    /// and else its bound stands for it.
    pub(super) independent: bool,
}

impl Question {
    /// What one method answers.
    fn answers(&self, step: &Step) -> Vec<f64> {
        let total = |ask: &Ask| {
            let row = step.method.row(&self.enclosures[ask.enclosure], &ask.from, &ask.targets);
            row.iter().sum::<f64>()
        };
        self.asks.iter().map(total).collect()
    }

    /// Asks all methods, in turns.
    pub(super) fn measure(&self, steps: &[Step], rounds: usize) -> Vec<Measured> {
        let job = |step| -> Job<'_, Vec<f64>> { Box::new(move || self.answers(step)) };
        let jobs: Vec<Job<'_, Vec<f64>>> = steps.iter().map(job).collect();
        let found = clock::interleaved(&jobs, rounds);
        let in_part = self.asks.iter().filter(|ask| self.sees_a_part(ask)).count();
        let row = |(step, (answers, time)): (&Step, (Vec<f64>, super::row::Time))| {
            let bound = (step.series == super::jobs::EXACT).then(|| self.bound());
            let certified = bound.filter(|_| !self.independent);
            Measured {
                chapter: self.chapter,
                subject: self.subject.clone(),
                series: step.series.to_owned(),
                setting: step.setting.clone(),
                amount: step.amount,
                error: certified.unwrap_or_else(|| self.deviations(&answers)),
                bound: bound.map(|bound| bound.max),
                points: Some(self.asks.len()),
                in_part: Some(in_part),
                valid: None,
                time: time.over(self.asks.len()),
            }
        };
        steps.iter().zip(found).map(row).collect()
    }

    /// How far answers are from the exact ones.
    fn deviations(&self, answers: &[f64]) -> Error {
        let off = |(answer, ask): (&f64, &Ask)| (answer - ask.exact).abs() / self.unit(ask);
        Error::of(&answers.iter().zip(&self.asks).map(off).collect::<Vec<_>>())
    }

    /// The bounds of the exact method, as an error.
    fn bound(&self) -> Error {
        Error::of(&self.asks.iter().map(|ask| ask.bound / self.unit(ask)).collect::<Vec<_>>())
    }

    /// The form factor to all targets if nothing hid them, and a bound on its error.
    pub(super) fn free(&self, ask: &Ask) -> [f64; 2] {
        let polygons = self.enclosures[ask.enclosure].polygons();
        let factors = ask.targets.iter().map(|target| unoccluded(&ask.from, &polygons[*target]));
        factors.fold([0.0; 2], |[value, bound], f| [value + f.value, bound + f.error_bound])
    }

    /// Whether something hides the targets from a point, but not all of them.
    pub(super) fn sees_a_part(&self, ask: &Ask) -> bool {
        let [free, bound] = self.free(ask);
        ask.exact > ask.bound && ask.exact + ask.bound < free - bound
    }

    fn unit(&self, ask: &Ask) -> f64 {
        if self.relative && ask.exact > 0.0 { ask.exact } else { 1.0 }
    }
}

/// The exact form factor to all targets together, with the sum of the bounds.
pub(super) fn exact(enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> [f64; 2] {
    let factors = targets.iter().map(|target| enclosure.form_factor(from, *target));
    factors.fold([0.0; 2], |[value, bound], f| [value + f.value, bound + f.error_bound])
}
