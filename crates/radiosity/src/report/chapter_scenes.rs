//! The chapter of scenes: error against time, pictures, and the time to an error.
use super::Report;
use super::analysis::{Line, TARGETS, Verdict, lines, subjects, verdict};
use super::chapter_axes::style;
use super::plot::{Curve, Plot, Point, escape};
use super::portrait;
use super::row::{Chapter, Measured};
use super::table::{Table, error, percent, seconds};
use std::fmt::Write;

/// The scenes' sections, each with its anchor.
pub(super) fn html(report: &Report) -> String {
    let mut page = String::from(
        "<h2 id=\"scenes\">Scenes</h2>\n<p>Asked is the form factor from points of a scene, the centroids of its elements, \
         to all of its lamps together: the direct light; half of the points, where there are any, see the lamps in part. The time is that for one point. Every method sees the same \
         polygons. The error is absolute; that of the exact method is its own certified bound, so the true one is smaller. \
         A dotted line marks a floor: more work does not lower the error. Errors of less than 1e-17 are drawn at 1e-17.</p>\n",
    );
    page += &portrait::scale();
    for (name, rows) in subjects(report.measured(Chapter::Scenes)) {
        page += &section(report, name, &rows);
    }
    page
}

fn section(report: &Report, name: &str, rows: &[&Measured]) -> String {
    let lines = lines(rows);
    let mut text = format!("<h3 id=\"{0}\">{0}</h3>\n", escape(name));
    if let Some(verdict) = verdict(&lines) {
        let _ = writeln!(text, "<p>{}</p>", escape(&sentence(&verdict)));
    }
    if rows.iter().all(|row| row.in_part == Some(0)) {
        text += "<p>None of the points sees the lamps in part: there are no edges of shadows to miss.</p>\n";
    }
    text += "<div class=\"pictures\">\n";
    for picture in report.portraits.iter().filter(|picture| picture.scene == name) {
        let (address, caption) = (&picture.address, escape(&picture.caption));
        let _ = writeln!(
            text,
            "<figure><img src=\"{address}\" alt=\"{caption}\"><figcaption>{caption}</figcaption></figure>"
        );
    }
    text += "</div>\n<div class=\"plots\">\n";
    let titled = |what: &str| format!("{name}: {what} error against time");
    text += &against_time(&lines, &titled("largest"), "largest error of F", largest);
    text += &against_time(&lines, &titled("mean"), "mean error of F", mean);
    text += "</div>\n";
    text += &time_to_error(&lines).html();
    text + "<details><summary>every setting</summary>\n" + &every(rows).html() + "</details>\n"
}

/// A work-precision plot.
pub(super) fn against_time(
    lines: &[Line<'_>],
    title: &str,
    y: &str,
    error_of: impl Fn(&Measured) -> f64,
) -> String {
    let curve = |line: &Line<'_>| {
        let point = |row: &&Measured| Point {
            x: row.time.cpu.median,
            y: error_of(row),
            spread: Some([row.time.cpu.low, row.time.cpu.high]),
            hint: format!(
                "{} {}: {}, {}",
                row.series,
                row.setting,
                error(error_of(row)),
                seconds(row.time.cpu.median)
            ),
        };
        let floor = line.floor(&error_of);
        let slope = line.slope(&error_of).map(|slope| format!("slope {}", signed(slope)));
        let stuck = floor.map(|floor| format!("floor {}", error(floor)));
        Curve {
            style: style(line.name),
            name: line.name.to_owned(),
            note: slope.into_iter().chain(stuck).collect::<Vec<_>>().join(", "),
            points: line.rows.iter().map(point).collect(),
            floor,
        }
    };
    let curves = lines.iter().map(curve).collect();
    Plot { title: title.to_owned(), x: "CPU time for one point (s)", y, curves }.svg()
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

/// The time in which each method reaches some errors.
pub(super) fn time_to_error(lines: &[Line<'_>]) -> Table {
    let mut table =
        Table::new(["method", "to 1e-2", "to 1e-4", "to 1e-6", "smallest error, in", "slope", "floor"]);
    for line in lines {
        let [a, b, c] = TARGETS.map(|target| line.time_to(target).map_or_else(|| "–".to_owned(), seconds));
        let [best, time] = line.best();
        table.push([
            line.name.to_owned(),
            a,
            b,
            c,
            format!("{}, {}", error(best), seconds(time)),
            line.slope(largest).map_or_else(|| "–".to_owned(), signed),
            line.floor(largest).map_or_else(|| "–".to_owned(), error),
        ]);
    }
    table
}

/// Every row.
pub(super) fn every(rows: &[&Measured]) -> Table {
    let header = [
        "method",
        "setting",
        "largest error",
        "mean",
        "beyond 1e-3",
        "CPU",
        "CPU, from – to",
        "wall",
        "rounds",
    ];
    let mut table = Table::new(header);
    for row in rows {
        let (cpu, wall) = (row.time.cpu, row.time.wall);
        table.push([
            row.series.clone(),
            row.setting.clone(),
            error(row.error.max),
            error(row.error.mean),
            percent(row.error.beyond),
            seconds(cpu.median),
            format!("{} – {}", seconds(cpu.low), seconds(cpu.high)),
            seconds(wall.median),
            row.time.rounds.to_string(),
        ]);
    }
    table
}

/// The largest error, and the mean: what plots are of.
pub(super) fn largest(row: &Measured) -> f64 {
    row.error.max
}

fn mean(row: &Measured) -> f64 {
    row.error.mean
}

/// With a sign as long as the digits.
fn signed(value: f64) -> String {
    format!("{value:.2}").replace('-', "−")
}
