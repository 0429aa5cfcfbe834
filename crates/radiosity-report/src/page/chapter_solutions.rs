//! The chapter of whole solutions: true error against time.
use super::escape::escape;
use super::marker::Sign;
use super::plot::{Curve, Plot};
use super::section::Section;
use super::style::style;
use super::table::{Table, error, percent, seconds};
use super::work_precision::{curve, every, largest, mean, signed};
use crate::analysis::{Line, lines, subjects};
use crate::results::Report;
use crate::rows::{Chapter, Deviation, Measured};

const INTRO: &str = "<p>How far a whole solution is from the truth: the mean irradiance of each face in red, green and blue, against \
    path tracing with millions of paths a face. An error counts in units of what the face receives, or of 1 % of what faces \
    receive on average, if that is more. Methods solve on equal elements, finer from point to point, until the \
    discrete system is solved to 0.1 %: what is drawn is the error of the mesh and of how finely its light is sent, of which that \
    bound says nothing. <em>Levels</em> ask for an error (<code>--error</code>) instead of a mesh. Path tracing is that of this report, the same number of paths from every face; it finds these means and \
    nothing else, where a solution holds the light of every element, and its error is chance, so that its points scatter. <em>Mitsuba</em> stands beside it where Python has \
    that (<code>pip install mitsuba</code>): its path tracer, started from the same faces by its sensor of irradiance, which meets lamps by chance alone; without the time to load a scene. Below the \
    dotted line errors drown in those of the reference.</p>\n";

/// The errors for which the time is asked.
const TARGETS: [f64; 3] = [0.1, 0.03, 0.01];

/// Nothing where no solution was measured.
pub(crate) fn section(report: &Report) -> Section {
    let body = subjects(report.measured(Chapter::Solutions))
        .into_iter()
        .map(|(name, rows)| of_scene(report, name, &rows));
    Section::new(["solutions", "Whole solutions"], body.collect()).opened_by(INTRO)
}

/// The table of each scene, by name.
pub(crate) fn tables(report: &Report) -> Vec<(&str, Table)> {
    let scenes = subjects(report.measured(Chapter::Solutions)).into_iter();
    scenes.map(|(name, rows)| (name, table(&lines(&rows)))).collect()
}

fn of_scene(report: &Report, name: &str, rows: &[&Measured]) -> String {
    let lines = lines(rows);
    let noise = report.noise.iter().find(|(scene, _)| scene == name).map(|(_, noise)| *noise);
    let plot = |what: &str, error_of: fn(&Measured) -> f64, level: fn(Deviation) -> f64| {
        let curves = lines.iter().map(|line| curve(line, error_of)).chain(noise.map(level).map(reference));
        Plot {
            title: format!("{name}: {what} error of a face against time"),
            x: "CPU time of a solution (s)",
            y: &format!("{what} error of a face's light"),
            curves: curves.collect(),
        }
        .html()
    };
    let plots = plot("largest", largest, |noise| noise.max) + &plot("mean", mean, |noise| noise.mean);
    format!(
        "<h3>{}</h3>\n<p>{}</p>\n<div class=\"plots\">\n{plots}</div>\n{}<details><summary>every setting</summary>\n{}</details>\n",
        escape(name),
        escape(&sentence(&lines)),
        table(&lines).html(),
        every(rows).html()
    )
}

/// The level of the reference's own standard error.
fn reference(level: f64) -> Curve {
    Curve {
        sign: Sign::Measured(style("reference")),
        name: "standard error of the reference".to_owned(),
        note: String::new(),
        points: Vec::new(),
        floor: Some(level),
    }
}

/// The most exact solution, and what else.
fn sentence(lines: &[Line<'_>]) -> String {
    let rows = || lines.iter().flat_map(|line| &line.rows);
    let Some(best) = rows().min_by(|a, b| a.error.max.total_cmp(&b.error.max)) else { return String::new() };
    format!(
        "Best here: {} ({}), {} on its worst face and {} on average, in {} of CPU.",
        best.series,
        best.setting,
        percent(best.error.max),
        percent(best.error.mean),
        seconds(best.time.cpu.median)
    )
}

/// Times to errors of the worst face, and how errors fall.
fn table(lines: &[Line<'_>]) -> Table {
    let header = [
        "method",
        "to 10 %",
        "to 3 %",
        "to 1 %",
        "smallest error, in",
        "slope",
        "mean there",
        "slope of the mean",
    ];
    let mut table = Table::new(header);
    for line in lines {
        let time = |target| line.time_to(target).map_or_else(|| "–".to_owned(), seconds);
        let slope =
            |error_of: fn(&Measured) -> f64| line.slope(error_of).map_or_else(|| "–".to_owned(), signed);
        let Some(best) = line.rows.iter().min_by(|a, b| a.error.max.total_cmp(&b.error.max)) else {
            continue;
        };
        let [a, b, c] = TARGETS.map(time);
        let smallest = format!("{}, {}", error(best.error.max), seconds(best.time.cpu.median));
        let there = error(best.error.mean);
        table.push([line.name.to_owned(), a, b, c, smallest, slope(largest), there, slope(mean)]);
    }
    table
}
