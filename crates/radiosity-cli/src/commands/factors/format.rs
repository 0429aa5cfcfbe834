//! Rows of form factors as text.
use super::matrix::Found;
use super::row::{Entry, Row};
use crate::digits::six_digits;
use crate::json;
use serde_json::{Value, json};
use std::fmt::Write;

/// What is printed. Receivers are numbered from 1.
#[derive(Debug)]
pub(super) struct Table<'t> {
    pub(super) found: &'t Found,
    /// Of factors from area to area.
    pub(super) tolerance: Option<f64>,
}

impl Table<'_> {
    fn name(&self, receiver: usize) -> &str {
        &self.found.names[receiver]
    }

    /// Columns for people; a row's factors that are 0 are left out where there are several rows.
    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        for row in self.found.rows.iter() {
            // Writing to a string cannot fail.
            if let Some(patch) = row.from {
                let _ = writeln!(text, "from {} {}", patch + 1, self.name(patch));
            }
            for entry in row.entries.iter().filter(|entry| row.from.is_none() || entry.value != 0.0) {
                let (number, name) = (entry.to + 1, self.name(entry.to));
                let _ = writeln!(text, "{number:>5} {name:<24} {:<24} ± {:.1e}", entry.value, entry.error);
            }
            let (sum, error) = row.sum();
            let _ = writeln!(text, "      {:<24} {sum:<24} ± {error:.1e}", "sum");
        }
        text
    }

    /// A line for every factor that is not 0.
    pub(super) fn csv(&self) -> String {
        let header = ["from_number", "from", "to_number", "to", "form_factor", "error", "row_sum"];
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut write = |row: &[String]| writer.write_record(row).expect("all rows have the header's length");
        write(&header.map(Into::into));
        for row in self.found.rows.iter() {
            let (sum, _) = row.sum();
            let (number, name) = row.from.map_or((0, "point"), |patch| (patch + 1, self.name(patch)));
            for entry in row.entries.iter().filter(|entry| entry.value != 0.0) {
                write(&[
                    number.to_string(),
                    name.to_owned(),
                    (entry.to + 1).to_string(),
                    self.name(entry.to).to_owned(),
                    entry.value.to_string(),
                    entry.error.to_string(),
                    sum.to_string(),
                ]);
            }
        }
        let bytes = writer.into_inner().expect("memory takes what is written");
        String::from_utf8(bytes).expect("names and numbers are text")
    }

    /// Of a point `{"rows": […], "sum"}`; of patches `{"tolerance", "rows": [{"from", "number", "area", "factors", "sum"}]}`.
    pub(super) fn json(&self) -> String {
        if let Some(row) = self.found.rows.iter().next().filter(|row| row.from.is_none()) {
            let (sum, error) = row.sum();
            return json::line(&json!({"rows": self.entries(&row), "sum": sum, "error_bound": error}));
        }
        let rows = self.found.rows.iter().filter_map(|row| Some((row.from?, row)));
        let rows: Vec<Value> = rows
            .map(|(patch, row)| {
                let (sum, error) = row.sum();
                let area = self.found.areas[patch];
                json!({
                    "from": self.name(patch), "number": patch + 1, "area": area,
                    "factors": self.entries(&row), "sum": sum, self.error(): error,
                })
            })
            .collect();
        json::line(&json!({"tolerance": self.tolerance, "rows": rows}))
    }

    fn entries(&self, row: &Row) -> Vec<Value> {
        let entry = |entry: &Entry| {
            let (name, number) = (self.name(entry.to), entry.to + 1);
            json!({"name": name, "number": number, "form_factor": entry.value, self.error(): entry.error})
        };
        row.entries.iter().map(entry).collect()
    }

    /// From a point the error is bounded, from an area it is estimated.
    fn error(&self) -> &'static str {
        if self.tolerance.is_some() { "error_estimate" } else { "error_bound" }
    }

    /// View3D's format 0: a header of 30 characters, the areas to six digits, the rows to six decimals, the emittances to three;
    /// obstructions and space are left out.
    pub(super) fn view3d(&self) -> String {
        let Found { areas, emittances, rows, is_closed, is_gray, .. } = self.found;
        let [closed, gray] = [*is_closed, *is_gray].map(u8::from);
        let header = format!("View3D 4.0.0 0 {closed} {gray} {}", rows.len());
        let line = |numbers: &mut dyn Iterator<Item = String>| numbers.collect::<Vec<_>>().join(" ");
        let mut lines = vec![format!("{header:<30}"), line(&mut areas.iter().map(|area| six_digits(*area)))];
        let row = |row: &Row| line(&mut (0..rows.len()).map(|to| format!("{:.6}", row.to(to))));
        lines.extend(rows.iter().map(|from| row(&from)));
        lines.push(line(&mut emittances.iter().map(|emittance| format!("{emittance:.3}"))));
        lines.join("\n") + "\n"
    }
}
