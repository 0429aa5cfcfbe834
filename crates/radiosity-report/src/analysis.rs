//! What rows show: slopes, floors, times to an error, and whether the exact method holds what is said of it.
use crate::methods::EXACT;
use crate::rows::Measured;

/// The errors for which the time is asked.
pub(crate) const TARGETS: [f64; 3] = [1e-2, 1e-4, 1e-6];
/// How little an error must fall from one setting to the next to count as stuck.
const STUCK: f64 = 0.9;
/// How many settings must be stuck to call it a floor.
const SETTINGS: usize = 3;
/// Below this an error is rounding.
const ROUNDING: f64 = 1e-12;

/// A method on one subject, its settings in order.
#[derive(Clone, Debug)]
pub(crate) struct Line<'r> {
    pub(crate) name: &'r str,
    pub(crate) rows: Vec<&'r Measured>,
}

/// Rows of one subject as lines, in the order in which the methods come.
pub(crate) fn lines<'r>(rows: &[&'r Measured]) -> Vec<Line<'r>> {
    let mut lines: Vec<Line<'r>> = Vec::new();
    for &row in rows {
        match lines.iter_mut().find(|line| line.name == row.series) {
            Some(line) => line.rows.push(row),
            None => lines.push(Line { name: &row.series, rows: vec![row] }),
        }
    }
    lines
}

/// The subjects, in the order in which they come, each with its rows.
pub(crate) fn subjects<'r>(
    rows: impl IntoIterator<Item = &'r Measured>,
) -> Vec<(&'r str, Vec<&'r Measured>)> {
    let mut subjects: Vec<(&str, Vec<&Measured>)> = Vec::new();
    for row in rows {
        match subjects.iter_mut().find(|(name, _)| *name == row.subject) {
            Some((_, rows)) => rows.push(row),
            None => subjects.push((&row.subject, vec![row])),
        }
    }
    subjects
}

impl Line<'_> {
    /// The error that more work does not lower: where the last settings are stuck, above rounding.
    pub(crate) fn floor(&self, error_of: impl Fn(&Measured) -> f64) -> Option<f64> {
        let errors: Vec<f64> = self.rows.iter().map(|row| error_of(row)).collect();
        let last = errors[errors.len().checked_sub(SETTINGS)?..].to_vec();
        let stuck = last.windows(2).all(|pair| pair[1] >= STUCK * pair[0]);
        let least = last.iter().copied().fold(f64::INFINITY, f64::min);
        (stuck && least > ROUNDING).then_some(least)
    }

    /// The exponent of the error over the CPU time, by least squares over logarithms, of what is above rounding and not
    /// yet stuck.
    pub(crate) fn slope(&self, error_of: impl Fn(&Measured) -> f64) -> Option<f64> {
        let floor = self.floor(&error_of).map_or(ROUNDING, |floor| floor / STUCK);
        let points = self.rows.iter().map(|row| [row.time.cpu.median, error_of(row)]);
        slope(&points.filter(|[_, error]| *error > floor).collect::<Vec<_>>())
    }

    /// The least time in which an error is reached: by the least time of all settings that reach it.
    pub(crate) fn time_to(&self, error: f64) -> Option<f64> {
        let good = self.rows.iter().filter(|row| row.error.max <= error);
        good.map(|row| row.time.cpu.median).reduce(f64::min)
    }

    /// The smallest error of all settings, and the time of that.
    pub(crate) fn best(&self) -> [f64; 2] {
        let each = self.rows.iter().map(|row| [row.error.max, row.time.cpu.median]);
        each.reduce(|a, b| if b[0] < a[0] { b } else { a }).unwrap_or([f64::INFINITY; 2])
    }
}

/// Least squares of ln y over ln x, for three points and more whose x spread by some factor.
pub(crate) fn slope(points: &[[f64; 2]]) -> Option<f64> {
    const FACTOR: f64 = 3.0;
    let logs: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::ln)).collect();
    let ends = points.iter().map(|point| [point[0]; 2]).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
    let count = logs.len() as f64;
    let mean = |k: usize| logs.iter().map(|point| point[k]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let across: f64 = logs.iter().map(|point| (point[0] - x) * (point[1] - y)).sum();
    let along: f64 = logs.iter().map(|point| (point[0] - x) * (point[0] - x)).sum();
    (logs.len() >= 3 && ends[1] >= FACTOR * ends[0]).then(|| across / along)
}

