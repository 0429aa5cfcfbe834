//! The page: one HTML file with all plots, pictures and tables in it.
//!
//! ```text
//! chapter_scenes, chapter_axes, chapter_matrices,
//! chapter_tables, peers                                  the chapters
//! work_precision                                         error against time: the plot and its tables
//! plot, axis, style                                      plots as SVG
//! table                                                  tables as Markdown and as HTML
//! ```
mod axis;
mod chapter_axes;
pub(crate) mod chapter_matrices;
mod chapter_scenes;
pub(crate) mod chapter_tables;
mod escape;
pub(crate) mod peers;
mod plot;
mod style;
pub(crate) mod table;
pub(crate) mod work_precision;

use crate::analysis::{lines, subjects, verdict};
use crate::machine::Machine;
use crate::results::Report;
use crate::rows::Chapter;
use escape::escape;
use peers::Peers;
use table::{Table, error, seconds};

/// Of the exact method's error on points, and of the errors that others must not reach in its time.
const CLAIMED: f64 = 1e-12;

/// The whole page.
pub(crate) fn page(report: &Report, peers: Option<&Peers>) -> String {
    let chapters = [
        chapter_scenes::html(report),
        chapter_axes::points(report),
        chapter_axes::stability(report),
        chapter_axes::solvers(report),
        chapter_axes::booleans(report),
        chapter_matrices::html(report),
        peers.map(Peers::html).unwrap_or_default(),
        chapter_tables::left_out(report),
        chapter_tables::published(report),
    ];
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width\"><title>Error against time</title>\n\
         <style>\n{}</style></head><body>\n{}{}</body></html>\n",
        include_str!("page.css"),
        opening(report),
        chapters.concat()
    )
}

/// The title, the machine, the contents, and what the scenes show.
fn opening(report: &Report) -> String {
    let Machine { processor, cores, system, version, optimised } = &report.machine;
    let build = if *optimised { "" } else { ", built without optimisation: times mean little" };
    let extent = if report.quick { "quick" } else { "full" };
    let links: String = report
        .subjects(Chapter::Scenes)
        .iter()
        .map(|name| format!("<a href=\"#{0}\">{0}</a>\n", escape(name)))
        .collect();
    format!(
        "<h1>Error against time</h1>\n<p>Every method on every scene: how wrong it is, and what it cost. Times are process \
         CPU time, medians of interleaved rounds, with their spread as bars. radiosity {version}, {extent} report, {}, \
         {cores} threads, {}{build}. All figures are in <code>report.jsonl</code> beside this page.</p>\n\
         <nav>{links}</nav>\n{}",
        escape(processor),
        escape(system),
        summary(report).html()
    )
}

/// A line for each scene: whether the exact method is as exact as claimed, and who gets to 1e-6 in its time.
pub(crate) fn summary(report: &Report) -> Table {
    let mut table = Table::new([
        "scene",
        "see the emitters in part",
        "exact: error below",
        "in",
        "below 1e-12",
        "reach 1e-6 in that time",
    ]);
    for (name, rows) in subjects(report.measured(Chapter::Scenes)) {
        if let Some(verdict) = verdict(&lines(&rows)) {
            let [bound, time] = verdict.exact;
            let claimed = if bound < CLAIMED { "yes" } else { "no" };
            let beaten = verdict.beaten_by.join(", ");
            let beaten = if beaten.is_empty() { "none".to_owned() } else { beaten };
            let [in_part, points] =
                rows.iter().find_map(|row| Some([row.in_part?, row.points?])).unwrap_or_default();
            let in_part = format!("{in_part} of {points} points");
            table.push([name.to_owned(), in_part, error(bound), seconds(time), claimed.to_owned(), beaten]);
        }
    }
    table
}
