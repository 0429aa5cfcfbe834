//! Files and stdin to read from, and what is said of them.
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::messages::say;
use crate::progress::Progress;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek};
use std::path::{Path, PathBuf};

/// What a command is given to read.
#[derive(Clone, Debug)]
pub(crate) struct Input {
    path: PathBuf,
    pub(crate) interrupt: Interrupt,
}

/// Bytes that are counted on a terminal, and end where somebody presses Ctrl-C.
struct Watched<R> {
    bytes: R,
    progress: Progress,
    interrupt: Interrupt,
}

impl Input {
    pub(crate) fn new(path: &Path, interrupt: &Interrupt) -> Input {
        Input { path: path.to_owned(), interrupt: interrupt.clone() }
    }

    /// How messages call it.
    pub(crate) fn name(&self) -> String {
        if self.is_stdin() { "stdin".into() } else { self.path.display().to_string() }
    }

    pub(crate) fn is_stdin(&self) -> bool {
        self.path.as_os_str() == "-"
    }

    /// The bytes in a row, without a byte order mark before them.
    pub(crate) fn stream(&self) -> Result<Box<dyn BufRead>, Failure> {
        if self.is_stdin() {
            return self.watched(io::stdin(), 0);
        }
        let file = File::open(&self.path).map_err(|error| self.unreadable(error))?;
        let length = file.metadata().map_or(0, |found| found.len());
        self.watched(file, length)
    }

    /// A file to read in any order: of what comes through a pipe, a copy without a name.
    pub(crate) fn file(&self) -> Result<File, Failure> {
        let is_file = !self.is_stdin() && self.path.metadata().is_ok_and(|found| found.is_file());
        if is_file {
            return File::open(&self.path).map_err(|error| self.unreadable(error));
        }
        let mut bytes = self.stream()?;
        let copied = tempfile::tempfile().and_then(|mut copy| {
            io::copy(&mut bytes, &mut copy)?;
            copy.rewind()?;
            Ok(copy)
        });
        copied.map_err(|error| {
            let folder = std::env::temp_dir();
            let copied_to =
                format!("{error}; it is copied to {} first: TMPDIR names another folder", folder.display());
            self.unreadable(std::io::Error::new(error.kind(), copied_to))
        })
    }

    /// The bytes of such a file from its beginning.
    pub(crate) fn stream_of(&self, mut file: &File) -> Result<Box<dyn BufRead>, Failure> {
        let rewound = file.rewind().and_then(|()| Ok((file.try_clone()?, file.metadata()?.len())));
        let (file, length) = rewound.map_err(|error| self.unreadable(error))?;
        self.watched(file, length)
    }

    pub(crate) fn unreadable(&self, error: io::Error) -> Failure {
        match error.kind() {
            _ if self.interrupt.is_set() => Failure::Interrupted,
            io::ErrorKind::NotFound => Failure::read(self.name(), format!("{error}; check its name")),
            _ => Failure::read(self.name(), error),
        }
    }

    fn watched(&self, bytes: impl Read + 'static, length: u64) -> Result<Box<dyn BufRead>, Failure> {
        let progress = Progress::of_bytes(&self.name(), length);
        let watched = Watched { bytes, progress, interrupt: self.interrupt.clone() };
        let mut bytes = BufReader::with_capacity(1 << 17, watched);
        let start = bytes.fill_buf().map_err(|error| self.unreadable(error))?;
        let mark = if start.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        bytes.consume(mark);
        Ok(Box::new(bytes))
    }
}

impl<R: Read> Read for Watched<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.interrupt.is_set() {
            return Err(io::Error::other("stopped"));
        }
        let count = self.bytes.read(buffer)?;
        self.progress.add(count);
        Ok(count)
    }
}

/// Says on stderr what a user should know, though the command goes on.
pub(crate) fn warn(message: impl std::fmt::Display) {
    say!("warning: {message}");
}
