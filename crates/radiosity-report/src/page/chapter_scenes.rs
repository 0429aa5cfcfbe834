//! The chapter of scenes: error against time, pictures, and the time to an error.
use super::escape::escape;
use super::section::Section;
use super::table::{Table, error, percent, seconds};
use super::work_precision::{OF_A_POINT, against_time, every, largest, mean, time_to_error};
use crate::analysis::{Verdict, lines, subjects, verdict};
use crate::measure::error_image::scale;
use crate::results::Report;
use crate::rows::{Chapter, Measured};
use std::fmt::Write;

/// The scenes, each with an anchor, and a table of them all before.
pub(crate) fn section(report: &Report) -> Section {
    let scenes = subjects(report.measured(Chapter::Scenes));
    let body: String = scenes.iter().map(|(name, rows)| of_scene(report, name, rows)).collect();
    let links: String =
        scenes.iter().map(|(name, _)| format!("<a href=\"#{0}\">{0}</a>\n", escape(name))).collect();
    let opening = format!("{INTRO}<nav>{links}</nav>\n{}{}", summary(report).html(), scale());
    Section::new(["scenes", "Scenes"], body).opened_by(&opening)
}

const INTRO: &str = "<p>We query form factors from points of a scene, the centroids of its elements, to all of its emitters \
    together: the direct light. Half of the points see the emitters in part, where there are such points. The time is \
    that for one point. Every method sees the same polygons. The error is absolute; that of the exact method is its \
    own certified bound, so the true one is smaller. \
    A dotted line marks a floor: more work does not lower the error. Errors of less than 1e-17 are drawn at 1e-17.</p>\n";

/// Of the exact method's error on points, and of the errors that others must not reach in its time.
const CLAIMED: f64 = 1e-12;

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
fn of_scene(report: &Report, name: &str, rows: &[&Measured]) -> String {
    let lines = lines(rows);
    let mut text = format!("<h3 id=\"{0}\">{0}</h3>\n", escape(name));
    if let Some(verdict) = verdict(&lines) {
        let _ = writeln!(text, "<p>{}</p>", escape(&sentence(&verdict)));
    }
    if rows.iter().all(|row| row.in_part == Some(0)) {
        text +=
            "<p>None of the points sees the emitters in part: there are no edges of shadows to miss.</p>\n";
    }
    text += "<div class=\"pictures\">\n";
    for picture in report.images.iter().filter(|picture| picture.scene == name) {
        let (address, caption) = (&picture.address, escape(&picture.caption));
        let _ = writeln!(
            text,
            "<figure><img src=\"{address}\" alt=\"{caption}\"><figcaption>{caption}</figcaption></figure>"
        );
    }
    text += "</div>\n<div class=\"plots\">\n";
    let titled = |what: &str| format!("{name}: {what} error against time");
    text += &against_time(&lines, &titled("largest"), [OF_A_POINT, "largest error of F"], largest);
    text += &against_time(&lines, &titled("mean"), [OF_A_POINT, "mean error of F"], mean);
    text += "</div>\n";
    text += &time_to_error(&lines).html();
    text + "<details><summary>every setting</summary>\n" + &every(rows).html() + "</details>\n"
}

/// What the verdict says.
fn sentence(verdict: &Verdict<'_>) -> String {
    let [bound, time] = verdict.exact;
    let beaten = match verdict.beaten_by.as_slice() {
        [] => "no other method reaches 1e-6 in that time".to_owned(),
        [one] => format!("{one} reaches 1e-6 in that time too"),
        some => format!("{} reach 1e-6 in that time too", some.join(" and ")),
    };
    let quicker: Vec<String> = verdict
        .quicker
        .iter()
        .map(|(name, off, share)| format!("{name} ({} in {} of it)", error(*off), percent(*share)))
        .collect();
    let quicker = if quicker.is_empty() { "none".to_owned() } else { quicker.join("; ") };
    format!(
        "Exact: error below {} in {}; {beaten}. Quicker at an accuracy of their own: {quicker}.",
        error(bound),
        seconds(time)
    )
}
