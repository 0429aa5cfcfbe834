//! The command line: its commands, and who runs them.
use crate::commands::area::{self, Area};
use crate::commands::clip::{self, Clip};
use crate::commands::dissolve::{self, Dissolve};
use crate::commands::files::print;
use crate::commands::overlay::{self, Overlay};
use crate::commands::repair::{self, Repair};
use crate::commands::validate::{self, Validate};
use crate::failure::Failure;
use crate::input::warn;
use crate::interrupt::Interrupt;
use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use std::{num::NonZero, process::ExitCode};

/// Exact overlay, dissolve, clip and repair of the polygons in files.
///
/// Reads and writes GeoJSON, WKT and WKB (a geometry a line), FlatGeobuf and GeoParquet, by the end of a file's name or by --from and
/// --to; - is stdin or stdout. Data goes to stdout, everything else to stderr. A file is written whole or not at all. Results do not
/// depend on the number of threads. Exit codes: 0 done, 1 a file cannot be read or written, 2 wrong usage, 3 data that makes no
/// sense, 4 `validate` found features that are not valid, 130 stopped by Ctrl-C
/// or SIGTERM.
#[derive(Debug, Parser)]
#[command(name = "polycsg", version, max_term_width = 110)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Number of threads, at most 8 per core; the result does not depend on it [default: one per core]
    #[arg(short = 'j', long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

/// Results are the same for any number of threads: whoever tries that on few cores gets more threads than these.
const PER_CORE: usize = 8;

/// The commands.
#[derive(Debug, Subcommand)]
enum Command {
    /// Intersect, unite or subtract the features of two files, with the columns of both
    Overlay(Overlay),
    /// Unite features that have equal values in a column
    Dissolve(Dissolve),
    /// Cut features along a mask; the file may be larger than memory
    Clip(Clip),
    /// Name the features that are not valid, and why
    Validate(Validate),
    /// Make features valid that are not; the others stay bit for bit what they are
    Repair(Repair),
    /// Print the area of each feature
    Area(Area),
    /// Print completions for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// Runs the command.
pub(crate) fn run(arguments: Arguments) -> Result<ExitCode, Failure> {
    let interrupt = Interrupt::listen()?;
    let threads = arguments.threads.map_or(0, |threads| few(threads.into()));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool =
        pool.map_err(|error| Failure::File(format!("the threads cannot be started: {error}; try -j 1")))?;
    let result = pool.install(|| match arguments.command {
        Command::Overlay(arguments) => overlay::run(&arguments, &interrupt),
        Command::Dissolve(arguments) => dissolve::run(&arguments, &interrupt),
        Command::Clip(arguments) => clip::run(&arguments, &interrupt),
        Command::Validate(arguments) => validate::run(&arguments, &interrupt),
        Command::Repair(arguments) => repair::run(&arguments, &interrupt),
        Command::Area(arguments) => area::run(&arguments, &interrupt),
        Command::Completions { shell } => completions(shell),
    });
    // What is stopped may fail in many ways.
    if interrupt.is_set() && result.is_err() { Err(Failure::Interrupted) } else { result }
}

/// So many threads, but no more than the machine has use for: thousands take longer to start than most runs.
fn few(threads: usize) -> usize {
    let most = PER_CORE * std::thread::available_parallelism().map_or(1, NonZero::get);
    if threads > most {
        warn(format_args!("-j {threads} is more than {PER_CORE} threads per core; {most} are started"));
    }
    threads.min(most)
}

/// Prints a shell's completions.
fn completions(shell: Shell) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "polycsg", &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(ExitCode::SUCCESS)
}
