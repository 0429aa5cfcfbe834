//! The `radiosity` program: parses, calls the library, prints.
//!
//! ```text
//! arguments     what may be asked, and who answers
//! commands      a file or folder for each
//! clashes       outputs that would cost something else
//! outputs       results to files, by extension, and data to stdout
//! view_options  how pictures are taken
//! input         scenes and solutions from files
//! waiting       for what cannot be stopped
//! json          what --json prints
//! parse         numbers on the command line
//! digits        numbers for people
//! messages      what is said on stderr
//! failure       what went wrong, and the exit code that says so
//! ```
#![deny(clippy::print_stderr, reason = "it panics where stderr is closed or full; `say!` does not")]
use std::process::ExitCode;

mod arguments;
mod clashes;
mod commands;
mod digits;
mod failure;
mod input;
mod json;
mod messages;
mod outputs;
mod parse;
mod view_options;
mod waiting;

fn main() -> ExitCode {
    let arguments = arguments::Arguments::of_this_run();
    match arguments::run(arguments) {
        Ok(code) => code,
        Err(failure) => failure.report(),
    }
}
