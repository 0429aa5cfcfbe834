//! What every method is asked: points, what they look at, and the exact answers.
use crate::clock::{Job, interleaved};
use crate::methods::{EXACT, Step};
use crate::plan::Rounds;
use crate::rows::{Chapter, Deviation, Measured, Time};
use formfactor::{DifferentialArea, Enclosure, unoccluded};

/// A point that looks at some polygons of an enclosure.
#[derive(Clone, Debug)]
pub(crate) struct Query {
    /// Which of the set's enclosures.
    pub(crate) enclosure: usize,
    pub(crate) from: DifferentialArea,
    pub(crate) targets: Vec<usize>,
    /// The form factor to all targets together, and a bound on its error.
    pub(crate) exact: f64,
    pub(crate) bound: f64,
}

/// Points to query from, and how their errors count.
#[derive(Clone, Debug)]
pub(crate) struct QuerySet {
    pub(crate) chapter: Chapter,
    pub(crate) subject: String,
    pub(crate) enclosures: Vec<Enclosure>,
    pub(crate) queries: Vec<Query>,
    /// Whether errors are shares of the exact value.
    pub(crate) relative: bool,
    /// Whether the exact values come from elsewhere than the exact method: then its error is measured like any other's,
    /// and else its bound stands for it.
    pub(crate) independent: bool,
}

impl QuerySet {
    /// The answers of one method.
    fn answers(&self, step: &Step) -> Vec<f64> {
        let total = |query: &Query| {
            let row = step.method.row(&self.enclosures[query.enclosure], &query.from, &query.targets);
            row.iter().sum::<f64>()
        };
        self.queries.iter().map(total).collect()
    }

    /// Measures all methods, in turns.
    pub(crate) fn measure(&self, steps: &[Step], rounds: Rounds) -> Vec<Measured> {
        let job = |step| -> Job<'_, Vec<f64>> { Box::new(move || self.answers(step)) };
        let jobs: Vec<Job<'_, Vec<f64>>> = steps.iter().map(job).collect();
        let found = interleaved(&jobs, rounds);
        let in_part = self.queries.iter().filter(|query| self.sees_a_part(query)).count();
        let row = |(step, (answers, time)): (&Step, (Vec<f64>, Time))| {
            let bound = (step.series == EXACT).then(|| self.bound());
            let certified = bound.filter(|_| !self.independent);
            Measured {
                chapter: self.chapter,
                subject: self.subject.clone(),
                series: step.series.to_owned(),
                setting: step.setting.clone(),
                amount: step.amount,
                error: certified.unwrap_or_else(|| self.deviations(&answers)),
                certified: certified.is_some(),
                bound: bound.map(|bound| bound.max),
                defect: None,
                points: Some(self.queries.len()),
                in_part: Some(in_part),
                valid: None,
                time: time.over(self.queries.len()),
            }
        };
        steps.iter().zip(found).map(row).collect()
    }

    /// How far answers are from the exact ones.
    fn deviations(&self, answers: &[f64]) -> Deviation {
        let off = |(answer, query): (&f64, &Query)| (answer - query.exact).abs() / self.unit(query);
        Deviation::of(&answers.iter().zip(&self.queries).map(off).collect::<Vec<_>>())
    }

    /// The bounds of the exact method, as an error.
    fn bound(&self) -> Deviation {
        Deviation::of(&self.queries.iter().map(|query| query.bound / self.unit(query)).collect::<Vec<_>>())
    }

    /// The form factor to all targets if nothing hid them, and a bound on its error.
    pub(crate) fn free(&self, query: &Query) -> [f64; 2] {
        let polygons = self.enclosures[query.enclosure].polygons();
        let factors = query.targets.iter().map(|target| unoccluded(&query.from, &polygons[*target]));
        factors.fold([0.0; 2], |[value, bound], f| [value + f.value, bound + f.error_bound])
    }

    /// Whether something hides the targets from a point, but not all of them.
    pub(crate) fn sees_a_part(&self, query: &Query) -> bool {
        let [free, bound] = self.free(query);
        query.exact > query.bound && query.exact + query.bound < free - bound
    }

    fn unit(&self, query: &Query) -> f64 {
        if self.relative && query.exact > 0.0 { query.exact } else { 1.0 }
    }
}

/// The exact form factor to all targets together, with the sum of the bounds.
pub(crate) fn exact(enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> [f64; 2] {
    let factors = targets.iter().map(|target| enclosure.form_factor(from, *target));
    factors.fold([0.0; 2], |[value, bound], f| [value + f.value, bound + f.error_bound])
}
