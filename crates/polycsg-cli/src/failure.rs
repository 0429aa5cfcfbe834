//! What went wrong, and the exit code that says so.
use crate::messages::say;
use std::fmt::Display;
use std::process::ExitCode;

/// Why a command did not end well.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A file cannot be read or written: exit code 1.
    File(String),
    /// The command line asks for what cannot be done: exit code 2.
    Usage(String),
    /// A file's content makes no sense: exit code 3.
    Data(String),
    /// Somebody pressed Ctrl-C, or sent SIGTERM: exit code 130, as a shell reports the first.
    Interrupted,
}

impl Failure {
    /// A file cannot be read.
    pub(crate) fn read(name: impl Display, error: impl Display) -> Failure {
        Failure::File(format!("{name}: cannot be read: {error}"))
    }

    /// A file cannot be written; what was there before is unchanged.
    pub(crate) fn write(name: impl Display, error: impl Display) -> Failure {
        Failure::File(format!("{name}: cannot be written: {error}"))
    }

    /// The content of a file makes no sense.
    pub(crate) fn data(name: impl Display, error: impl Display) -> Failure {
        Failure::Data(format!("{name}: {error}"))
    }

    /// Prints the message on stderr; gives the exit code.
    pub(crate) fn report(&self) -> ExitCode {
        let (code, message) = match self {
            Failure::File(message) => (1, message.as_str()),
            Failure::Usage(message) => (2, message.as_str()),
            Failure::Data(message) => (3, message.as_str()),
            Failure::Interrupted => (130, "stopped by Ctrl-C or a signal; nothing was written"),
        };
        say!("error: {message}");
        ExitCode::from(code)
    }
}
