//! Photometry of luminaires: IES LM-63 (`.ies`) and EULUMDAT (`.ldt`).
//!
//! ```text
//! ies        words: a label, then numbers
//! ldt        lines, each of which has its meaning
//! angles     what both check
//! ```
mod angles;
mod ies;
mod ldt;

use super::error::FileError;
use crate::scene::photometry::Photometry;
use std::path::Path;

/// Reads a file, in the format of its extension.
///
/// # Errors
/// [`FileError::Read`] when it cannot be read, [`FileError::Photometry`] for another extension, and those of [`parse_ies`] or [`parse_ldt`].
pub fn open(path: impl AsRef<Path>) -> Result<Photometry, FileError> {
    let path = path.as_ref();
    let name = path.display().to_string();
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    let parse: fn(&str, &[u8]) -> Result<Photometry, FileError> = match extension.as_deref() {
        Some("ies") => parse_ies,
        Some("ldt") => parse_ldt,
        _ => return Err(FileError::Photometry { file: name }),
    };
    let bytes = std::fs::read(path).map_err(|source| FileError::Read { path: path.into(), source })?;
    parse(&name, &bytes)
}

/// The photometry in an IES file (ANSI/IES LM-63, any edition; type C, the one in use). Bytes that are no UTF-8 may stand in its texts.
///
/// ```
/// use radiosity::{glam::DVec3, io::photometry::parse_ies};
/// let text = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n1000 0\n";
/// let lamp = parse_ies("downlight.ies", text.as_bytes())?;
/// assert_eq!(lamp.candela(DVec3::Z), 1000.0);
/// assert_eq!(lamp.candela(DVec3::NEG_Z), 0.0);
/// # Ok::<(), radiosity::io::FileError>(())
/// ```
///
/// # Errors
/// [`FileError::Line`] where a number is missing, out of order or out of range.
pub fn parse_ies(name: &str, bytes: &[u8]) -> Result<Photometry, FileError> {
    ies::parse(&String::from_utf8_lossy(bytes)).map_err(|(line, fault)| FileError::Line {
        file: name.into(),
        line,
        fault,
    })
}

/// The photometry in an EULUMDAT file, for its first set of lamps. Bytes that are no UTF-8 may stand in its texts.
///
/// # Errors
/// [`FileError::Line`] where a number is missing, out of order or out of range.
pub fn parse_ldt(name: &str, bytes: &[u8]) -> Result<Photometry, FileError> {
    ldt::parse(&String::from_utf8_lossy(bytes)).map_err(|(line, fault)| FileError::Line {
        file: name.into(),
        line,
        fault,
    })
}
