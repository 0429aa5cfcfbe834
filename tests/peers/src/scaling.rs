//! How times grow with the input.

use crate::bench::Row;
use std::fmt::Write;

/// For each kind of input in several sizes: the exponent of every engine's time, over edges plus crossings.
pub(crate) fn markdown(rows: &[Row]) -> String {
    let mut text = String::from(
        "| workload | edges | largest: ns per edge + crossing | exponents |\n|---|---|---|---|\n",
    );
    let mut start = 0;
    while start < rows.len() {
        let same =
            |row: &&Row| (row.workload.family, &row.op) == (rows[start].workload.family, &rows[start].op);
        let family: Vec<&Row> = rows.iter().filter(same).collect();
        let is_first = rows[..start].iter().all(|row| !same(&row));
        if is_first && family.len() > 1 {
            line(&family, &mut text);
        }
        start += 1;
    }
    text
}

fn line(family: &[&Row], text: &mut String) {
    let exponents: Vec<String> = (0..family[0].figures.len())
        .filter_map(|engine| {
            let points: Vec<(f64, f64)> = family.iter().filter_map(|row| point(row, engine)).collect();
            let name = family[0].figures[engine].engine;
            exponent(&points).map(|exponent| format!("{name} {exponent:.2} ({})", points.len()))
        })
        .collect();
    let [first, last] = [family[0], family[family.len() - 1]];
    let each = per_contact(last).map_or("–".to_owned(), |each| format!("{each:.0}"));
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "| {} {} | {} … {} | {each} | {} |",
        first.workload.family,
        first.op,
        first.edges,
        last.edges,
        exponents.join(", ")
    );
}

fn point(row: &Row, engine: usize) -> Option<(f64, f64)> {
    let size = row.edges + row.crossings?;
    let seconds = row.figures[engine].seconds.clone().ok()?;
    Some(((size as f64).ln(), seconds.ln()))
}

/// Nanoseconds of polycsg per edge and crossing.
pub(crate) fn per_contact(row: &Row) -> Option<f64> {
    let seconds = row.figures.first()?.seconds.clone().ok()?;
    Some(seconds * 1e9 / (row.edges + row.crossings?) as f64)
}

/// The slope of the straight line of least squares.
fn exponent(points: &[(f64, f64)]) -> Option<f64> {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let spread: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    let slope = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / spread;
    (points.len() > 1 && slope.is_finite()).then_some(slope)
}
