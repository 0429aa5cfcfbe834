//! `radiosity expose`
use crate::clashes;
use crate::failure::Failure;
use crate::input;
use crate::outputs::{self, Contents, Output, is_stream};
use crate::view_options::ViewOptions;
use clap::Args;
use radiosity::expose::Exposure;
use radiosity::io::{collada::Collada, gltf};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// `radiosity expose`
#[derive(Args, Debug)]
pub(crate) struct Expose {
    /// A solution: a .json, .dae or .glb file of solve; - for .json from standard input
    solution: PathBuf,
    /// Write it with displayable colours to this file: from .json in any format but .dae, otherwise in the same format; may be
    /// given several times
    #[arg(short, long, value_name = "FILE", required = true)]
    output: Vec<PathBuf>,
    /// What -o - writes to stdout: an extension
    #[arg(long, value_name = "EXTENSION", default_value = "png")]
    format: String,
    /// Choose K from the light, as without -k
    #[arg(long, conflicts_with = "exposure")]
    auto: bool,
    #[command(flatten)]
    view: ViewOptions,
}

/// Intensity = 1 - exp(-K B), written into copies of a solution.
pub(crate) fn run(arguments: &Expose) -> Result<ExitCode, Failure> {
    clashes::refuse([arguments.solution.as_path()], arguments.output.iter().map(PathBuf::as_path))?;
    let outputs = Output::all(&arguments.output, &arguments.format)?;
    let exposure = arguments.view.exposure.and_then(Exposure::new);
    match end(&arguments.solution).as_str() {
        "json" => from_json(arguments, &outputs)?,
        _ if is_stream(&arguments.solution) => from_json(arguments, &outputs)?,
        "dae" => {
            let text = Collada::open(&arguments.solution)?.exposed(exposure)?;
            save(arguments, "dae", text.as_bytes())?;
        }
        "glb" => save(arguments, "glb", &gltf::exposed(&arguments.solution, exposure)?)?,
        _ => {
            let name = arguments.solution.display();
            return Err(Failure::usage(format!("{name}: not a solution; give .json, .dae or .glb")));
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// All outputs from a solution that knows everything.
fn from_json(arguments: &Expose, outputs: &[Output]) -> Result<(), Failure> {
    let record = input::solution(&arguments.solution)?;
    let contents = Contents { view: &arguments.view, record: &record, source: None, figures: None };
    outputs.iter().try_for_each(|output| output.write(&contents))
}

/// The same bytes into every output, all of which must be of the solution's kind.
fn save(arguments: &Expose, kind: &str, bytes: &[u8]) -> Result<(), Failure> {
    if let Some(path) = arguments.output.iter().find(|path| end(path) != kind && !is_stream(path)) {
        let message = format!(
            "{}: a .{kind} solution is written as .{kind} only; a .json solution as other kinds",
            path.display()
        );
        return Err(Failure::usage(message));
    }
    arguments.output.iter().try_for_each(|path| outputs::save(path, bytes))
}

/// The extension, in lower case.
fn end(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}
