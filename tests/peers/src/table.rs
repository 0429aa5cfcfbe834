//! The tables: Markdown for people, JSON lines for programs.

use crate::bench::{Figures, Row};
use crate::child::Failure;
use crate::scaling;
use serde_json::{Map, Value, json};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// A peer's area further off than that share is wrong: its time does not count.
const GROSS: f64 = 1e-3;

impl Row {
    fn polycsg(&self) -> &Figures {
        &self.figures[0]
    }

    fn regions(&self) -> &Figures {
        &self.figures[1]
    }

    fn peers(&self) -> &[Figures] {
        &self.figures[2..]
    }

    /// The area's relative difference from that of i_overlay on its 64 bit grid, or of the first peer that has one.
    fn area_error(&self) -> Option<f64> {
        let area = |figures: &Figures| figures.outcome.as_ref().map(|outcome| outcome.area);
        let fine = self.peers().iter().find(|peer| peer.engine == "i_overlay-i64").and_then(area);
        let reference = fine.or_else(|| self.peers().iter().find_map(area))?;
        let difference = (area(self.polycsg())? - reference).abs();
        Some(if difference == 0.0 { 0.0 } else { difference / reference.abs() })
    }

    fn is_gross(&self, peer: &Figures) -> bool {
        let areas = self.polycsg().outcome.as_ref().zip(peer.outcome.as_ref());
        areas.is_some_and(|(ours, its)| {
            (ours.area - its.area).abs() > GROSS * ours.area.abs().max(its.area.abs())
        })
    }

    /// polycsg's time over that of the fastest rival whose area is right.
    fn ratio(&self) -> Option<f64> {
        let rivals = self.workload.rivals;
        let counts = |peer: &&Figures| rivals.is_empty() || rivals.contains(&peer.engine);
        let right = self.peers().iter().filter(counts).filter(|peer| !self.is_gross(peer));
        let fastest = right.filter_map(|peer| peer.seconds.clone().ok()).reduce(f64::min)?;
        Some(self.polycsg().seconds.clone().ok()? / fastest)
    }
}

/// Prints a row when it is done.
pub(crate) fn show(row: &Row, as_json: bool) {
    // A closed pipe ends the output, not the run.
    if as_json {
        let _ = writeln!(std::io::stdout(), "{}", json_line(row));
    } else {
        let _ = writeln!(std::io::stdout(), "{}", markdown_line(row));
    }
}

/// Writes peers.md and peers.jsonl, each whole or not at all.
pub(crate) fn write(rows: &[Row], folder: &Path) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let lines: String = rows.iter().map(|row| format!("{}\n", json_line(row))).collect();
    write_whole(&folder.join("peers.jsonl"), &lines)?;
    write_whole(&folder.join("peers.md"), &markdown(rows))
}

fn write_whole(path: &Path, text: &str) -> Result<(), String> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let write = || -> std::io::Result<()> {
        let mut file = tempfile::NamedTempFile::new_in(folder)?;
        file.write_all(text.as_bytes())?;
        file.persist(path)?;
        Ok(())
    };
    write().map_err(|error| format!("{}: {error}", path.display()))
}

fn json_line(row: &Row) -> Value {
    let seconds = |figures: &Figures| json!(figures.seconds.clone().ok());
    let peers: Map<String, Value> =
        row.peers().iter().map(|peer| (peer.engine.to_owned(), seconds(peer))).collect();
    let named = |tell: fn(&Figures) -> Option<Value>| -> Map<String, Value> {
        row.figures.iter().filter_map(|figures| Some((figures.engine.to_owned(), tell(figures)?))).collect()
    };
    json!({
        "workload": row.workload.name(),
        "edges": row.edges,
        "crossings": row.crossings,
        "op": row.op,
        "polycsg_s": seconds(row.polycsg()),
        "polycsg_regions_s": seconds(row.regions()),
        "peers": peers,
        "ratio": row.ratio(),
        "at_most": row.workload.limit,
        "area_error": row.area_error(),
        "valid": row.polycsg().outcome.as_ref().and_then(|outcome| outcome.valid),
        "peak_bytes": named(|figures| figures.bytes.map(|bytes| json!(bytes))),
        "areas": named(|figures| figures.outcome.as_ref().map(|outcome| json!(outcome.area))),
        "rings": named(|figures| figures.outcome.as_ref().map(|outcome| json!(outcome.rings))),
        "failures": named(|figures| figures.seconds.as_ref().err().map(|failure| json!(why(failure)))),
    })
}

