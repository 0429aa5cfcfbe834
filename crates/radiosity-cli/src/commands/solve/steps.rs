//! Bound and ledger of every step, as CSV.
use crate::failure::Failure;
use radiosity::{Moment, Progress, io};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The table so far; nothing is noted when no file was asked for.
#[derive(Debug)]
pub(super) struct Steps {
    path: Option<PathBuf>,
    table: String,
    /// The shots and products of the last row.
    last: Option<[usize; 2]>,
}

impl Steps {
    /// An empty table, for a file.
    pub(super) fn new(path: Option<&Path>) -> Steps {
        Steps { path: path.map(Path::to_owned), table: String::new(), last: None }
    }

    /// Adds a row, unless the run only prepares a step and the last row says as much.
    pub(super) fn note(&mut self, progress: &Progress<'_>) {
        let here = Some([progress.shots, progress.products]);
        let is_told = progress.moment == Moment::Preparation && self.last == here;
        if self.path.is_none() || is_told {
            return;
        }
        self.last = here;
        let ledger = progress.ledger;
        let columns = [
            ("bound", progress.bound),
            ("emitted", &ledger.emitted),
            ("absorbed", &ledger.absorbed),
            ("escaped", &ledger.escaped),
            ("unshot", &ledger.unshot),
            ("defect", &ledger.defect),
        ];
        if self.table.is_empty() {
            let heads = columns
                .iter()
                .flat_map(|(name, bands)| (0..bands.len()).map(move |b| format!(",{name}_{b}")));
            self.table = format!("seconds,shots,products{}\n", heads.collect::<String>());
        }
        let row: String =
            columns.iter().flat_map(|(_, bands)| bands.iter()).map(|v| format!(",{v:e}")).collect();
        let Progress { seconds, shots, products, .. } = progress;
        let _ = writeln!(self.table, "{seconds:.3},{shots},{products}{row}");
    }

    /// Writes the table.
    pub(super) fn save(&self) -> Result<(), Failure> {
        self.path.iter().try_for_each(|path| Ok(io::save(path, self.table.as_bytes())?))
    }
}
