//! Files are read as a whole, and written completely or not at all.
use super::error::FileError;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// The bytes of a file.
pub(super) fn bytes_of(path: &Path) -> Result<Vec<u8>, FileError> {
    std::fs::read(path).map_err(|source| FileError::Read { path: path.into(), source })
}

/// Whether a folder is another one than a file came from.
pub(super) fn is_another(old: Option<&Path>, new: &Path) -> bool {
    let place = |folder: &Path| {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        folder.canonicalize().ok()
    };
    let old = old.and_then(place);
    old.is_some() && old != place(new)
}

/// Writes a file completely or not at all: into a temporary file of the same folder, which is renamed at the end.
///
/// Of a link, the target is replaced and not the link. What is not a regular file (`/dev/stdout`, a pipe) is written to
/// directly.
///
/// # Errors
/// [`FileError::Write`]; an older file at `path` is then unchanged.
pub fn save(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), FileError> {
    save_with(path, |file| file.write_all(bytes))
}

/// [`save`] of what is written bit by bit, for files that should not be in memory as a whole.
///
/// # Errors
/// [`FileError::Write`], also with what `write` returns; an older file at `path` is then unchanged.
pub fn save_with(
    path: impl AsRef<Path>,
    write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), FileError> {
    let path = path.as_ref();
    let written = match path.metadata() {
        Ok(found) if !found.is_file() => File::create(path).and_then(|file| buffered(&file, write)),
        Ok(_) => path.canonicalize().and_then(|place| replace(&place, write)),
        Err(_) => replace(path, write),
    };
    written.map_err(|source| FileError::Write { path: path.into(), source })
}

fn replace(path: &Path, write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> std::io::Result<()> {
    let file = temporary().tempfile_in(folder(path))?;
    buffered(file.as_file(), write)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|refused| refused.error)?;
    Ok(())
}

fn buffered(file: &File, write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> std::io::Result<()> {
    let mut buffer = BufWriter::new(file);
    write(&mut buffer)?;
    buffer.flush()
}

fn folder(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.into(),
        _ => PathBuf::from("."),
    }
}

/// Temporary files are private by default; results get the permissions that any new file gets.
#[cfg(unix)]
fn temporary() -> tempfile::Builder<'static, 'static> {
    use std::os::unix::fs::PermissionsExt;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".radiosity-").permissions(std::fs::Permissions::from_mode(0o666));
    builder
}

#[cfg(not(unix))]
fn temporary() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".radiosity-");
    builder
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_whole_and_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.bin");
        save(&path, b"first").unwrap();
        save(&path, b"second").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"second");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_missing_folder_and_a_folder_as_target_are_typed_errors() {
        let folder = tempfile::tempdir().unwrap();
        let missing = save(folder.path().join("none/out.bin"), b"x").unwrap_err();
        assert!(matches!(missing, FileError::Write { .. }), "{missing}");
        assert!(matches!(save(folder.path(), b"x"), Err(FileError::Write { .. })));
    }

    #[test]
    fn what_fails_half_way_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.bin");
        save(&path, b"old").unwrap();
        let half =
            |file: &mut dyn Write| file.write_all(&[7; 100_000]).and(Err(std::io::Error::other("no more")));
        let failed = save_with(&path, half).unwrap_err();
        assert!(failed.to_string().contains("out.bin"), "{failed}");
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let (target, link) = (folder.path().join("target"), folder.path().join("link"));
        save(&target, b"old").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        save(&link, b"new").unwrap();
        assert_eq!(std::fs::read(&target).unwrap(), b"new");
        assert!(link.symlink_metadata().unwrap().is_symlink());
    }
}
