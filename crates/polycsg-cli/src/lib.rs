//! The program `polycsg`: exact Booleans of the polygons in files. Its one function runs the command line.
//!
//! ```text
//! arguments     what may be asked, and who answers
//! commands      a file for each
//! operands      features as regions, and which of them meet
//! formats       readers and writers, a folder or a file for each format
//! output        files that are written whole or not at all
//! input         files and stdin, and what is said of them
//! progress      bars on a terminal
//! layer         features in batches, their columns, and the system of their coordinates
//! interrupt     Ctrl-C
//! messages      what is said on stderr
//! failure       what went wrong, and the exit code that says so
//! ```
#![deny(clippy::print_stderr, reason = "it panics where stderr is closed or full; `say!` does not")]
use clap::Parser;
use std::process::ExitCode;

mod arguments;
mod commands;
mod failure;
mod formats;
#[cfg(fuzzing)]
#[doc(hidden)]
pub mod fuzzing;
mod input;
mod interrupt;
mod layer;
mod messages;
mod operands;
mod output;
mod progress;

/// Runs the command line of this process: reads and writes what it names, says on stderr what went wrong, and returns the exit
/// code that `polycsg --help` lists.
#[must_use]
pub fn run() -> ExitCode {
    match arguments::run(arguments::Arguments::parse()) {
        Ok(code) => code,
        Err(failure) => failure.report(),
    }
}
