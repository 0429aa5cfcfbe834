//! What went wrong, and the exit code that says so.
use crate::messages::say;
use radiosity::io::FileError;
use std::process::ExitCode;

/// A message for people and an exit code for programs.
#[derive(Debug)]
pub(crate) struct Failure {
    code: u8,
    message: String,
}

impl Failure {
    /// Files, or the program itself: exit code 1.
    pub(crate) fn internal(message: impl ToString) -> Failure {
        Failure { code: 1, message: message.to_string() }
    }

    /// The command line asks for what does not exist: exit code 2.
    pub(crate) fn usage(message: impl ToString) -> Failure {
        Failure { code: 2, message: message.to_string() }
    }

    /// A scene or solution that makes no sense: exit code 3.
    pub(crate) fn scene(message: impl ToString) -> Failure {
        Failure { code: 3, message: message.to_string() }
    }

    /// The threads could not be started.
    pub(crate) fn threads(error: impl ToString) -> Failure {
        Failure::internal(format!("the threads cannot be started: {}; try -j 1", error.to_string()))
    }

    /// The time was up before something was done: exit code 4.
    pub(crate) fn late(undone: &str) -> Failure {
        let message = format!("the time was up before {undone}; allow more seconds, or take a part of it");
        Failure { code: 4, message }
    }

    /// Prints the message on stderr; gives the exit code.
    pub(crate) fn report(&self) -> ExitCode {
        say!("error: {}", self.message);
        ExitCode::from(self.code)
    }
}

impl From<radiosity::Error> for Failure {
    /// Whatever the solver refuses is the scene's fault: exit code 3. What there was no time for has 4.
    fn from(error: radiosity::Error) -> Failure {
        let code = if matches!(error, radiosity::Error::Time) { 4 } else { 3 };
        Failure { code, message: error.to_string() }
    }
}

impl From<FileError> for Failure {
    /// A file that cannot be read or written is exit code 1, an unknown kind of file 2, one
    /// that makes no sense 3.
    fn from(error: FileError) -> Failure {
        let code = match error {
            FileError::Read { .. } | FileError::Write { .. } | FileError::Size { .. } => 1,
            FileError::Unknown { .. } | FileError::UnknownOutput { .. } => 2,
            _ => 3,
        };
        Failure { code, message: error.to_string() }
    }
}
