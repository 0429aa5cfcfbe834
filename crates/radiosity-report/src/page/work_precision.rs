//! Error against time: the plot, and its figures as tables.
use super::marker::Sign;
use super::plot::{Curve, Plot, Point};
use super::style::style;
use super::table::{Table, error, percent, seconds};
use crate::analysis::{Line, TARGETS};
use crate::rows::Measured;

/// Where rows are of points.
pub(crate) const OF_A_POINT: &str = "CPU time for one point (s)";

/// A work-precision plot, with what its axes show.
pub(crate) fn against_time(
    lines: &[Line<'_>],
    title: &str,
    [x, y]: [&str; 2],
    error_of: impl Fn(&Measured) -> f64,
) -> String {
    let curves = lines.iter().map(|line| curve(line, &error_of)).collect();
    Plot { title: title.to_owned(), x, y, curves }.html()
}

/// A method's errors against its times, with slope and floor in the key.
pub(crate) fn curve(line: &Line<'_>, error_of: impl Fn(&Measured) -> f64) -> Curve {
    let point = |row: &&Measured| {
        let (off, time) = (error(error_of(row)), row.time.cpu);
        Point {
            x: time.median,
            y: error_of(row),
            spread: Some([time.low, time.high]),
            hint: format!("{} {}: {}{off}, {}", row.series, row.setting, below(row), seconds(time.median)),
        }
    };
    let floor = line.floor(&error_of);
    let slope = line.slope(&error_of).map(|slope| format!("slope {}", signed(slope)));
    let stuck = floor.map(|floor| format!("floor {}", error(floor)));
    let certified = line.rows.iter().any(|row| row.certified);
    let own = style(line.name);
    Curve {
        sign: if certified { Sign::Bound(own) } else { Sign::Measured(own) },
        name: line.name.to_owned(),
        note: slope.into_iter().chain(stuck).collect::<Vec<_>>().join(", "),
        points: line.rows.iter().map(point).collect(),
        floor,
    }
}

/// The time in which each method reaches some errors.
pub(crate) fn time_to_error(lines: &[Line<'_>]) -> Table {
    let mut table =
        Table::new(["method", "to 1e-2", "to 1e-4", "to 1e-6", "smallest error, in", "slope", "floor"]);
    for line in lines {
        let [a, b, c] = TARGETS.map(|target| line.time_to(target).map_or_else(|| "–".to_owned(), seconds));
        let [best, time] = line.best();
        let below = line.rows.first().map_or("", |row| below(row));
        table.push([
            line.name.to_owned(),
            a,
            b,
            c,
            format!("{below}{}, {}", error(best), seconds(time)),
            line.slope(largest).map_or_else(|| "–".to_owned(), signed),
            line.floor(largest).map_or_else(|| "–".to_owned(), error),
        ]);
    }
    table
}

/// Every row.
pub(crate) fn every(rows: &[&Measured]) -> Table {
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
            format!("{}{}", below(row), error(row.error.max)),
            format!("{}{}", below(row), error(row.error.mean)),
            percent(row.error.beyond),
            seconds(cpu.median),
            format!("{} – {}", seconds(cpu.low), seconds(cpu.high)),
            seconds(wall.median),
            row.time.rounds.to_string(),
        ]);
    }
    table
}

/// What stands before an error that is a bound.
pub(crate) fn below(row: &Measured) -> &'static str {
    if row.certified { "≤ " } else { "" }
}

/// The largest error, and the mean: what plots are of.
pub(crate) fn largest(row: &Measured) -> f64 {
    row.error.max
}

pub(crate) fn mean(row: &Measured) -> f64 {
    row.error.mean
}

/// With a sign as long as the digits.
pub(crate) fn signed(value: f64) -> String {
    format!("{value:.2}").replace('-', "−")
}
