//! The page: one HTML file with all plots, pictures and tables in it.
//!
//! ```text
//! overview                                               what it comes to: a sentence and a plot
//! chapter_solutions, chapter_scenes, chapter_axes,
//! chapter_matrices, chapter_tables, peers                the chapters
//! section                                                a chapter's anchor, title and body
//! work_precision                                         error against time: the plot and its tables
//! plot, axis, marker, style                              plots as SVG
//! table                                                  tables as Markdown and as HTML
//! ```
mod axis;
mod chapter_axes;
pub(crate) mod chapter_matrices;
pub(crate) mod chapter_scenes;
pub(crate) mod chapter_solutions;
pub(crate) mod chapter_tables;
mod escape;
mod marker;
mod overview;
pub(crate) mod peers;
mod plot;
mod section;
mod style;
pub(crate) mod table;
pub(crate) mod work_precision;

use crate::machine::Machine;
use crate::results::Report;
use escape::escape;
use peers::Peers;
use section::Section;

/// The whole page.
pub(crate) fn page(report: &Report, peers: Option<&Peers>) -> String {
    let chapters = [
        chapter_solutions::section(report),
        chapter_scenes::section(report),
        chapter_axes::points(report),
        chapter_axes::stability(report),
        chapter_axes::solvers(report),
        chapter_axes::booleans(report),
        chapter_matrices::section(report),
        peers.map(Peers::section).unwrap_or_default(),
        chapter_tables::left_out(report),
        chapter_tables::published(report),
    ];
    let links: String = chapters.iter().map(Section::link).collect();
    let bodies: String = chapters.iter().map(Section::html).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width\"><title>Error against time</title>\n\
         <style>\n{}</style></head><body>\n<h1>Error against time</h1>\n{}<nav class=\"chapters\">{links}</nav>\n{}{bodies}</body></html>\n",
        include_str!("page.css"),
        overview::html(report),
        measured_how(report),
    )
}

/// How times were taken, and on which machine.
fn measured_how(report: &Report) -> String {
    let Machine { processor, cores, system, version, optimised } = &report.machine;
    let build = if *optimised { "" } else { ", built without optimisation: times mean little" };
    let extent = if report.quick { "quick" } else { "full" };
    format!(
        "<p class=\"how\">Times are process CPU time, medians of interleaved rounds, with their spread as bars. \
         radiosity {version}, {extent} report, {}, {cores} threads, {}{build}. All figures are in <code>report.jsonl</code> \
         beside this page.</p>\n",
        escape(processor),
        escape(system),
    )
}
