//! Other libraries' polygon Booleans, as measured elsewhere: JSON lines with `workload`, `op`, `edges`, `polycsg_s`, `peers`
//! (seconds by name, null for those that failed), `area_error` and `valid`.
use super::section::Section;
use super::table::{Table, error, seconds};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Times of other libraries.
#[derive(Clone, Debug, Default)]
pub struct Peers {
    lines: Vec<PeerLine>,
}

/// One input.
#[derive(Clone, Debug, Deserialize)]
struct PeerLine {
    workload: String,
    op: String,
    edges: u64,
    polycsg_s: Option<f64>,
    peers: BTreeMap<String, Option<f64>>,
    area_error: Option<f64>,
    valid: Option<bool>,
}

impl Peers {
    /// Reads the JSON lines that `tests/peers` writes.
    ///
    /// # Errors
    /// A message with the number of the first wrong line and the reason; or that there is no line.
    pub fn read(text: &str) -> Result<Peers, String> {
        let line = |(number, line): (usize, &str)| {
            serde_json::from_str(line).map_err(|error| {
                // The reader counts from the line that it was given.
                let (why, column) = (error.to_string(), error.column());
                let why = why.split(" at line ").next().unwrap_or_default();
                format!("line {}, column {column}: {why}", number + 1)
            })
        };
        let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        let lines = lines.map(line).collect::<Result<Vec<PeerLine>, String>>()?;
        if lines.is_empty() { Err("there is none".to_owned()) } else { Ok(Peers { lines }) }
    }

    /// Their chapter.
    pub(crate) fn section(&self) -> Section {
        let body = format!(
            "<p>Seconds of CPU time per call; – where a library was too \
             slow, refused, or failed. The error of the area is polycsg's.</p>\n{}",
            self.table().html()
        );
        Section::new(["peers", "Booleans beside other libraries"], body)
    }

    fn table(&self) -> Table {
        let mut names: Vec<&str> =
            self.lines.iter().flat_map(|line| line.peers.keys()).map(String::as_str).collect();
        names.sort_unstable();
        names.dedup();
        let first = ["input", "Boolean", "edges", "polycsg"];
        let last = ["error of the area", "valid"];
        let header = first.into_iter().chain(names.iter().copied()).chain(last).map(ToOwned::to_owned);
        let time = |time: Option<f64>| time.map_or_else(|| "–".to_owned(), seconds);
        let row = |line: &PeerLine| {
            let own = [line.workload.clone(), line.op.clone(), line.edges.to_string(), time(line.polycsg_s)];
            let others = names.iter().map(|name| time(line.peers.get(*name).copied().flatten()));
            let valid = line.valid.map_or("–", |valid| if valid { "yes" } else { "no" });
            let area = line.area_error.map_or_else(|| "–".to_owned(), error);
            let checks = [area, valid.to_owned()];
            own.into_iter().chain(others).chain(checks).collect()
        };
        Table { header: header.collect(), rows: self.lines.iter().map(row).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_library_gets_a_column_and_every_input_a_row() {
        let text = r#"{"workload":"a","op":"union","edges":7,"polycsg_s":2e-6,"peers":{"x":1e-6,"y":null},"area_error":0.0,"valid":true}
{"workload":"b","op":"union","edges":9,"polycsg_s":3e-3,"peers":{"z":1.0},"area_error":1e-16,"valid":null,"more":1}"#;
        let table = Peers::read(text).unwrap().table();
        assert_eq!(table.header[3..7], ["polycsg", "x", "y", "z"]);
        assert_eq!(table.rows[0][3..], ["2.00 µs", "1.00 µs", "–", "–", "0", "yes"]);
        assert_eq!(table.rows[1][3..], ["3.00 ms", "–", "–", "1.00 s", "1.0e-16", "–"]);
    }

    #[test]
    fn a_line_that_is_none_is_named() {
        let error = Peers::read("{\"workload\":1}").unwrap_err();
        assert!(error.starts_with("line 1, column 13: invalid type"), "{error}");
        let error = Peers::read("\n{}").unwrap_err();
        assert_eq!(error, "line 2, column 2: missing field `workload`");
        assert_eq!(Peers::read("\n").unwrap_err(), "there is none");
    }
}
