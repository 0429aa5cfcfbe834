//! Rows of form factors as text.
use super::matrix::{Entry, Row};
use crate::json;
use radiosity::Scene;
use serde_json::{Value, json};
use std::fmt::Write;

/// What is printed. Patches are numbered from 1.
#[derive(Debug)]
pub(super) struct Table<'t> {
    pub(super) scene: &'t Scene,
    pub(super) rows: &'t [Row],
    /// Of factors from area to area.
    pub(super) tolerance: Option<f64>,
}

impl Table<'_> {
    fn name(&self, patch: usize) -> &str {
        &self.scene.patches[patch].name
    }

    /// Columns for people; a row's factors that are 0 are left out where there are several rows.
    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        for row in self.rows {
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
        for row in self.rows {
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
        String::from_utf8(writer.into_inner().expect("memory takes what is written"))
            .expect("names and numbers are UTF-8")
    }

    /// Of a point `{"rows": […], "sum"}`; of patches `{"tolerance", "rows": [{"from", "number", "area", "factors", "sum"}]}`.
    pub(super) fn json(&self) -> String {
        if let [row @ Row { from: None, .. }] = self.rows {
            let (sum, error) = row.sum();
            return json::line(&json!({"rows": self.entries(row), "sum": sum, "error_bound": error}));
        }
        let rows = self.rows.iter().filter_map(|row| Some((row.from?, row)));
        let rows: Vec<Value> = rows
            .map(|(patch, row)| {
                let (sum, error) = row.sum();
                let area = self.scene.patches[patch].polygon.area();
                json!({
                    "from": self.name(patch), "number": patch + 1, "area": area,
                    "factors": self.entries(row), "sum": sum, self.error(): error,
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

    /// View3D's format 0: a header of 30 characters, the areas, the rows, the emittances; obstructions are left out.
    pub(super) fn view3d(&self) -> String {
        let patches: Vec<usize> = self.rows.iter().filter_map(|row| row.from).collect();
        let header = format!("View3D 4.0 0 0 0 {}", patches.len());
        let line = |numbers: Vec<f64>| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let patch = |patch: &usize| &self.scene.patches[*patch];
        let mut lines = vec![format!("{header:<30}")];
        lines.push(line(patches.iter().map(|index| patch(index).polygon.area()).collect()));
        lines.extend(self.rows.iter().map(|row| line(patches.iter().map(|to| row.to(*to)).collect())));
        lines.push(line(patches.iter().map(|index| 1.0 - patch(index).reflectance[0]).collect()));
        lines.join("\n") + "\n"
    }
}
