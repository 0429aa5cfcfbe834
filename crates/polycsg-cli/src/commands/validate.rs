//! `polycsg validate`
use super::files::{InputFormat, print};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::layer::areas::{Areas, rings};
use crate::layer::columns::named;
use crate::messages::say;
use crate::operands::each;
use clap::Args;
use polycsg::{Flaw, Scratch, flaw};
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

/// What the command ends with where a feature is not valid.
const INVALID: u8 = 4;

/// `polycsg validate`
#[derive(Args, Debug)]
#[command(
    after_help = "Example: polycsg validate parcels.geojson || polycsg repair parcels.geojson -o sound.geojson"
)]
pub(crate) struct Validate {
    /// The file to read, - for stdin
    file: PathBuf,
    #[command(flatten)]
    format: InputFormat,
}

/// Prints a line for each feature that is not valid.
pub(crate) fn run(arguments: &Validate, interrupt: &Interrupt) -> Result<ExitCode, Failure> {
    let source = arguments.format.open(&arguments.file, interrupt)?;
    let layer = source.layer().clone();
    let (mut invalid, mut count) = (0, 0);
    source.read(&mut |batch| {
        interrupt.check()?;
        let found = each(&layer, &batch, |scratch, areas| Ok(flaw_of(areas, scratch)))?;
        let mut lines = String::new();
        for (row, flaw) in found.into_iter().enumerate() {
            count += 1;
            if let Some(flaw) = flaw.flatten() {
                invalid += 1;
                // Writing to a string cannot fail.
                let _ = writeln!(lines, "{}: {flaw}", named(&layer, &batch, row));
            }
        }
        print(&lines)
    })?;
    say!("{invalid} of {count} features are not valid");
    Ok(if invalid == 0 { ExitCode::SUCCESS } else { ExitCode::from(INVALID) })
}

/// Why a feature is not valid as it stands.
pub(crate) fn flaw_of(areas: &Areas, scratch: &mut Scratch) -> Option<Flaw> {
    let polygons = areas.polygons.iter().map(|polygon| {
        rings(polygon).map(|ring| ring.0.iter().map(|point| [point.x, point.y]).collect::<Vec<_>>())
    });
    flaw(polygons, scratch)
}
