//! A matrix for numpy and scipy.
use super::matrix::Found;
use super::row::Entry;
use std::io::{BufWriter, Write};
use zip::write::{SimpleFileOptions, StreamWriter, ZipWriter};
use zip::{CompressionMethod, result::ZipResult};

/// Writes a `.npz` file: `data`, `indices`, `indptr`, `shape` and `format` as `scipy.sparse.load_npz` takes them; and for
/// `numpy.load` the `errors` of the data, the `areas` and `emittances` of the rows, and the `names` of the columns.
pub(super) fn write(found: &Found, file: &mut dyn Write) -> ZipResult<()> {
    let mut file = ZipWriter::new_stream(file);
    let starts = found.rows.iter().scan(0, |end, row| {
        *end += row.entries.len();
        Some(*end)
    });
    let starts: Vec<usize> = std::iter::once(0).chain(starts).collect();
    let count = starts.last().copied().unwrap_or_default();
    let entries = || found.rows.iter().flat_map(|row| row.into_owned().entries);
    let number = |entry: Entry| integer(entry.to);
    add(&mut file, "indices", "<i8", count, entries().map(number))?;
    add(&mut file, "indptr", "<i8", starts.len(), starts.iter().copied().map(integer))?;
    add(&mut file, "shape", "<i8", 2, [found.rows.len(), found.names.len()].into_iter().map(integer))?;
    text(&mut file, "format", "()", &["csr"])?;
    add(&mut file, "data", "<f8", count, entries().map(|entry| entry.value.to_le_bytes()))?;
    add(&mut file, "errors", "<f8", count, entries().map(|entry| entry.error.to_le_bytes()))?;
    for (name, numbers) in [("areas", &found.areas), ("emittances", &found.emittances)] {
        add(&mut file, name, "<f8", numbers.len(), numbers.iter().copied().map(f64::to_le_bytes))?;
    }
    let names: Vec<&str> = found.names.iter().map(String::as_str).collect();
    text(&mut file, "names", &format!("({},)", names.len()), &names)?;
    file.finish().map(|_| ())
}

type Archive<'f> = ZipWriter<StreamWriter<&'f mut dyn Write>>;

fn integer(number: usize) -> [u8; 8] {
    (number as u64).to_le_bytes()
}

/// Numbers of eight bytes in one dimension.
fn add(
    file: &mut Archive,
    name: &str,
    kind: &str,
    count: usize,
    numbers: impl Iterator<Item = [u8; 8]>,
) -> ZipResult<()> {
    start(file, name, kind, &format!("({count},)"))?;
    let mut buffer = BufWriter::new(file);
    for number in numbers {
        buffer.write_all(&number)?;
    }
    Ok(buffer.flush()?)
}

/// Words of UTF-32, filled up with zeros to the longest.
fn text(file: &mut Archive, name: &str, shape: &str, words: &[&str]) -> ZipResult<()> {
    let width = words.iter().map(|word| word.chars().count()).max().unwrap_or(0).max(1);
    let padded = |word: &&str| {
        let word: Vec<u32> = word.chars().map(u32::from).chain(std::iter::repeat(0)).take(width).collect();
        word
    };
    let bytes: Vec<u8> = words.iter().flat_map(padded).flat_map(u32::to_le_bytes).collect();
    start(file, name, &format!("<U{width}"), shape)?;
    Ok(file.write_all(&bytes)?)
}

/// An array in numpy's format 1.0: magic, version, the header's length, the header filled up to 64 bytes; the data follow.
fn start(file: &mut Archive, name: &str, kind: &str, shape: &str) -> ZipResult<()> {
    const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    let length = (MAGIC.len() + 2 + header.len() + 1).next_multiple_of(64) - MAGIC.len() - 2;
    let length = u16::try_from(length).expect("a header is short");
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored).large_file(true);
    file.start_file(format!("{name}.npy"), options)?;
    file.write_all(MAGIC)?;
    file.write_all(&length.to_le_bytes())?;
    Ok(writeln!(file, "{header:<width$}", width = usize::from(length) - 1)?)
}
