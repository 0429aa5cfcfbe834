//! Files that are written whole or not at all, and stdout.
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use std::fs::File;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Where a command writes. Dropped before [`commit`](Output::commit), it leaves everything as it was, but for what has gone through
/// stdout or a pipe.
#[derive(Debug)]
pub(crate) struct Output {
    path: PathBuf,
    place: Place,
    interrupt: Interrupt,
}

#[derive(Debug)]
enum Place {
    Stdout,
    /// A device or a pipe, which cannot be replaced.
    Device(File),
    /// A new file beside the one that it replaces in the end; made when there is something to write, so that nothing is left behind
    /// when a process ends before.
    New(Option<NamedTempFile>, PathBuf),
}

impl Output {
    /// Opens it, so that a folder that takes no files is found before there is something to write.
    pub(crate) fn open(path: &Path, interrupt: &Interrupt) -> Result<Output, Failure> {
        let refused = |error| Failure::write(path.display(), error);
        if path.as_os_str() == "-" {
            return Ok(Output { path: "stdout".into(), place: Place::Stdout, interrupt: interrupt.clone() });
        }
        let place = match path.metadata() {
            Ok(found) if found.is_dir() => {
                return Err(Failure::write(path.display(), "it is a folder; name a file"));
            }
            Ok(found) if !found.is_file() => {
                Place::Device(File::options().write(true).open(path).map_err(refused)?)
            }
            // Of a link, the target is replaced and not the link.
            Ok(_) => probed(path.canonicalize().map_err(refused)?, interrupt).map_err(refused)?,
            Err(_) => probed(path.to_owned(), interrupt)
                .map_err(|error| Failure::write(path.display(), format!("{error}; check the folder")))?,
        };
        Ok(Output { path: path.to_owned(), place, interrupt: interrupt.clone() })
    }

    /// How messages call it.
    pub(crate) fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// Whether a person reads it.
    pub(crate) fn is_terminal(&self) -> bool {
        matches!(self.place, Place::Stdout) && io::stdout().is_terminal()
    }

    /// Puts what was written in its place.
    pub(crate) fn commit(self) -> Result<(), Failure> {
        let name = self.name();
        let ended = match self.place {
            Place::Stdout => kept(io::stdout().flush()),
            Place::Device(mut file) => file.flush(),
            Place::New(file, path) => {
                file.map_or_else(|| beside(&path, &self.interrupt), Ok).and_then(|file| {
                    file.as_file().sync_all().and_then(|()| Ok(file.persist(path).map(|_| ())?))
                })
            }
        };
        ended.map_err(|error| Failure::write(name, error))
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.interrupt.is_set() {
            return Err(io::Error::other("stopped"));
        }
        match &mut self.place {
            Place::Stdout => kept(io::stdout().write_all(bytes)).map(|()| bytes.len()),
            Place::Device(file) => file.write(bytes),
            Place::New(Some(file), _) => file.write(bytes),
            Place::New(none, path) => none.insert(beside(path, &self.interrupt)?).write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.place {
            Place::Stdout => kept(io::stdout().flush()),
            Place::Device(file) => file.flush(),
            Place::New(file, _) => file.as_mut().map_or(Ok(()), Write::flush),
        }
    }
}

/// A reader of stdout that has gone away wants no more of it: that is no error.
fn kept(written: io::Result<()>) -> io::Result<()> {
    match written {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// A place in a folder that takes files.
fn probed(path: PathBuf, interrupt: &Interrupt) -> io::Result<Place> {
    beside(&path, interrupt).map(drop)?;
    Ok(Place::New(None, path))
}

fn beside(path: &Path, interrupt: &Interrupt) -> io::Result<NamedTempFile> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let file = temporary().tempfile_in(folder)?;
    interrupt.leave_nothing_of(file.path());
    Ok(file)
}

/// Temporary files are private by default; results get the permissions that any new file gets.
#[cfg(unix)]
fn temporary() -> tempfile::Builder<'static, 'static> {
    use std::os::unix::fs::PermissionsExt;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".polycsg-").permissions(std::fs::Permissions::from_mode(0o666));
    builder
}

#[cfg(not(unix))]
fn temporary() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".polycsg-");
    builder
}
