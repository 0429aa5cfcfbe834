//! The command line: its commands, and who runs them.
use crate::commands::compare::{self, Compare};
use crate::commands::expose::{self, Expose};
use crate::commands::factors::{self, Factors};
use crate::commands::inspect::{self, Inspect};
use crate::commands::plot::{self, Plot};
use crate::commands::report::{self, Report};
use crate::commands::scene::{self, BuiltIn};
use crate::commands::solve::{self, options::Solve};
use crate::commands::view::{self, View};
use crate::failure::Failure;
use crate::messages::say;
use crate::outputs::print;
use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use std::ffi::{OsStr, OsString};
use std::{num::NonZero, process::ExitCode};

/// The diffuse light of a scene, by radiosity with exact form factors.
///
/// Data goes to stdout, everything else to stderr. Exit codes: 0 done, 1 input/output or internal error, 2 wrong usage,
/// 3 bad scene, 4 stopped before the tolerance was reached, 5 a difference above `--fail-above`, 130 stopped by Ctrl-C. A
/// stopped run writes its result and a state to resume from.
#[derive(Debug, Parser)]
#[command(name = "radiosity", version, max_term_width = 110)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Task,
    /// Number of threads, at most 8 per core; the result does not depend on it [default: one per core]
    #[arg(short = 'j', long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

/// Results are the same for any number of threads: whoever tries that on few cores gets more threads than these.
const PER_CORE: usize = 8;

/// The commands.
#[derive(Debug, Subcommand)]
enum Task {
    /// Solve for the light of a scene and write it as a picture, a scene, a page or numbers
    Solve(Solve),
    /// Turn a solution into displayable colours
    Expose(Expose),
    /// Write an HTML page that shows a solution in a browser
    View(View),
    /// Print form factors: from a point, from patches, or the whole matrix of a scene
    Factors(Factors),
    /// Describe a scene and find what will trouble a solution
    Inspect(Inspect),
    /// Compare two solutions of one scene: relative L1, L2 and maximum difference of reflected light
    Compare(Compare),
    /// Plot radiosity along a line that is drawn on a surface, as a table or as a drawing
    Plot(Plot),
    /// Benchmark: measure error against time of every form factor method on every scene, and write it as a page
    Report(Report),
    /// Write one of the built-in scenes
    Scene(BuiltIn),
    /// Print completions for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
}

impl Arguments {
    /// The arguments of this run. What begins like a number below zero is a value of the option before it, which can then say what it wants.
    pub(crate) fn of_this_run() -> Arguments {
        Arguments::parse_from(with_negative_values(std::env::args_os()))
    }
}

/// `--error -1%` as `--error=-1%`, which is not taken for an option.
fn with_negative_values(words: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut joined: Vec<OsString> = Vec::new();
    for word in words {
        match joined.last_mut().filter(|last| is_negative(&word) && is_option(last)) {
            Some(option) => {
                option.push("=");
                option.push(word);
            }
            None => joined.push(word),
        }
    }
    joined
}

fn is_negative(word: &OsStr) -> bool {
    let number = word.to_str().and_then(|word| word.strip_prefix('-'));
    let begins = |text: &str| text.starts_with(|first: char| first.is_ascii_digit() || first == '.');
    number.is_some_and(|text| begins(text) || text.parse::<f64>().is_ok())
}

/// Whether a word is an option alone, which may want the next one: `--time` or `-k`.
fn is_option(word: &OsStr) -> bool {
    let Some(name) = word.to_str().and_then(|word| word.strip_prefix('-')) else { return false };
    match name.strip_prefix('-') {
        Some(long) => !long.is_empty() && !long.contains('='),
        None => name.chars().count() == 1,
    }
}

/// Runs the command; the exit code is 0, 4 when a solution was stopped early, or 5 when two differ too much.
pub(crate) fn run(arguments: Arguments) -> Result<ExitCode, Failure> {
    let threads = arguments.threads.map_or(0, |threads| few(threads.into()));
    // For threads outside of the pool, too: those that are waited for.
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().map_err(Failure::threads)?;
    match arguments.command {
        Task::Solve(arguments) => solve::run(&arguments),
        Task::Expose(arguments) => expose::run(&arguments),
        Task::View(arguments) => view::run(&arguments),
        Task::Factors(arguments) => factors::run(&arguments),
        Task::Inspect(arguments) => inspect::run(&arguments),
        Task::Compare(arguments) => compare::run(&arguments),
        Task::Plot(arguments) => plot::run(&arguments),
        Task::Report(arguments) => report::run(&arguments),
        Task::Scene(arguments) => scene::run(&arguments),
        Task::Completions { shell } => completions(shell),
    }
}

/// So many threads, but no more than the machine has use for: thousands take longer to start than most runs.
fn few(threads: usize) -> usize {
    let most = PER_CORE * std::thread::available_parallelism().map_or(1, NonZero::get);
    if threads > most {
        say!("warning: -j {threads} is more than {PER_CORE} threads per core; {most} are started");
    }
    threads.min(most)
}

/// Prints a shell's completions.
fn completions(shell: Shell) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "radiosity", &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(ExitCode::SUCCESS)
}
