//! `radiosity plot`
use crate::clashes;
use crate::failure::Failure;
use crate::input;
use crate::outputs::{is_stream, print, probe, save};
use clap::Args;
use radiosity::glam::DVec3;
use radiosity::profile::{Profile, profile};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// `radiosity plot`
#[derive(Args, Debug)]
pub(crate) struct Plot {
    /// A solution: a .json file of solve
    solution: PathBuf,
    /// Where the line starts, in the scene's coordinates
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = place)]
    from: DVec3,
    /// Where it ends
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = place)]
    to: DVec3,
    /// The patch that the line is drawn on [default: the surface that it lies on]
    #[arg(long, value_name = "PATCH")]
    on: Option<String>,
    /// Write a table (.csv) or a drawing (.svg) to this file; may be given several times [default: the table to stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
}

/// A way to write a profile.
type Form = fn(&Profile) -> String;

/// Three finite numbers with commas between them.
fn place(text: &str) -> Result<DVec3, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|word| word.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) if [x, y, z].into_iter().all(f64::is_finite) => Ok(DVec3::new(x, y, z)),
        _ => Err("give three numbers, as 1,0.5,2".to_owned()),
    }
}

/// Writes radiosity along a line.
pub(crate) fn run(arguments: &Plot) -> Result<ExitCode, Failure> {
    clashes::refuse([arguments.solution.as_path()], arguments.output.iter().map(PathBuf::as_path))?;
    let forms = arguments.output.iter().map(|path| form(path)).collect::<Result<Vec<Form>, Failure>>()?;
    let record = input::solution(&arguments.solution)?;
    let found = profile(&record, [arguments.from, arguments.to], arguments.on.as_deref());
    let profile =
        found.map_err(|error| Failure::usage(format!("{}: {error}", arguments.solution.display())))?;
    if arguments.output.is_empty() {
        print(&profile.csv())?;
    }
    for (path, form) in arguments.output.iter().zip(forms) {
        save(path, form(&profile).as_bytes())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// By the end of the file's name; its folder must take new files.
fn form(path: &Path) -> Result<Form, Failure> {
    let end = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let form: Form = match end.as_str() {
        _ if is_stream(path) => Profile::csv,
        "csv" => Profile::csv,
        "svg" => Profile::svg,
        _ => {
            return Err(Failure::usage(format!(
                "{}: unknown kind of file; name it .csv or .svg",
                path.display()
            )));
        }
    };
    probe(path)?;
    Ok(form)
}