fn why(failure: &Failure) -> &str {
    match failure {
        Failure::Slow => "slow",
        Failure::Error(message) => message,
    }
}

fn markdown(rows: &[Row]) -> String {
    let mut text = String::from(
        "CPU time per call, least of interleaved rounds, one thread. `slow`: over the time allowed for a call, or a smaller input was;\
         \n`error`: refused or crashed; `!`: area wrong by more than 1e-3, not counted in the ratio.\n\n",
    );
    let names: Vec<&str> =
        rows.first().map_or(vec![], |row| row.peers().iter().map(|peer| peer.engine).collect());
    let head = format!(
        "| workload | op | edges | crossings | polycsg | from regions | {} | ratio | at most | area error | valid |",
        names.join(" | ")
    );
    let columns = head.matches('|').count() - 1;
    let _ = writeln!(text, "{head}\n|{}", "---|".repeat(columns));
    rows.iter().for_each(|row| text.extend([markdown_line(row), "\n".to_owned()]));
    let _ = write!(
        text,
        "\n## Growth\n\nExponents of the time over edges plus crossings; in brackets the sizes that were done.\n\n"
    );
    text.push_str(&scaling::markdown(rows));
    text.push_str(&memory(rows));
    text
}

fn markdown_line(row: &Row) -> String {
    let peers: Vec<String> = row
        .peers()
        .iter()
        .map(|peer| if row.is_gross(peer) { format!("{} !", time(peer)) } else { time(peer) })
        .collect();
    let number = |number: Option<f64>| number.map_or("–".to_owned(), |number| format!("{number:.2}"));
    let valid = row.polycsg().outcome.as_ref().and_then(|outcome| outcome.valid);
    format!(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
        row.workload.name(),
        row.op,
        row.edges,
        row.crossings.map_or("–".to_owned(), |crossings| crossings.to_string()),
        time(row.polycsg()),
        time(row.regions()),
        peers.join(" | "),
        number(row.ratio()),
        number(row.workload.limit),
        row.area_error().map_or("–".to_owned(), |error| format!("{error:.0e}")),
        valid.map_or("–", |valid| if valid { "yes" } else { "NO" }),
    )
}

/// Three digits and a unit.
fn time(figures: &Figures) -> String {
    let seconds = match &figures.seconds {
        Ok(seconds) => *seconds,
        Err(Failure::Slow) => return "slow".to_owned(),
        Err(Failure::Error(_)) => return "error".to_owned(),
    };
    let (value, unit) = match seconds {
        s if s < 1e-3 => (s * 1e6, "µs"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    let digits = if value < 10.0 { 2 } else { usize::from(value < 100.0) };
    format!("{value:.digits$} {unit}")
}

/// The peak of each engine against what polycsg may use.
fn memory(rows: &[Row]) -> String {
    let mut text = String::from(
        "\n## Memory\n\nBytes that a call makes the process grow by; polycsg may use 250 an edge and 150 a crossing.\n\n",
    );
    text.push_str("| workload | op | allowed | measured |\n|---|---|---|---|\n");
    for row in rows.iter().filter(|row| row.figures.iter().any(|figures| figures.bytes.is_some())) {
        let megabytes = |bytes: u64| format!("{:.1} MB", bytes as f64 / 1e6);
        let measured: Vec<String> = row
            .figures
            .iter()
            .filter_map(|figures| Some(format!("{} {}", figures.engine, megabytes(figures.bytes?))))
            .collect();
        let allowed = row.crossings.map(|crossings| megabytes((250 * row.edges + 150 * crossings) as u64));
        let allowed = allowed.unwrap_or("–".to_owned());
        let _ =
            writeln!(text, "| {} | {} | {allowed} | {} |", row.workload.name(), row.op, measured.join(", "));
    }
    text
}
