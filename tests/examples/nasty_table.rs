//! Prints, as Markdown, how polycsg fares on every kind of nasty input.
//!
//! `cargo run --release -p tests --example nasty_table [-- INPUTS]`; 30 inputs of each kind by default.
use tests::generators::KINDS;
use tests::survey::{Row, survey};

#[expect(clippy::print_stdout, reason = "the table is this program's output")]
fn main() -> Result<(), String> {
    let inputs = match std::env::args().nth(1) {
        None => 30,
        Some(text) => text.parse().map_err(|e| format!("{text} is no number of inputs: {e}"))?,
    };
    println!(
        "| kind | evaluations | panics | invalid | gross | lost | strayed | repaired | area off / rounding | slowest |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    let mut failures = Vec::new();
    for row in (0..KINDS.len()).map(|kind| survey(kind, inputs)) {
        println!("{}", line(&row));
        failures.extend(row.failures);
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

fn line(row: &Row) -> String {
    let Row { kind, evaluations, panics, invalid, gross, lost, strayed, repaired, worst, slowest, .. } = row;
    let micros = slowest.as_micros();
    format!(
        "| {kind} | {evaluations} | {panics} | {invalid} | {gross} | {lost} | {strayed} | {repaired} | {worst:.2} | {micros} µs |"
    )
}
