//! Error against time: every method on every scene, how wrong it is and what it cost, as one page.
//!
//! ```text
//! stage       a scene cut in elements: points, lamps, and the exact light between them
//! question    points with exact answers, of scenes, of cases known to 34 digits (cases), along axes of stress (stress)
//! jobs        the methods, each over the range of its settings
//! clock       all of them in turns: process CPU time and wall time
//! stiff, booleans, left_out, published    what is measured beside form factors
//! row         one row for each measurement: the lines of the report
//! analysis    slopes, floors, times to an error, and who wins where
//! plot, axis, table, portrait             how that is shown
//! page, chapter_*                         one HTML file
//! ```
//! The rows are the same in every run on every machine, but for the times.
mod analysis;
mod axis;
mod booleans;
mod cases;
mod chapter_axes;
mod chapter_scenes;
mod chapter_tables;
mod clock;
mod jobs;
mod left_out;
mod machine;
mod page;
mod peers;
mod plot;
mod portrait;
mod published;
mod question;
mod row;
mod stage;
mod stiff;
mod stress;
mod table;

pub use peers::Peers;

use crate::{Error, Scene};
use jobs::Step;
use machine::Machine;
use portrait::Portrait;
use row::{Chapter, Measured, Row};
use stage::Stage;

/// What to measure.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The scenes, by name.
    pub scenes: Vec<(String, Scene)>,
    /// Fewer points, settings and rounds: some minutes instead of half an hour.
    pub quick: bool,
    /// Whether what belongs to no scene is measured too: single points, axes of stress, solvers, Booleans.
    pub general: bool,
}

/// What was measured.
#[derive(Clone, Debug)]
pub struct Report {
    rows: Vec<Row>,
    machine: Machine,
    quick: bool,
    portraits: Vec<Portrait>,
}

/// Measures all that a plan says; `say` is told what comes next. Nothing else should run at that time.
///
/// ```no_run
/// use radiosity::{report::{Plan, report}, scenes};
///
/// let beams = scenes::scene("beams").expect("a built-in scene");
/// let plan = Plan { scenes: vec![("beams".to_owned(), beams)], quick: true, general: false };
/// let report = report(&plan, |next| eprintln!("{next}"))?;
/// std::fs::write("report.html", report.page(None))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// What [`solve`](crate::solve()) refuses in a scene.
pub fn report(plan: &Plan, mut say: impl FnMut(&str)) -> Result<Report, Error> {
    let steps = jobs::steps(plan);
    let (mut rows, mut portraits) = (Vec::new(), Vec::new());
    for (name, scene) in &plan.scenes {
        say(name);
        let stage = Stage::new(name, scene, plan.scaled(1500, 3))?;
        let question = stage.question(plan.scaled(128, 2));
        rows.extend(question.measure(&steps, plan.rounds()).into_iter().map(Row::Measured));
        rows.extend(left_out::measure(&stage, plan.rounds())?);
        portraits.extend(portrait::portraits(&stage, &pictured(plan)));
    }
    if plan.general {
        rows.extend(general(plan, &steps, &mut say)?.into_iter().map(Row::Measured));
    }
    rows.extend(published::measure(plan, say)?.into_iter().map(Row::Published));
    Ok(Report { rows, machine: Machine::here(), quick: plan.quick, portraits })
}

/// What belongs to no scene.
fn general(plan: &Plan, steps: &[Step], mut say: impl FnMut(&str)) -> Result<Vec<Measured>, Error> {
    let mut rows = Vec::new();
    say("points by kind");
    for question in cases::questions() {
        rows.extend(question.measure(steps, plan.rounds()));
    }
    say("stability of form factors");
    let middle = jobs::middle(plan);
    for (at, question) in stress::questions(plan) {
        let measured = question.measure(&middle, plan.rounds()).into_iter();
        rows.extend(measured.map(|row| Measured { amount: at, ..row }));
    }
    say("solvers on stiff scenes");
    rows.extend(stiff::measure(plan)?);
    say("stability of Booleans");
    rows.extend(booleans::measure(plan));
    Ok(rows)
}

/// The methods whose errors are drawn: the visibility index, and a hemicube.
fn pictured(plan: &Plan) -> Vec<Step> {
    let mut steps = jobs::middle(plan);
    steps.retain(|step| step.series.starts_with("visibility") || step.series == "hemicube");
    steps
}

impl Plan {
    /// Rounds in which all methods take turns.
    fn rounds(&self) -> usize {
        if self.quick { 3 } else { 5 }
    }

    /// A number for the full report, or a share of it.
    fn scaled(&self, full: usize, share: usize) -> usize {
        if self.quick { full / share } else { full }
    }
}

impl Report {
    /// The rows as JSON, one a line, after one about the machine.
    #[must_use]
    pub fn lines(&self) -> String {
        let line =
            |text: serde_json::Result<String>| text.expect("plain numbers and names can be written") + "\n";
        let rows = self.rows.iter().map(|row| line(serde_json::to_string(row)));
        line(serde_json::to_string(&serde_json::json!({ "row": "machine", "machine": self.machine })))
            + &rows.collect::<String>()
    }

    /// The page, with what is known of other libraries.
    #[must_use]
    pub fn page(&self, peers: Option<&Peers>) -> String {
        page::page(self, peers)
    }

    /// The tables as Markdown, each under the command that makes it: those of a README.
    #[must_use]
    pub fn tables(&self) -> String {
        let mut text = format!("## Who gets where\n\n{}", page::summary(self).markdown());
        for (name, rows) in analysis::subjects(self.measured(Chapter::Scenes)) {
            let table = chapter_scenes::time_to_error(&analysis::lines(&rows));
            text += &format!("\n## Time to an error: {name}\n\n{}", table.markdown());
        }
        for (title, table) in [
            ("What was left out", chapter_tables::left_out_table(self)),
            ("The sources' tables", chapter_tables::published_table(self)),
        ] {
            text += &format!("\n## {title}\n\n{}", table.markdown());
        }
        text
    }

    /// The rows of one chapter that measure an error.
    fn measured(&self, chapter: Chapter) -> impl Iterator<Item = &Measured> {
        self.rows.iter().filter_map(move |row| match row {
            Row::Measured(row) if row.chapter == chapter => Some(row),
            _ => None,
        })
    }

    /// The subjects of a chapter.
    fn subjects(&self, chapter: Chapter) -> Vec<&str> {
        analysis::subjects(self.measured(chapter)).into_iter().map(|(name, _)| name).collect()
    }
}

#[cfg(test)]
mod tests;
