//! `radiosity view`
use crate::failure::Failure;
use crate::input::{self, STREAM};
use crate::outputs::{Contents, Output, is_stream};
use crate::parse::positive;
use crate::view_options::ViewOptions;
use clap::Args;
use std::{path::PathBuf, process::ExitCode};

/// `radiosity view`
#[derive(Args, Debug)]
pub(crate) struct View {
    /// A solution: a .json file of solve; - for standard input
    solution: PathBuf,
    /// Write the page to this file [default: beside the solution, as .html; - for stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The exposure K to start with: intensity is 1 - exp(-K B) [default: chosen from what the first camera sees]
    #[arg(short = 'k', long, value_name = "K", value_parser = positive)]
    exposure: Option<f64>,
}

/// Writes one page that shows the solution in any browser, without network.
pub(crate) fn run(arguments: &View) -> Result<ExitCode, Failure> {
    let beside = || match is_stream(&arguments.solution) {
        true => PathBuf::from(STREAM),
        false => arguments.solution.with_extension("html"),
    };
    let path = arguments.output.clone().unwrap_or_else(beside);
    if !is_stream(&path) && path.extension().is_none_or(|end| !end.eq_ignore_ascii_case("html")) {
        return Err(Failure::usage(format!("{}: the output is a page; name it .html", path.display())));
    }
    let output = Output::new(&path, "html")?;
    let record = input::solution(&arguments.solution)?;
    let view = ViewOptions { exposure: arguments.exposure, width: 1, camera: None };
    output.write(&Contents { view: &view, record: &record, source: None, figures: None })?;
    if !is_stream(&path) {
        eprintln!("{}: open it in a browser", path.display());
    }
    Ok(ExitCode::SUCCESS)
}
