//! Rows found so far, in a file: a run that was killed goes on from there.
//!
//! The file starts with a line that says what it is and a fingerprint of what was asked. Each row is its length in bytes, its numbers, and a hash of these, all
//! little-endian: what a kill cut short is not taken for a row.
use crate::failure::Failure;
use fnv::FnvHasher;
use radiosity::formfactor::{Enclosure, Exchange, ExchangeRow};
use std::fs::{File, OpenOptions};
use std::hash::Hasher;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// What every journal starts with, so that no other file is taken for one.
const MAGIC: &[u8] = b"radiosity factors: rows 1\n";

#[derive(Debug)]
pub(super) struct Journal {
    file: File,
    path: PathBuf,
    rows: Vec<ExchangeRow>,
}

impl Journal {
    /// Opens a journal, or starts one; reads the rows in it. One of another scene, tolerance or version is started anew; a file that is no
    /// journal is left alone.
    pub(super) fn open(path: &Path, enclosure: &Enclosure, tolerance: f64) -> Result<Journal, Failure> {
        let refused = |error: std::io::Error| {
            Failure::internal(format!("{}: cannot be written: {error}", path.display()))
        };
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(refused)?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(refused)?;
        if !bytes.is_empty() && !bytes.starts_with(MAGIC) {
            let message =
                format!("{}: no journal of rows; move it away or name another output", path.display());
            return Err(Failure::internal(message));
        }
        let start = [MAGIC, &fingerprint(enclosure, tolerance).to_le_bytes()].concat();
        let (mut rows, mut end) = (Vec::new(), start.len());
        if bytes.starts_with(&start) {
            while let Some((row, next)) = read(&bytes, end, enclosure.polygons().len()) {
                rows.push(row);
                end = next;
            }
        } else {
            file.seek(SeekFrom::Start(0)).and_then(|_| file.write_all(&start)).map_err(refused)?;
        }
        // What is cut short is overwritten.
        file.set_len(end as u64).and_then(|()| file.seek(SeekFrom::Start(end as u64))).map_err(refused)?;
        Ok(Journal { file, path: path.into(), rows })
    }

    pub(super) fn take_rows(&mut self) -> Vec<ExchangeRow> {
        std::mem::take(&mut self.rows)
    }

    /// Writes a row behind the others.
    pub(super) fn add(&mut self, row: &ExchangeRow) -> Result<(), Failure> {
        let written = self.file.write_all(&bytes(row));
        written.map_err(|e| Failure::internal(format!("{}: cannot be written: {e}", self.path.display())))
    }
}

/// Of the polygons, the tolerance and the program's version.
fn fingerprint(enclosure: &Enclosure, tolerance: f64) -> u64 {
    let mut hasher = FnvHasher::default();
    hasher.write(env!("CARGO_PKG_VERSION").as_bytes());
    hasher.write_u64(tolerance.to_bits());
    for polygon in enclosure.polygons() {
        for points in polygon.loops() {
            hasher.write_usize(points.len());
            points.iter().flat_map(|p| p.to_array()).for_each(|x| hasher.write_u64(x.to_bits()));
        }
    }
    hasher.finish()
}

fn bytes(row: &ExchangeRow) -> Vec<u8> {
    let mut numbers = Vec::with_capacity(20 * row.with.len() + 8);
    numbers.extend((row.from as u64).to_le_bytes());
    for exchange in &row.with {
        numbers.extend(exchange.to.to_le_bytes());
        numbers.extend(exchange.area.to_le_bytes());
        numbers.extend(exchange.error.to_le_bytes());
    }
    let length = (numbers.len() as u64).to_le_bytes();
    [&length[..], &numbers, &hash(&numbers).to_le_bytes()].concat()
}

fn hash(bytes: &[u8]) -> u64 {
    let mut hasher = FnvHasher::default();
    hasher.write(bytes);
    hasher.finish()
}

/// The row that starts in a place, and where the next one does; nothing unless it is whole.
fn read(bytes: &[u8], at: usize, polygons: usize) -> Option<(ExchangeRow, usize)> {
    let eight = |at: usize| Some(u64::from_le_bytes(bytes.get(at..at.checked_add(8)?)?.try_into().ok()?));
    let start = at + 8;
    let end = start.checked_add(usize::try_from(eight(at)?).ok()?)?;
    let numbers = bytes.get(start..end).filter(|numbers| eight(end) == Some(hash(numbers)))?;
    let (from, entries) = numbers.split_first_chunk::<8>()?;
    let exchange = |entry: &[u8]| {
        let (to, rest) = entry.split_first_chunk::<4>()?;
        let (area, rest) = rest.split_first_chunk::<8>()?;
        let error = rest.first_chunk::<8>()?;
        let [area, error] = [area, error].map(|number| f64::from_le_bytes(*number));
        Some(Exchange { to: u32::from_le_bytes(*to), area, error })
    };
    let with = entries.chunks(20).map(exchange).collect::<Option<Vec<_>>>()?;
    let row = ExchangeRow { from: usize::try_from(u64::from_le_bytes(*from)).ok()?, with };
    let is_known = |polygon: usize| polygon < polygons;
    let fits = is_known(row.from) && row.with.iter().all(|exchange| is_known(exchange.to as usize));
    fits.then_some((row, end + 8))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(from: usize) -> ExchangeRow {
        let exchange = |to: u32| Exchange { to, area: 1.0 / f64::from(to), error: 1e-9 };
        ExchangeRow { from, with: (4..9).map(exchange).collect() }
    }

    #[test]
    fn rows_are_read_as_they_were_written_and_halves_are_not() {
        let whole = [bytes(&row(1)), bytes(&row(3))].concat();
        let (first, next) = read(&whole, 0, 9).unwrap();
        assert_eq!((first, read(&whole, next, 9)), (row(1), Some((row(3), whole.len()))));
        for cut in 0..next {
            assert_eq!(read(&whole[..cut], 0, 9), None, "{cut}");
        }
        for at in 0..next {
            let mut wrong = whole.clone();
            wrong[at] ^= 1;
            assert_eq!(read(&wrong, 0, 9), None, "{at}");
        }
        assert_eq!(read(&whole, 0, 8), None, "of another scene");
    }
}
