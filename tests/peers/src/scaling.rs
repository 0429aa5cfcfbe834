//! How times grow with the input.

use crate::bench::{Figures, Row};
use std::fmt::Write;

/// For each kind of input in several sizes: the exponent of every engine's time, over edges plus crossings.
pub(crate) fn markdown(rows: &[Row]) -> String {
    let mut text = String::from(
        "| workload | edges | polycsg, largest: ns per edge + crossing | polycsg: largest rise of ns per edge to the next size | exponents |\
         \n|---|---|---|---|---|\n",
    );
    for family in rows.chunk_by(|a, b| a.workload.plan.family == b.workload.plan.family) {
        if family.len() > 1 {
            line(family, &mut text);
        }
    }
    text
}

fn line(family: &[Row], text: &mut String) {
    let (first, last) = (&family[0], &family[family.len() - 1]);
    let exponents: Vec<String> = (0..first.all().count())
        .filter_map(|engine| {
            let points: Vec<(f64, f64)> = family.iter().filter_map(|row| point(row, engine)).collect();
            let name = first.all().nth(engine)?.engine;
            exponent(&points).map(|exponent| format!("{name} {exponent:.2} ({})", points.len()))
        })
        .collect();
    let each = last.ours.first().and_then(seconds).zip(last.size()).map(|(time, size)| 1e9 * time / size);
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "| {} | {} … {} | {} | {} | {} |",
        first.workload.plan.family,
        first.edges,
        last.edges,
        each.map_or("–".to_owned(), |each| format!("{each:.0}")),
        rise(family).map_or("–".to_owned(), |rise| format!("{rise:.2}")),
        exponents.join(", ")
    );
}

fn seconds(figures: &Figures) -> Option<f64> {
    figures.seconds.clone().ok()
}

/// By how much polycsg's time per edge rises at most from one size to the next.
fn rise(family: &[Row]) -> Option<f64> {
    let each = |row: &Row| Some(seconds(row.ours.first()?)? / row.edges as f64);
    family.windows(2).filter_map(|pair| Some(each(&pair[1])? / each(&pair[0])?)).reduce(f64::max)
}

fn point(row: &Row, engine: usize) -> Option<(f64, f64)> {
    Some((row.size()?.ln(), seconds(row.all().nth(engine)?)?.ln()))
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
