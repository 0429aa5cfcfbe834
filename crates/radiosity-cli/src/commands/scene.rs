//! `radiosity scene`
use crate::clashes;
use crate::failure::Failure;
use crate::messages::say;
use crate::outputs::{is_stream, print, probe};
use clap::Args;
use radiosity::{io, scenes};
use std::{path::PathBuf, process::ExitCode};

/// `radiosity scene`
#[derive(Args, Debug)]
#[command(override_usage = "radiosity scene <NAME> [--output <FILE>]\n       radiosity scene --list")]
pub(crate) struct BuiltIn {
    /// The scene's name; furnace-R is a furnace of reflectance R
    #[arg(required_unless_present = "list")]
    name: Option<String>,
    /// List the names of all scenes, and what they are
    #[arg(long, conflicts_with_all = ["name", "output"])]
    list: bool,
    /// Write it to this file, in the format of its extension: .dae, .glb, .obj, .ply or .stl [default: stdout, as COLLADA]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Writes a built-in scene to a file, or to stdout; or lists them.
pub(crate) fn run(arguments: &BuiltIn) -> Result<ExitCode, Failure> {
    let name = arguments.name.as_deref().unwrap_or_default();
    if arguments.list {
        return print(&list()).map(|()| ExitCode::SUCCESS);
    }
    let Some(text) = scenes::write_scene(name) else {
        let known: Vec<_> = scenes::names().collect();
        let message = format!("no scene is named {name}; there is: {}", known.join(", "));
        return Err(Failure::usage(message));
    };
    match &arguments.output {
        Some(path) if !is_stream(path) => write(&text, path)?,
        _ => print(&text)?,
    }
    Ok(ExitCode::SUCCESS)
}

/// COLLADA is written as it is; other formats are made of the scene, and what they cannot hold is told.
fn write(text: &str, path: &PathBuf) -> Result<(), Failure> {
    probe(path)?;
    clashes::refuse_materials_of_others(path, None)?;
    if path.extension().is_some_and(|end| end.eq_ignore_ascii_case("dae")) {
        return Ok(io::save(path, text.as_bytes())?);
    }
    let scene = io::collada::Collada::from_text("scene", text).scene()?;
    let left_out = io::save_scene(&scene, path)?;
    if !left_out.is_empty() {
        say!("warning: {}: the format has no place for {}", path.display(), left_out.join(", "));
    }
    Ok(())
}

/// A line for each scene: its name, and what it is.
fn list() -> String {
    scenes::names().map(|name| format!("{name:<16} {}\n", scenes::title(name).unwrap_or_default())).collect()
}
