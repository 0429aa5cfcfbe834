//! Peak memory against what polycsg may use.

use crate::bench::{Figures, Row};
use std::fmt::Write;

/// Bytes that polycsg may use for an edge and for a crossing.
const ALLOWED: [f64; 2] = [250.0, 150.0];

/// A line for each input that was large enough.
pub(crate) fn markdown(rows: &[Row]) -> String {
    let mut text = String::from(
        "Bytes that a call makes the process grow by; polycsg may use 250 an edge and 150 a crossing.\
         \n\n| workload | allowed | polycsg | over allowed | bytes an edge + crossing | peers |\n|---|---|---|---|---|---|\n",
    );
    rows.iter().filter_map(line).for_each(|line| text.push_str(&line));
    text
}

fn line(row: &Row) -> Option<String> {
    let measured = |all: &[Figures]| -> Vec<String> {
        all.iter()
            .filter_map(|figures| Some(format!("{} {}", figures.engine, megabytes(figures.bytes?))))
            .collect()
    };
    let ours = row.ours.iter().find_map(|figures| figures.bytes)? as f64;
    let allowed = row.crossings.map(|crossings| ALLOWED[0] * row.edges as f64 + ALLOWED[1] * crossings);
    let over = |base: Option<f64>, digits: usize| {
        base.map_or("–".to_owned(), |base| format!("{:.digits$}", ours / base))
    };
    let (share, each) = (over(allowed, 2), over(row.size(), 0));
    let mut line = String::new();
    // Writing to a string does not fail.
    let _ = writeln!(
        line,
        "| {} | {} | {} | {share} | {each} | {} |",
        row.workload.name(),
        allowed.map_or("–".to_owned(), |allowed| format!("{:.1} MB", allowed / 1e6)),
        measured(&row.ours).join(", "),
        measured(&row.peers).join(", "),
    );
    Some(line)
}

fn megabytes(bytes: u64) -> String {
    format!("{:.1} MB", bytes as f64 / 1e6)
}
