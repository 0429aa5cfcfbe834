//! `radiosity scene`
use super::{Failure, Scene, output};
use radiosity::{io, scenes};
use std::process::ExitCode;

/// Writes a built-in scene to a file, or to stdout.
pub(super) fn run(arguments: &Scene) -> Result<ExitCode, Failure> {
    let Some(text) = scenes::write_scene(&arguments.name) else {
        let known: Vec<_> = scenes::names().collect();
        let message = format!("no scene is named {}; there is: {}", arguments.name, known.join(", "));
        return Err(Failure::usage(message));
    };
    match &arguments.output {
        Some(path) => io::save(path, text.as_bytes())?,
        None => output::print(&text)?,
    }
    Ok(ExitCode::SUCCESS)
}
