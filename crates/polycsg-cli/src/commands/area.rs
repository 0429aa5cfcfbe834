//! `polycsg area`
use super::files::{InputFormat, print};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::layer::areas::Areas;
use crate::layer::columns;
use crate::operands::{each, operand};
use clap::Args;
use polycsg::{Limits, Scratch};
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

/// `polycsg area`
#[derive(Args, Debug)]
#[command(after_help = "Example: polycsg area parcels.fgb | sort -k 2 -g | tail -n 1")]
pub(crate) struct Area {
    /// The file to read, - for stdin
    file: PathBuf,
    #[command(flatten)]
    format: InputFormat,
}

/// Prints a line for each feature.
pub(crate) fn run(arguments: &Area, interrupt: &Interrupt) -> Result<ExitCode, Failure> {
    let source = arguments.format.open(&arguments.file, interrupt)?;
    let layer = source.layer().clone();
    source.read(&mut |batch| {
        let found = each(&layer, &batch, |scratch: &mut Scratch, areas: &Areas| {
            let is_set = || interrupt.is_set();
            Ok(operand(areas)?.try_boundary(scratch, Limits::default().stop(&is_set))?.area())
        })?;
        let mut lines = String::new();
        for (row, area) in found.into_iter().enumerate() {
            // Writing to a string cannot fail.
            let _ = write!(lines, "{}\t{}", batch.first + row, area.unwrap_or_default());
            let id = columns::id(&layer.schema, &batch.attributes, row);
            let _ = writeln!(lines, "{}", id.map_or(String::new(), |id| format!("\t{id}")));
        }
        print(&lines)
    })?;
    Ok(ExitCode::SUCCESS)
}
