//! What was measured.
use crate::machine::Machine;
use crate::rows::{Chapter, Deviation, ErrorImage, Measured, Row};

/// A report: what was measured.
#[derive(Clone, Debug)]
pub struct Report {
    pub(crate) rows: Vec<Row>,
    pub(crate) machine: Machine,
    pub(crate) quick: bool,
    pub(crate) images: Vec<ErrorImage>,
    /// One standard error of what whole solutions are compared with, by scene.
    pub(crate) noise: Vec<(String, Deviation)>,
}

impl Report {
    /// The rows of one chapter that measure an error.
    pub(crate) fn measured(&self, chapter: Chapter) -> impl Iterator<Item = &Measured> {
        self.rows.iter().filter_map(move |row| match row {
            Row::Measured(row) if row.chapter == chapter => Some(row),
            _ => None,
        })
    }
}
