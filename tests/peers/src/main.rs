//! Runs polycsg and its peers side by side on the same inputs and writes a table. See the README.

mod bench;
mod child;
mod memory;
mod scaling;
mod table;
mod worker;
mod workloads;

use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;

/// polycsg and its peers side by side: CPU seconds per Boolean, minimum over interleaved rounds.
#[derive(Parser)]
struct Arguments {
    /// Smaller inputs and fewer rounds: done within ten minutes.
    #[arg(long)]
    quick: bool,
    /// Print one JSON object per row on stdout.
    #[arg(long)]
    json: bool,
    /// Only the workloads whose name contains this; may be given several times.
    #[arg(long, value_name = "TEXT")]
    only: Vec<String>,
    /// Where peers.md and peers.jsonl go; by default into target-data beside this program's sources.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Serve one engine on one input over stdin and stdout (how the bench starts its own children).
    #[arg(long, hide = true, num_args = 3, value_names = ["ENGINE", "FAMILY", "SIZE"])]
    worker: Option<Vec<String>>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match &arguments.worker {
        Some(job) => worker::serve(job),
        None => run(&arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), String> {
    let maps = peers::shapes::fetch();
    if let Err(message) = &maps {
        eprintln!("no map rows: {message}");
    }
    let effort = if arguments.quick { bench::QUICK } else { bench::FULL };
    let is_asked_for =
        |name: &str| arguments.only.is_empty() || arguments.only.iter().any(|text| name.contains(text));
    let workloads = workloads::workloads(arguments.quick, maps.is_ok());
    let chosen = workloads.into_iter().filter(|workload| is_asked_for(&workload.name()));
    let output = arguments.output.clone().unwrap_or_else(peers::shapes::folder);
    let mut bench = bench::Bench::new(effort);
    let mut rows = Vec::new();
    for workload in chosen {
        let row = bench.row(&workload)?;
        table::show(&row, arguments.json);
        rows.push(row);
        // After every row, so that a run which is stopped leaves what it has.
        table::write(&rows, &output)?;
    }
    table::conclude(&rows, arguments.json);
    Ok(())
}
