//! The command line: what may be asked, and who answers.
use clap::{Args, Parser, Subcommand};
use failure::Failure;
use std::{path::PathBuf, process::ExitCode};

mod expose;
mod factors;
mod failure;
mod input;
mod inspect;
mod json;
mod lasting;
mod look;
mod output;
mod progress;
mod scene;
mod solve;
mod steps;
mod view;

/// Diffuse light of a scene by progressive radiosity with exact form factors.
///
/// Data goes to stdout, all else to stderr. Exit codes: 0 done, 1 input/output or internal error, 2 wrong usage,
/// 3 bad scene, 4 stopped before the tolerance (the result is written), 130 stopped by Ctrl-C (result and state are
/// written).
#[derive(Debug, Parser)]
#[command(version, max_term_width = 110)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Number of threads; the result does not depend on it [default: one per core]
    #[arg(short = 'j', long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

/// What can be asked.
#[derive(Debug, Subcommand)]
enum Command {
    /// Solve a scene's light and write it as a picture, a scene, or numbers
    Solve(solve::Solve),
    /// Turn a written solution to colours that a screen can show
    Expose(expose::Expose),
    /// Write a page that shows a solution in a browser
    View(view::View),
    /// Form factors from a point to every patch of a scene
    Factors(Factors),
    /// Tell what a scene is and what about it will trouble a solution
    Inspect(inspect::Inspect),
    /// Write one of the built-in scenes
    Scene(Scene),
}

/// `radiosity factors`
#[derive(Args, Debug)]
struct Factors {
    /// The scene: a COLLADA (.dae), glTF (.gltf, .glb) or View3D (.vs3) file
    scene: PathBuf,
    /// The point and the normal there, in the file's units and axes
    #[arg(long, value_name = "X,Y,Z,NX,NY,NZ", value_parser = point_and_normal, allow_hyphen_values = true)]
    from: [f64; 6],
    /// The patch that the point lies on: it never blocks the view, and the point sees nothing of it
    #[arg(long, value_name = "PATCH")]
    on: Option<String>,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
}

/// `radiosity scene`
#[derive(Args, Debug)]
struct Scene {
    /// The scene's name
    name: String,
    /// Where to write it, as COLLADA [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Answers; the exit code is 0, or 4 when a solution was stopped early.
pub(crate) fn run(arguments: Arguments) -> Result<ExitCode, Failure> {
    let threads = arguments.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(Failure::threads)?;
    pool.install(|| match arguments.command {
        Command::Solve(arguments) => solve::run(&arguments),
        Command::Expose(arguments) => expose::run(&arguments),
        Command::View(arguments) => view::run(&arguments),
        Command::Factors(arguments) => factors::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Scene(arguments) => scene::run(&arguments),
    })
}

/// A finite number above zero.
fn positive(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if number > 0.0 && number.is_finite() {
        Ok(number)
    } else {
        Err("give a finite number above 0".to_owned())
    }
}

/// A number of elements that fits in memory.
fn count(text: &str) -> Result<usize, String> {
    let number = text.parse().map_err(|_| "not a whole number".to_owned())?;
    if (1..=10_000_000).contains(&number) { Ok(number) } else { Err("give 1 to 10 000 000".to_owned()) }
}

/// Six finite numbers, the last three not all zero.
fn point_and_normal(text: &str) -> Result<[f64; 6], String> {
    let numbers: Vec<f64> = text
        .split(',')
        .map(|part| part.trim().parse())
        .collect::<Result<_, _>>()
        .map_err(|_| "not numbers")?;
    let found = numbers.len();
    let numbers: [f64; 6] = numbers.try_into().map_err(|_| format!("{found} numbers where 6 are needed"))?;
    if numbers.iter().any(|number| !number.is_finite()) || numbers[3..] == [0.0; 3] {
        return Err("give finite numbers and a normal that is not zero".to_owned());
    }
    Ok(numbers)
}
