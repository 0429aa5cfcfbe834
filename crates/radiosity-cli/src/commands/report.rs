//! `radiosity report`
use crate::clashes;
use crate::failure::Failure;
use crate::input::{self, Reading};
use crate::messages::say;
use crate::outputs::Output;
use clap::Args;
use radiosity::{Scene, io, scenes};
use radiosity_report::{Peers, Plan, report};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// `radiosity report`
#[derive(Args, Debug)]
pub(crate) struct Report {
    /// Scenes: names of built-in ones, or files [default: all built-in ones, and measurements without a scene: single points,
    /// axes of stress, solvers, Booleans]
    #[arg(value_name = "SCENE")]
    scenes: Vec<String>,
    /// The folder for report.html, report.jsonl and tables.md; created if it does not exist
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Use fewer points, settings and rounds: under two minutes on two cores instead of three quarters of an hour
    #[arg(long)]
    quick: bool,
    /// Add other libraries of polygon Booleans: the JSON lines that tests/peers writes
    #[arg(long, value_name = "FILE")]
    peers: Option<PathBuf>,
}

/// What the folder gets.
const FILES: [&str; 3] = ["report.html", "report.jsonl", "tables.md"];

/// Measures every method on every scene; writes the page, the lines and the tables.
pub(crate) fn run(arguments: &Report) -> Result<ExitCode, Failure> {
    let written = FILES.map(|name| arguments.output.join(name));
    let read = arguments.scenes.iter().map(Path::new).chain(arguments.peers.as_deref());
    clashes::refuse(read, written.iter().map(PathBuf::as_path))?;
    let peers = arguments.peers.as_deref().map(peers).transpose()?;
    let plan = plan(arguments)?;
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).map_err(|error| {
        Failure::internal(format!("{}: cannot be created: {error}; name another folder", folder.display()))
    })?;
    // Half an hour of work is not begun for a folder that takes no files.
    Output::new(&folder.join("report.html"), "html")?;
    let report = report(&plan, |next| say!("{next}"))?;
    let texts = [report.page(peers.as_ref()), report.lines(), report.tables()];
    for (path, text) in written.iter().zip(texts) {
        io::save(path, text.as_bytes())?;
    }
    say!("{}: open it in a browser", folder.join("report.html").display());
    Ok(ExitCode::SUCCESS)
}

/// Every scene is read before anything is measured.
fn plan(arguments: &Report) -> Result<Plan, Failure> {
    let named = |name: &str| Ok((name.to_owned(), scene(name)?));
    let scenes: Result<Vec<(String, Scene)>, Failure> = match arguments.scenes.as_slice() {
        [] => scenes::names().map(named).collect(),
        names => names.iter().map(|name| named(name)).collect(),
    };
    Ok(Plan { scenes: scenes?, quick: arguments.quick, general: arguments.scenes.is_empty() })
}

/// A built-in scene, or one from a file.
fn scene(name: &str) -> Result<Scene, Failure> {
    let scene = match scenes::scene(name) {
        Some(scene) => scene,
        None if Path::new(name).extension().is_some() => {
            input::read_repaired(Path::new(name), Reading::default(), |_| Ok(()), || false)?.scene
        }
        None => {
            let known: Vec<_> = scenes::names().collect();
            let known = known.join(", ");
            return Err(Failure::usage(format!("no scene is named {name}; name a file, or one of {known}")));
        }
    };
    if scene.patches.iter().any(radiosity::Patch::emits) {
        return Ok(scene);
    }
    Err(Failure::scene(format!("{name}: no patch emits light; give it an emitter")))
}

fn peers(path: &Path) -> Result<Peers, Failure> {
    let name = path.display();
    let text = std::fs::read_to_string(path)
        .map_err(|error| Failure::internal(format!("{name}: cannot be read: {error}; check its name")))?;
    Peers::read(&text).map_err(|error| {
        Failure::scene(format!(
            "{name}: not lines about peers: {error}; give the peers.jsonl that tests/peers writes"
        ))
    })
}
