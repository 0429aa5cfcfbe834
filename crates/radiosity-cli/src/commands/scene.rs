//! `radiosity scene`
use crate::failure::Failure;
use crate::outputs::print;
use clap::Args;
use radiosity::{io, scenes};
use std::{path::PathBuf, process::ExitCode};

/// `radiosity scene`
#[derive(Args, Debug)]
pub(crate) struct BuiltIn {
    /// The scene's name
    name: String,
    /// Write it to this file, as COLLADA [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Writes a built-in scene to a file, or to stdout.
pub(crate) fn run(arguments: &BuiltIn) -> Result<ExitCode, Failure> {
    let Some(text) = scenes::write_scene(&arguments.name) else {
        let known: Vec<_> = scenes::names().collect();
        let message = format!("no scene is named {}; there is: {}", arguments.name, known.join(", "));
        return Err(Failure::usage(message));
    };
    match &arguments.output {
        Some(path) => io::save(path, text.as_bytes())?,
        None => print(&text)?,
    }
    Ok(ExitCode::SUCCESS)
}
