//! `polycsg repair`
use super::files::{InputFormat, OutputFile};
use super::validate::flaw_of;
use crate::failure::Failure;
use crate::formats;
use crate::interrupt::Interrupt;
use crate::layer::areas::Areas;
use crate::layer::batch::Batch;
use crate::messages::say;
use crate::operands::{each, evaluated, operand};
use clap::Args;
use polycsg::{Error, Scratch};
use std::path::PathBuf;
use std::process::ExitCode;

/// `polycsg repair`
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  polycsg repair parcels.geojson -o sound.geojson
  polycsg repair parcels.parquet -o parcels.fgb      # valid features as they are: this converts")]
pub(crate) struct Repair {
    /// The file to read, - for stdin
    file: PathBuf,
    #[command(flatten)]
    format: InputFormat,
    #[command(flatten)]
    output: OutputFile,
}

/// What a feature becomes.
enum Repaired {
    /// It is valid, and stays bit for bit what it was.
    Kept,
    /// None where nothing is left.
    Changed(Option<Areas>),
}

/// Writes all features, those that are not valid made valid.
pub(crate) fn run(arguments: &Repair, interrupt: &Interrupt) -> Result<ExitCode, Failure> {
    let (output, format) = arguments.output.open(&arguments.file, &arguments.format, interrupt)?;
    let source = arguments.format.open(&arguments.file, interrupt)?;
    let layer = source.layer().clone();
    let mut writer = formats::create(output, format, &layer)?;
    let (mut changed, mut lost, mut count) = (0, 0, 0);
    source.read(&mut |batch| {
        let found = each(&layer, &batch, |scratch, areas| repaired(areas, scratch, interrupt))?;
        let mut areas = Vec::with_capacity(found.len());
        for (before, found) in batch.areas.into_iter().zip(found) {
            areas.push(match found {
                None | Some(Repaired::Kept) => before,
                Some(Repaired::Changed(now)) => {
                    changed += 1;
                    lost += usize::from(now.is_none());
                    now
                }
            });
        }
        count += areas.len();
        writer.write(&Batch { areas, ..batch })
    })?;
    writer.finish()?;
    let nothing =
        if lost > 0 { format!("; of {lost} nothing is left, as they had no area") } else { String::new() };
    say!("{changed} of {count} features were repaired{nothing}");
    Ok(ExitCode::SUCCESS)
}

fn repaired(areas: &Areas, scratch: &mut Scratch, interrupt: &Interrupt) -> Result<Repaired, Error> {
    let operand = operand(areas)?;
    if flaw_of(areas, scratch).is_none() {
        return Ok(Repaired::Kept);
    }
    Ok(Repaired::Changed(Areas::of(&evaluated(&operand, scratch, interrupt)?)))
}
