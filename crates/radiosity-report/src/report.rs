//! The report: measured, then written.
use crate::analysis::{lines, subjects};
use crate::machine::Machine;
use crate::measure::test_scene::TestScene;
use crate::measure::{
    booleans, cases, error_image::images, left_out, matrices, published, solutions, stiff, stress,
};
use crate::methods::{Step, middle, steps};
use crate::page::chapter_scenes::summary;
use crate::page::chapter_tables::{left_out_table, published_table};
use crate::page::{chapter_matrices, chapter_solutions};
use crate::page::{page, peers::Peers, work_precision::time_to_error};
use crate::plan::Plan;
use crate::results::Report;
use crate::rows::{Chapter, Measured, Row};
use radiosity::Error;

/// Measures what a plan says; `say` receives the name of each part before it starts. Nothing else should run on the machine.
///
/// ```no_run
/// use radiosity::scenes;
/// use radiosity_report::{Plan, report};
///
/// let beams = scenes::scene("beams").expect("a built-in scene");
/// let plan = Plan { scenes: vec![("beams".to_owned(), beams)], quick: true, general: false };
/// let report = report(&plan, |next| eprintln!("{next}"))?;
/// std::fs::write("report.html", report.page(None))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The errors of [`solve`](radiosity::solve()).
pub fn report(plan: &Plan, mut say: impl FnMut(&str)) -> Result<Report, Error> {
    let steps = steps(plan);
    let (mut rows, mut pictures) = (Vec::new(), Vec::new());
    for (name, scene) in &plan.scenes {
        say(name);
        let test_scene = TestScene::new(name, scene, plan.scaled(1500, 3))?;
        let set = test_scene.queries(plan.scaled(128, 3));
        rows.extend(set.measure(&steps, plan.rounds()).into_iter().map(Row::Measured));
        rows.extend(left_out::measure(&test_scene, plan.rounds())?);
        pictures.extend(images(&test_scene, &pictured(plan)));
    }
    if plan.general {
        rows.extend(general(plan, &steps, &mut say)?.into_iter().map(Row::Measured));
    }
    rows.extend(solutions::measure(plan, &mut say)?.into_iter().map(Row::Measured));
    rows.extend(published::measure(plan, say)?.into_iter().map(Row::Published));
    Ok(Report {
        rows,
        machine: Machine::here(),
        quick: plan.quick,
        images: pictures,
        noise: solutions::noise(plan),
    })
}

/// The measurements without a scene.
fn general(plan: &Plan, steps: &[Step], mut say: impl FnMut(&str)) -> Result<Vec<Measured>, Error> {
    let mut rows = Vec::new();
    say("points by kind");
    for set in cases::query_sets() {
        rows.extend(set.measure(steps, plan.rounds()));
    }
    say("stability of form factors");
    let middle = middle(plan);
    for (at, set) in stress::query_sets(plan) {
        let measured = set.measure(&middle, plan.rounds()).into_iter();
        rows.extend(measured.map(|row| Measured { amount: at, ..row }));
    }
    say("solvers on stiff scenes");
    rows.extend(stiff::measure(plan)?);
    say("stability of Booleans");
    rows.extend(booleans::measure(plan));
    rows.extend(matrices::measure(plan, say));
    Ok(rows)
}

/// The methods whose errors are drawn: the visibility index, and a hemicube.
fn pictured(plan: &Plan) -> Vec<Step> {
    let mut steps = middle(plan);
    steps.retain(|step| step.series.starts_with("visibility") || step.series == "hemicube");
    steps
}

impl Report {
    /// The rows as lines of JSON, after one line about the machine.
    #[must_use]
    pub fn lines(&self) -> String {
        let line =
            |text: serde_json::Result<String>| text.expect("plain numbers and names can be written") + "\n";
        let rows = self.rows.iter().map(|row| line(serde_json::to_string(row)));
        line(serde_json::to_string(&serde_json::json!({ "row": "machine", "machine": self.machine })))
            + &rows.collect::<String>()
    }

    /// The HTML page; with `peers`, it has a chapter on other libraries.
    #[must_use]
    pub fn page(&self, peers: Option<&Peers>) -> String {
        page(self, peers)
    }

    /// The tables as Markdown.
    #[must_use]
    pub fn tables(&self) -> String {
        let mut text = String::new();
        for (scene, table) in chapter_solutions::tables(self) {
            text += &format!("## Whole solutions: {scene}\n\n{}\n", table.markdown());
        }
        text += &format!("## Methods by scene\n\n{}", summary(self).markdown());
        for (name, rows) in subjects(self.measured(Chapter::Scenes)) {
            let table = time_to_error(&lines(&rows));
            text += &format!("\n## Time to an error: {name}\n\n{}", table.markdown());
        }
        for (room, table) in chapter_matrices::tables(self) {
            text += &format!("\n## Matrix of {room}\n\n{}", table.markdown());
        }
        for (title, table) in [
            ("Work saved", left_out_table(self)),
            ("Published tables, measured again", published_table(self)),
        ] {
            text += &format!("\n## {title}\n\n{}", table.markdown());
        }
        text
    }
}
