//! What patches exchange: each pair once, on all threads, row by row.
use super::journal::Journal;
use super::tally::Tally;
use crate::commands::patience::Patience;
use crate::failure::Failure;
use radiosity::formfactor::{Enclosure, ExchangeRow, Limits};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The rows of all polygons; none when stopped. With an output, rows are noted in a journal beside it as they are found, and
/// those that are there already are not found again.
pub(super) fn find(
    enclosure: &Enclosure,
    tolerance: f64,
    output: Option<&Path>,
    patience: &Patience,
) -> Result<Option<Vec<ExchangeRow>>, Failure> {
    let count = enclosure.polygons().len();
    let mut journal =
        output.and_then(beside).map(|path| Journal::open(&path, enclosure, tolerance)).transpose()?;
    let rows = journal.as_mut().map(Journal::take_rows).unwrap_or_default();
    let tally = Tally::new(count, rows.iter().map(|row| row.from));
    let mut is_known = vec![false; count];
    rows.iter().for_each(|row| is_known[row.from] = true);
    let missing: Vec<usize> = (0..count).filter(|row| !is_known[*row]).collect();
    let limits = Limits { stop: &|| patience.is_over(), ..Limits::default() };
    let notes = Mutex::new(Notes { journal, tally, rows });
    // The first row that is stopped ends all: each of the others would look at the whole scene before it stops.
    let ended = missing.par_iter().try_for_each(|from| {
        let found = enclosure.exchange_row(*from, tolerance, &limits);
        let row = found.map_err(|error| Some(Failure::usage(error)))?.ok_or(None)?;
        notes.lock().unwrap_or_else(PoisonError::into_inner).add(row).map_err(Some)
    });
    if let Err(Some(failure)) = ended {
        return Err(failure);
    }
    let Notes { journal, tally, rows } = notes.into_inner().unwrap_or_else(PoisonError::into_inner);
    if rows.len() < count {
        tally.stop(journal.is_some());
        return Ok(None);
    }
    tally.end();
    Ok(Some(rows))
}

/// The rows found so far, in the order in which they were.
struct Notes {
    journal: Option<Journal>,
    tally: Tally,
    rows: Vec<ExchangeRow>,
}

impl Notes {
    fn add(&mut self, row: ExchangeRow) -> Result<(), Failure> {
        self.journal.as_mut().map(|journal| journal.add(&row)).transpose()?;
        self.tally.advance(row.from);
        self.rows.push(row);
        Ok(())
    }
}

/// The journal's place; none beside what is no file (`/dev/stdout`, a pipe).
pub(super) fn beside(output: &Path) -> Option<PathBuf> {
    let mut name = output.to_owned().into_os_string();
    name.push(".rows");
    (!output.exists() || output.is_file()).then(|| name.into())
}

/// Removes the journal: the output holds all. One that cannot be removed does no harm.
pub(super) fn forget(output: Option<&Path>) {
    if let Some(journal) = output.and_then(beside) {
        let _ = std::fs::remove_file(journal);
    }
}
