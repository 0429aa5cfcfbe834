//! `polycsg clip`
use super::files::{InputFormat, OutputFile, only_one_stdin};
use crate::failure::Failure;
use crate::formats::{self, reader::Source};
use crate::interrupt::Interrupt;
use crate::layer::areas::Areas;
use crate::layer::batch::Batch;
use crate::layer::columns::rows;
use crate::layer::crs::must_agree;
use crate::operands::{each, evaluated, operand, regions};
use arrow_array::UInt32Array;
use clap::Args;
use polycsg::{Csg, Error, Limits, PreparedRegion, Scratch};
use std::path::PathBuf;
use std::process::ExitCode;

/// `polycsg clip`
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  polycsg clip buildings.parquet --by district.geojson -o inside.parquet
  zcat buildings.geojson.gz | polycsg clip - --from geojson --by district.fgb > inside.geojson")]
pub(crate) struct Clip {
    /// The file to clip, - for stdin; it may be larger than memory
    file: PathBuf,
    /// The file whose features together are the mask
    #[arg(long, value_name = "MASK")]
    by: PathBuf,
    #[command(flatten)]
    format: InputFormat,
    #[command(flatten)]
    output: OutputFile,
}

/// Writes the part of each feature that lies in the mask.
pub(crate) fn run(arguments: &Clip, interrupt: &Interrupt) -> Result<ExitCode, Failure> {
    only_one_stdin(&arguments.file, &arguments.by)?;
    let (output, format) = arguments.output.open(&arguments.file, &arguments.format, interrupt)?;
    let mask = arguments.format.open_other(&arguments.by, interrupt)?;
    let source = arguments.format.open(&arguments.file, interrupt)?;
    let layer = source.layer().clone();
    must_agree((&layer.name, &layer.crs), (&mask.layer().name, &mask.layer().crs))?;
    let mask = united(mask, interrupt)?;
    let mut writer = formats::create(output, format, &layer)?;
    source.read(&mut |batch| {
        let regions = regions(&layer, &batch, interrupt)?;
        let is_set = || interrupt.is_set();
        let parts = mask.try_clip_all(&regions, Limits::default().stop(&is_set));
        let parts = parts.map_err(|_| Failure::Interrupted)?;
        let (mut kept, mut areas) = (Vec::new(), Vec::new());
        for (row, part) in (0..).zip(&parts).filter(|(_, part)| !part.is_empty()) {
            kept.push(row);
            areas.push(Areas::of(part));
        }
        let attributes = rows(&batch.attributes, &UInt32Array::from(kept));
        let attributes = attributes.map_err(|error| Failure::data(&layer.name, error))?;
        writer.write(&Batch { first: batch.first, areas, attributes })
    })?;
    writer.finish()?;
    Ok(ExitCode::SUCCESS)
}

/// All features of a layer as one region.
fn united(source: Box<dyn Source>, interrupt: &Interrupt) -> Result<PreparedRegion, Failure> {
    let (layer, mut operands) = (source.layer().clone(), Vec::new());
    source.read(&mut |batch| {
        operands.extend(each(&layer, &batch, |_, areas| operand(areas))?.into_iter().flatten());
        Ok(())
    })?;
    let region = evaluated(&Csg::union(operands), &mut Scratch::default(), interrupt);
    let region = region.map_err(|error| match error {
        Error::Stopped => Failure::Interrupted,
        error => Failure::data(&layer.name, error),
    })?;
    Ok(PreparedRegion::from(region))
}
