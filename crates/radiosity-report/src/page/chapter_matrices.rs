//! The chapter of matrices: whole rooms from area to area, error against time.
use super::escape::escape;
use super::section::Section;
use super::table::{Table, error, seconds};
use super::work_precision::{against_time, largest};
use crate::analysis::{Line, lines, subjects};
use crate::measure::matrices::POINTS;
use crate::results::Report;
use crate::rows::{Chapter, Measured};

/// Nothing where no matrix was measured.
pub(crate) fn section(report: &Report) -> Section {
    let rooms: String = rooms(report).iter().map(|(room, rows)| of_room(room, rows)).collect();
    Section::new(["matrices", "Matrices from area to area"], rooms).opened_by(
        "<p>All form factors of closed rooms: a cube of side 10, its walls in quads, \
         and boxes that touch nothing. <i>Area to area</i> is the cubature of the exact point factors; <i>points</i> are means of rows \
         from the middles of n × n parts of each surface, by other methods. Errors of entries are against area to area at 1e-7. Rows \
         should add to 1, which needs no reference; those from points do so whatever they miss, and are not drawn. Nothing is closed \
         or smoothed afterwards. View3D 4.0 was measured once: its \
         times are so many plain quads a pair, a plain quad is timed in this run.</p>\n",
    )
}

fn rooms(report: &Report) -> Vec<(&str, Vec<&Measured>)> {
    subjects(report.measured(Chapter::Matrices))
}

fn of_room(room: &str, rows: &[&Measured]) -> String {
    let lines = lines(rows);
    let of_areas: Vec<Line<'_>> =
        lines.iter().filter(|line| !line.name.starts_with(POINTS)).cloned().collect();
    let title = |what: &str| format!("{room}: {what}");
    let x = "CPU time of the matrix (s)";
    let plots = [
        against_time(&lines, &title("error of entries"), [x, "largest error of an entry"], largest),
        against_time(&of_areas, &title("error of rows"), [x, "largest |sum of a row − 1|"], defect),
    ];
    format!(
        "<h3>{}</h3>\n<div class=\"plots\">\n{}</div>\n<details><summary>every setting</summary>\n{}</details>\n",
        escape(room),
        plots.concat(),
        every(rows).html()
    )
}

/// Every setting of every room, by name.
pub(crate) fn tables(report: &Report) -> Vec<(&str, Table)> {
    rooms(report).into_iter().map(|(room, rows)| (room, every(&rows))).collect()
}

fn every(rows: &[&Measured]) -> Table {
    let mut table =
        Table::new(["method", "setting", "largest error of an entry", "mean", "of a row's sum", "CPU time"]);
    for row in rows {
        table.push([
            row.series.clone(),
            row.setting.clone(),
            error(row.error.max),
            error(row.error.mean),
            error(defect(row)),
            seconds(row.time.cpu.median),
        ]);
    }
    table
}

fn defect(row: &Measured) -> f64 {
    row.defect.unwrap_or_default()
}
