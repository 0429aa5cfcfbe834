//! `radiosity view`
use super::patience::Patience;
use crate::clashes;
use crate::failure::Failure;
use crate::input::{self, STREAM};
use crate::messages::say;
use crate::outputs::{Contents, Output, is_stream, save};
use crate::parse::positive;
use crate::view_options::ViewOptions;
use crate::waiting::wait;
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
    /// Stop after so many seconds, without a page; large solutions take some to read
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    time: Option<f64>,
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
    clashes::refuse([arguments.solution.as_path()], [path.as_path()])?;
    let output = Output::new(&path, "html")?;
    let patience = Patience::new(arguments.time);
    let (solution, exposure) = (arguments.solution.clone(), arguments.exposure);
    let page = move || {
        let record = input::solution(&solution)?;
        let view = ViewOptions { exposure, width: 1, camera: None };
        output.bytes(&Contents { view: &view, record: &record, source: None, figures: None })
    };
    save(&path, &wait(page, || patience.is_over(), "the page was made")?)?;
    if !is_stream(&path) {
        say!("{}: open it in a browser", path.display());
    }
    Ok(ExitCode::SUCCESS)
}
