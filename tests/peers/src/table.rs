//! The tables: Markdown for people, JSON lines for programs.

use crate::bench::{Figures, Row};
use crate::child::Failure;
use crate::{memory, scaling};
use serde_json::{Map, Value, json};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// A peer's areas further off than that share are wrong: its time does not count.
const GROSS: f64 = 1e-3;

impl Row {
    /// How far polycsg's areas are from those of i_overlay on its 64 bit grid, or of the first peer that has some.
    fn area_error(&self) -> Option<f64> {
        let fine = self.peers.iter().find(|peer| peer.engine == "i_overlay-i64");
        let outcomes = |figures: &'_ Figures| figures.outcome.clone();
        let reference = fine.and_then(outcomes).or_else(|| self.peers.iter().find_map(outcomes))?;
        Some(self.ours.iter().find_map(outcomes)?.error(&reference))
    }

    fn is_gross(&self, peer: &Figures) -> bool {
        let ours = self.ours.iter().find_map(|figures| figures.outcome.as_ref());
        ours.zip(peer.outcome.as_ref()).is_some_and(|(ours, its)| its.error(ours) > GROSS)
    }

    /// The fastest peer whose areas are right.
    fn fastest(&self) -> Option<(&'static str, f64)> {
        let right = self.peers.iter().filter(|peer| !self.is_gross(peer));
        let times = right.filter_map(|peer| Some((peer.engine, peer.seconds.clone().ok()?)));
        times.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// polycsg's time by one route over that of the fastest peer.
    fn ratio(&self, route: &Figures) -> Option<f64> {
        Some(route.seconds.clone().ok()? / self.fastest()?.1)
    }

    /// The same over the peer that the aim is about.
    fn rival_ratio(&self, route: &Figures) -> Option<f64> {
        let rival = self.peers.iter().find(|peer| Some(peer.engine) == self.workload.plan.rival)?;
        Some(route.seconds.clone().ok()? / rival.seconds.clone().ok()?)
    }

    /// The ratio that is aimed at, where the route is asked for one.
    fn limit(&self, route: &Figures) -> Option<f64> {
        self.workload.plan.routes.contains(&route.engine).then_some(self.workload.limit)
    }
}

/// Prints a row when it is done.
pub(crate) fn show(row: &Row, as_json: bool) {
    say(&if as_json { format!("{}\n", json_line(row)) } else { markdown_lines(row) });
}

/// Prints what all rows come to, beside JSON lines on stderr.
pub(crate) fn conclude(rows: &[Row], as_json: bool) {
    if as_json {
        eprint!("{}", summary(rows));
    } else {
        say(&summary(rows));
    }
}

fn say(text: &str) {
    // A closed pipe ends the output, not the run.
    let _ = write!(std::io::stdout(), "{text}");
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
    let seconds = |all: &[Figures]| -> Map<String, Value> {
        all.iter().map(|figures| (figures.engine.to_owned(), json!(figures.seconds.clone().ok()))).collect()
    };
    let named = |tell: fn(&Figures) -> Option<Value>| -> Map<String, Value> {
        row.all().filter_map(|figures| Some((figures.engine.to_owned(), tell(figures)?))).collect()
    };
    let ratios = |ratio: fn(&Row, &Figures) -> Option<f64>| -> Map<String, Value> {
        let asked = row.ours.iter().filter(|route| row.limit(route).is_some());
        asked.filter_map(|route| Some((route.engine.to_owned(), json!(ratio(row, route)?)))).collect()
    };
    json!({
        "workload": row.workload.name(),
        "op": row.op,
        "booleans": row.booleans,
        "edges": row.edges,
        "crossings": row.crossings,
        "cut": row.cut,
        "polycsg_s": row.ours.first().and_then(|route| route.seconds.clone().ok()),
        "routes": seconds(&row.ours),
        "peers": seconds(&row.peers),
        "fastest": row.fastest().map(|fastest| fastest.0),
        "ratios": ratios(Row::ratio),
        "rival": row.workload.plan.rival,
        "rival_ratios": ratios(Row::rival_ratio),
        "at_most": row.workload.limit,
        "area_error": row.area_error(),
        "valid": is_valid(row),
        "peak_bytes": named(|figures| figures.bytes.map(|bytes| json!(bytes))),
        "areas": named(|figures| figures.outcome.as_ref().map(|outcome| json!(outcome.areas.iter().sum::<f64>()))),
        "rings": named(|figures| figures.outcome.as_ref().map(|outcome| json!(outcome.rings))),
        "failures": named(|figures| figures.seconds.as_ref().err().map(|failure| json!(why(failure)))),
    })
}

fn is_valid(row: &Row) -> Option<bool> {
    let checks = row.ours.iter().filter_map(|figures| figures.outcome.as_ref()?.valid);
    checks.reduce(|a, b| a && b)
}

fn why(failure: &Failure) -> &str {
    match failure {
        Failure::Unfit => "unfit",
        Failure::Slow => "slow",
        Failure::Error(message) => message,
    }
}

fn markdown(rows: &[Row]) -> String {
    let mut text = String::from(
        "CPU time per Boolean, least of interleaved rounds, one thread. `slow`: over the time allowed for a call, or a smaller input\
         \nwas; `error`: refused or crashed; `!`: areas wrong by more than 1e-3, not counted in the ratio; `–`: not made for this.\n\n",
    );
    let groups = rows.chunk_by(|a, b| a.workload.group.title == b.workload.group.title);
    groups.for_each(|rows| text.push_str(&section(rows)));
    let _ = write!(
        text,
        "{}\n## Growth\n\nExponents of the time over edges plus crossings; in brackets the sizes that were done.\n\n{}\n## Memory\n\n{}",
        summary(rows),
        scaling::markdown(rows),
        memory::markdown(rows)
    );
    text
}

/// The rows of one group, with what selects them.
fn section(rows: &[Row]) -> String {
    let group = rows[0].workload.group;
    let only: Vec<String> = group.plans.iter().map(|plan| format!("--only {}", plan.family)).collect();
    let names: Vec<&str> = rows[0].peers.iter().map(|peer| peer.engine).collect();
    let head = format!(
        "| workload | op | from | edges | crossings | polycsg | ratio | fastest | at most | {} | area error | valid |",
        names.join(" | ")
    );
    let rule = "---|".repeat(head.matches('|').count() - 1);
    let lines: String = rows.iter().map(markdown_lines).collect();
    format!("### {}\n\n`{}`\n\n{head}\n|{rule}\n{lines}\n", group.title, only.join(" "))
}

/// The geometric mean of the ratios that are asked for, how many there are, and those above 1.
fn sum(rows: &[Row]) -> (f64, usize, Vec<String>) {
    let asked = rows.iter().flat_map(|row| row.ours.iter().map(move |route| (row, route)));
    let asked: Vec<_> = asked.filter(|(row, route)| row.limit(route).is_some()).collect();
    let ratios: Vec<f64> = asked.iter().filter_map(|(row, route)| row.ratio(route)).collect();
    let above = asked.iter().filter_map(|(row, route)| {
        let ratio = match row.ratio(route) {
            Some(ratio) if ratio <= 1.0 => return None,
            Some(ratio) => format!("{ratio:.2}"),
            None => time(route),
        };
        Some(format!("{} from {} {ratio}", row.workload.name(), route.engine))
    });
    let mean = ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / ratios.len() as f64;
    (mean.exp(), ratios.len(), above.collect())
}

fn summary(rows: &[Row]) -> String {
    let (mean, count, above) = sum(rows);
    let above = if above.is_empty() { "none".to_owned() } else { above.join(", ") };
    format!("Geometric mean of {count} ratios: {mean:.3}. Above 1, or without a ratio: {above}.\n")
}

/// A line for each route; the peers' figures stand in the first.
fn markdown_lines(row: &Row) -> String {
    let blank = || vec![String::new(); row.peers.len()];
    let lines = row.ours.iter().enumerate().map(|(i, route)| {
        let peers = if i == 0 { row.peers.iter().map(|peer| marked(row, peer)).collect() } else { blank() };
        markdown_line(row, route, &peers)
    });
    lines.collect()
}

fn marked(row: &Row, peer: &Figures) -> String {
    if row.is_gross(peer) { format!("{} !", time(peer)) } else { time(peer) }
}

fn markdown_line(row: &Row, route: &Figures, peers: &[String]) -> String {
    let crossings = row.crossings.map(|crossings| format!("{:.*}", usize::from(row.booleans > 1), crossings));
    let cut = row.cut.map(|cut| format!("{:.1} % cut", 100.0 * cut));
    format!(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
        row.workload.name(),
        row.op,
        route.engine,
        row.edges,
        crossings.or(cut).unwrap_or("–".to_owned()),
        time(route),
        number(row.ratio(route)),
        row.fastest().map_or("–", |fastest| fastest.0),
        aim(row, route),
        peers.join(" | "),
        row.area_error().map_or("–".to_owned(), |error| format!("{error:.0e}")),
        is_valid(row).map_or("–", |valid| if valid { "yes" } else { "NO" }),
    )
}

/// What is aimed at; where that is about one peer, its name and the ratio to it.
fn aim(row: &Row, route: &Figures) -> String {
    let limit = number(row.limit(route));
    let rival = row.workload.plan.rival.filter(|_| row.limit(route).is_some());
    rival.map_or(limit.clone(), |rival| format!("{limit} of {rival} (is {})", number(row.rival_ratio(route))))
}

fn number(number: Option<f64>) -> String {
    number.map_or("–".to_owned(), |number| format!("{number:.2}"))
}

/// Three digits and a unit.
fn time(figures: &Figures) -> String {
    let seconds = match &figures.seconds {
        Ok(seconds) => *seconds,
        Err(Failure::Unfit) => return "–".to_owned(),
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
