//! The chapters of points, of stability, of solvers and of Booleans.
use super::marker::Sign;
use super::plot::{Curve, Plot, Point};
use super::section::Section;
use super::table::{error, seconds};
use super::work_precision::{OF_A_POINT, against_time, every, largest, time_to_error};
use super::{escape::escape, style::style};
use crate::analysis::{Line, lines, subjects};
use crate::methods::EXACT;
use crate::results::Report;
use crate::rows::{Chapter, Measured};

/// Points whose form factors are known to 34 digits: error against time, by kind.
pub(crate) fn points(report: &Report) -> Section {
    let intro = "Single points with references of 34 digits. Some targets are nearly hidden, far, thin, or seen at a \
                 grazing angle. Here the error of the exact method is measured like that of the others.";
    let section = |(kind, rows): (&str, Vec<&Measured>)| {
        let lines = lines(&rows);
        let plot = against_time(
            &lines,
            &format!("{kind}: largest error against time"),
            [OF_A_POINT, "largest error of F"],
            largest,
        );
        let tables = time_to_error(&lines).html()
            + "<details><summary>every setting</summary>\n"
            + &every(&rows).html();
        format!("<div>{plot}{tables}</details></div>\n")
    };
    chapter(
        ["points", "Points by kind", intro],
        subjects(report.measured(Chapter::Points)).into_iter().map(section),
    )
}

/// Form factors along axes of stress.
pub(crate) fn stability(report: &Report) -> Section {
    let intro = "Two or more boards hide a target except for a rectangle, whose form factor has a closed form without \
                 cancellation. The error is relative. Each method has one setting.";
    along_axes(
        report,
        Chapter::Stability,
        ["stability", "Stability of form factors", intro],
        "relative error of F",
        "CPU time (s)",
    )
}

/// Solvers on stiff rooms.
pub(crate) fn solvers(report: &Report) -> Section {
    let intro = "Every solver runs to a tolerance of 1e-8, with whole patches as elements and form factors computed \
                 before. In the furnace the radiosity is 1 everywhere. In the cube each solver is compared with the exact \
                 solution of its own system, the full matrix with itself. A solver that stops at its limit of shots shows its \
                 error at that point.";
    along_axes(
        report,
        Chapter::Solvers,
        ["solvers", "Solvers on stiff scenes", intro],
        "largest relative error of B",
        "CPU time of a solution (s)",
    )
}

/// Polygon Booleans.
pub(crate) fn booleans(report: &Report) -> Section {
    let rows: Vec<&Measured> = report.measured(Chapter::Booleans).collect();
    let invalid = rows.iter().filter(|row| row.valid == Some(false)).count();
    let checked =
        format!("<p>polycsg on raw rings: {} results, {invalid} of them invalid.</p>\n", rows.len());
    let intro = "Results are compared with known areas and validated exactly.";
    let section = along_axes(
        report,
        Chapter::Booleans,
        ["booleans", "Stability of Booleans", intro],
        "relative error of the area",
        "CPU time (s)",
    );
    section.opened_by(&checked)
}

/// A chapter of plots, if there are any.
fn chapter([id, title, intro]: [&'static str; 3], plots: impl Iterator<Item = String>) -> Section {
    Section::plots([id, title], &format!("<p>{}</p>\n", escape(intro)), &plots.collect::<String>())
}

/// For each subject the error and the time along its axis.
fn along_axes(
    report: &Report,
    chapter_of: Chapter,
    texts: [&'static str; 3],
    wrong: &str,
    time: &str,
) -> Section {
    let section = |(axis, rows): (&str, Vec<&Measured>)| {
        let lines = lines(&rows);
        let errors = |row: &Measured| (row.error.max, error(row.error.max));
        let times = |row: &Measured| {
            let cpu = row.time.cpu;
            (cpu.median, format!("{}, {} – {}", seconds(cpu.median), seconds(cpu.low), seconds(cpu.high)))
        };
        along(&lines, axis, wrong, errors, bounds(&lines)) + &along(&lines, axis, time, times, None)
    };
    chapter(texts, subjects(report.measured(chapter_of)).into_iter().map(section))
}

/// One figure of every row along an axis.
fn along(
    lines: &[Line<'_>],
    axis: &str,
    y: &str,
    figure: impl Fn(&Measured) -> (f64, String),
    more: Option<Curve>,
) -> String {
    let curve = |line: &Line<'_>| {
        let point = |row: &&Measured| {
            let (value, hint) = figure(row);
            Point {
                x: row.amount,
                y: value,
                spread: None,
                hint: format!("{} {}: {hint}", row.series, row.setting),
            }
        };
        Curve {
            sign: Sign::Measured(style(line.name)),
            name: line.name.to_owned(),
            note: line.rows.first().map_or_else(String::new, |row| note(row)),
            points: line.rows.iter().map(point).collect(),
            floor: None,
        }
    };
    let curves = lines.iter().map(curve).chain(more).collect();
    Plot { title: format!("{y} along: {axis}"), x: axis, y, curves }.html()
}

/// What the exact method itself says of its error.
fn bounds(lines: &[Line<'_>]) -> Option<Curve> {
    let exact = lines.iter().find(|line| line.name == EXACT)?;
    let point = |row: &&Measured| {
        let hint = format!("bound: {}", error(row.bound?));
        Some(Point { x: row.amount, y: row.bound?, spread: None, hint })
    };
    Some(Curve {
        sign: Sign::Bound(style(EXACT)),
        name: EXACT.to_owned(),
        note: String::new(),
        points: exact.rows.iter().filter_map(point).collect(),
        floor: None,
    })
}

/// The setting, where it is the same along the axis.
fn note(row: &Measured) -> String {
    if row.chapter == Chapter::Stability { row.setting.clone() } else { String::new() }
}
