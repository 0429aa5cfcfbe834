//! A matrix for numpy and scipy.
use super::matrix::Found;
use std::io::{Cursor, Write};
use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, result::ZipResult};

/// A `.npz` file: `data`, `indices`, `indptr`, `shape` and `format` as `scipy.sparse.load_npz` takes them; and for
/// `numpy.load` the `errors` of the data, the `areas` and `emittances` of the rows, and the `names` of the columns.
pub(super) fn bytes(found: &Found) -> ZipResult<Vec<u8>> {
    let mut file = ZipWriter::new(Cursor::new(Vec::new()));
    let entries = || found.rows.iter().flat_map(|row| &row.entries);
    let starts = found.rows.iter().scan(0, |end, row| {
        *end += row.entries.len();
        Some(*end)
    });
    let starts = std::iter::once(0).chain(starts);
    let shape = [found.rows.len(), found.names.len()].into_iter();
    integers(&mut file, "indices", entries().map(|entry| entry.to))?;
    integers(&mut file, "indptr", starts)?;
    integers(&mut file, "shape", shape)?;
    text(&mut file, "format", "()", &["csr"])?;
    reals(&mut file, "data", entries().map(|entry| entry.value))?;
    reals(&mut file, "errors", entries().map(|entry| entry.error))?;
    reals(&mut file, "areas", found.areas.iter().copied())?;
    reals(&mut file, "emittances", found.emittances.iter().copied())?;
    let names: Vec<&str> = found.names.iter().map(String::as_str).collect();
    text(&mut file, "names", &format!("({},)", names.len()), &names)?;
    Ok(file.finish()?.into_inner())
}

type Archive = ZipWriter<Cursor<Vec<u8>>>;

fn integers(file: &mut Archive, name: &str, numbers: impl Iterator<Item = usize>) -> ZipResult<()> {
    let bytes: Vec<u8> = numbers.flat_map(|number| (number as u64).to_le_bytes()).collect();
    add(file, name, "<i8", &format!("({},)", bytes.len() / 8), &bytes)
}

fn reals(file: &mut Archive, name: &str, numbers: impl Iterator<Item = f64>) -> ZipResult<()> {
    let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
    add(file, name, "<f8", &format!("({},)", bytes.len() / 8), &bytes)
}

/// Words of UTF-32, filled up with zeros to the longest.
fn text(file: &mut Archive, name: &str, shape: &str, words: &[&str]) -> ZipResult<()> {
    let width = words.iter().map(|word| word.chars().count()).max().unwrap_or(0).max(1);
    let padded = |word: &&str| {
        let word: Vec<u32> = word.chars().map(u32::from).chain(std::iter::repeat(0)).take(width).collect();
        word
    };
    let bytes: Vec<u8> = words.iter().flat_map(padded).flat_map(u32::to_le_bytes).collect();
    add(file, name, &format!("<U{width}"), shape, &bytes)
}

/// An array in numpy's format 1.0: magic, version, the header's length, the header filled up to 64 bytes, and the data.
fn add(file: &mut Archive, name: &str, kind: &str, shape: &str, bytes: &[u8]) -> ZipResult<()> {
    const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    let length = (MAGIC.len() + 2 + header.len() + 1).next_multiple_of(64) - MAGIC.len() - 2;
    let length = u16::try_from(length).expect("a header is short");
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored).large_file(true);
    file.start_file(format!("{name}.npy"), options)?;
    file.write_all(MAGIC)?;
    file.write_all(&length.to_le_bytes())?;
    writeln!(file, "{header:<width$}", width = usize::from(length) - 1)?;
    Ok(file.write_all(bytes)?)
}