/// What a scene says of the exact method against those that sample.
#[derive(Clone, Debug)]
pub(crate) struct Verdict<'r> {
    /// The largest error of the exact method, certified by its bound, and its time.
    pub(crate) exact: [f64; 2],
    /// Methods that reach 1e-6 within the exact method's time.
    pub(crate) beaten_by: Vec<&'r str>,
    /// Methods that are quicker at an accuracy of their own: the name, that error, and their share of the exact time.
    pub(crate) quicker: Vec<(&'r str, f64, f64)>,
}

/// Holds the exact method against all others on one subject; nothing where it was not asked.
pub(crate) fn verdict<'r>(lines: &[Line<'r>]) -> Option<Verdict<'r>> {
    let exact = lines.iter().find(|line| line.name == EXACT)?.best();
    let others = || lines.iter().filter(|line| line.name != EXACT);
    let reaches = |line: &&Line<'_>| line.time_to(TARGETS[2]).is_some_and(|time| time <= exact[1]);
    let quicker = |line: &Line<'r>| {
        let quick = line.rows.iter().filter(|row| row.time.cpu.median < exact[1]);
        let best = quick.min_by(|a, b| a.error.max.total_cmp(&b.error.max))?;
        Some((line.name, best.error.max, best.time.cpu.median / exact[1]))
    };
    Some(Verdict {
        exact,
        beaten_by: others().filter(reaches).map(|line| line.name).collect(),
        quicker: others().filter_map(quicker).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rows::{Chapter, Deviation, Spread, Time};

    fn row(series: &str, error: f64, seconds: f64) -> Measured {
        let spread = Spread { median: seconds, low: seconds, high: seconds };
        Measured {
            chapter: Chapter::Scenes,
            subject: "scene".into(),
            series: series.into(),
            setting: String::new(),
            amount: 1.0,
            error: Deviation { max: error, mean: error, beyond: 0.0 },
            certified: false,
            bound: None,
            defect: None,
            points: None,
            in_part: None,
            valid: None,
            time: Time { cpu: spread, wall: spread, rounds: 1 },
        }
    }

    #[test]
    fn the_slope_of_a_power_is_its_exponent() {
        let rows: Vec<Measured> = (0..6).map(|k| row("m", 3.0 * 4f64.powi(-k), 2f64.powi(k))).collect();
        let line = &lines(&rows.iter().collect::<Vec<_>>())[0];
        assert!((line.slope(|row| row.error.max).unwrap() + 2.0).abs() < 1e-12);
        assert_eq!(line.floor(|row| row.error.max), None);
        assert_eq!(slope(&[[1.0, 1.0], [9.0, 2.0]]), None);
        assert_eq!(
            slope(&[[1.0, 1.0], [1.1, 2.0], [1.2, 0.1]]),
            None,
            "times that are all alike tell nothing"
        );
    }

    #[test]
    fn an_error_that_more_time_does_not_lower_is_a_floor_and_not_part_of_the_slope() {
        let errors = [0.4, 0.1, 0.025, 4e-3, 4e-3, 4e-3];
        let rows: Vec<Measured> =
            errors.iter().zip(0..).map(|(error, k)| row("m", *error, 2f64.powi(k))).collect();
        let line = &lines(&rows.iter().collect::<Vec<_>>())[0];
        assert_eq!(line.floor(|row| row.error.max), Some(4e-3));
        assert!((line.slope(|row| row.error.max).unwrap() + 2.0).abs() < 1e-12);
        let exact: Vec<Measured> = (0..4).map(|k| row("m", 1e-16, f64::from(k + 1))).collect();
        assert_eq!(lines(&exact.iter().collect::<Vec<_>>())[0].floor(|row| row.error.max), None);
    }

    #[test]
    fn the_time_to_an_error_is_the_least_of_those_that_reach_it() {
        let rows = [row("m", 1e-3, 1.0), row("m", 1e-5, 5.0), row("m", 1e-5, 4.0)];
        let line = &lines(&rows.iter().collect::<Vec<_>>())[0];
        assert_eq!(TARGETS.map(|target| line.time_to(target)), [Some(1.0), Some(4.0), None]);
        assert_eq!(line.best(), [1e-5, 5.0]);
    }

    #[test]
    fn a_verdict_names_who_wins_and_where() {
        let rows =
            [row(EXACT, 1e-14, 1.0), row("quick", 1e-2, 0.1), row("slow", 1e-7, 3.0), row("both", 1e-7, 0.5)];
        let refs: Vec<&Measured> = rows.iter().collect();
        let verdict = verdict(&lines(&refs)).unwrap();
        assert_eq!((verdict.exact, verdict.beaten_by), ([1e-14, 1.0], vec!["both"]));
        assert_eq!(verdict.quicker, [("quick", 1e-2, 0.1), ("both", 1e-7, 0.5)]);
        assert_eq!(subjects(&rows).len(), 1);
    }
}
