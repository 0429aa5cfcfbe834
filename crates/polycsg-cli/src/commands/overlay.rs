//! `polycsg overlay`
use super::files::{InputFormat, OutputFile, only_one_stdin};
use super::pairs::{HeldLayer, Parts, prepared};
use crate::failure::Failure;
use crate::formats::reader::Source;
use crate::formats::writer::Writer;
use crate::formats::{self, Format};
use crate::interrupt::Interrupt;
use crate::layer::batch::{Batch, Layer};
use crate::layer::columns::{joined, rows, side_by_side};
use crate::layer::crs::must_agree;
use crate::operands::regions;
use crate::output::Output;
use crate::progress::Progress;
use arrow_array::{RecordBatch, UInt32Array};
use arrow_schema::SchemaRef;
use clap::{Args, ValueEnum};
use polycsg::PreparedRegion;
use rayon::prelude::*;
use std::path::PathBuf;
use std::process::ExitCode;

/// `polycsg overlay`
#[derive(Args, Debug)]
#[command(
    after_help = "Features of one file are not compared with one another. Where both files have a column of one name, \
A's is called NAME_1 and B's NAME_2.

Examples:
  polycsg overlay parcels.fgb zones.fgb --op intersection -o zoned.fgb
  polycsg overlay land.geojson lakes.geojson --op difference > dry.geojson"
)]
pub(crate) struct Overlay {
    /// The first file, - for stdin
    a: PathBuf,
    /// The second file, - for stdin
    b: PathBuf,
    /// What to write
    #[arg(long, value_enum, value_name = "OPERATION")]
    op: Operation,
    #[command(flatten)]
    format: InputFormat,
    #[command(flatten)]
    output: OutputFile,
}

/// What to write.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Operation {
    /// What each feature of A has in common with each of B, with the columns of both; A may be larger than memory
    Intersection,
    /// The intersection, and what is left of each feature of A without all of B, and of B without all of A
    Union,
    /// What is left of each feature of A without all of B, with the columns of A; A may be larger than memory
    Difference,
    /// What is left of each feature of A without all of B, and of B without all of A
    SymmetricDifference,
}

/// So many features of a layer that is held are asked at a time.
const SOME: usize = 1 << 12;

/// Writes the features of the overlay.
pub(crate) fn run(arguments: &Overlay, interrupt: &Interrupt) -> Result<ExitCode, Failure> {
    only_one_stdin(&arguments.a, &arguments.b)?;
    let output = arguments.output.open(&arguments.a, &arguments.format, interrupt)?;
    let a = arguments.format.open(&arguments.a, interrupt)?;
    let b = arguments.format.open_other(&arguments.b, interrupt)?;
    must_agree((&a.layer().name, &a.layer().crs), (&b.layer().name, &b.layer().crs))?;
    match arguments.op {
        Operation::Intersection => intersection(a, HeldLayer::read(b, interrupt)?, output, interrupt)?,
        Operation::Difference => difference(a, HeldLayer::read(b, interrupt)?, output, interrupt)?,
        op => both_ways(
            &HeldLayer::read(a, interrupt)?,
            &HeldLayer::read(b, interrupt)?,
            op,
            output,
            interrupt,
        )?,
    }
    Ok(ExitCode::SUCCESS)
}

/// The intersection: A passes by, B is held.
fn intersection(
    a: Box<dyn Source>,
    b: HeldLayer,
    (output, format): (Output, Format),
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let layer = a.layer().clone();
    let mut joint = Joint::create(output, format, &layer, &b.layer)?;
    a.read(&mut |batch| {
        let regions: Vec<_> = prepared(regions(&layer, &batch, interrupt)?).collect();
        b.common(&regions, interrupt, &mut |parts| {
            joint.write_both((&batch.attributes, 0), &b.attributes, parts)
        })
    })?;
    joint.writer.finish()
}

/// The difference: A passes by, B is held.
fn difference(
    a: Box<dyn Source>,
    b: HeldLayer,
    (output, format): (Output, Format),
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let layer = a.layer().clone();
    let mut writer = formats::create(output, format, &layer)?;
    a.read(&mut |batch| {
        let regions: Vec<_> = prepared(regions(&layer, &batch, interrupt)?).collect();
        let parts = b.apart(&regions, interrupt)?;
        let attributes = rows(&batch.attributes, &UInt32Array::from(parts.first));
        let attributes = attributes.map_err(|error| Failure::data(&layer.name, error))?;
        writer.write(&Batch { first: batch.first, areas: parts.areas, attributes })
    })?;
    writer.finish()
}

/// The union or the symmetric difference.
fn both_ways(
    a: &HeldLayer,
    b: &HeldLayer,
    op: Operation,
    (output, format): (Output, Format),
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let mut joint = Joint::create(output, format, &a.layer, &b.layer)?;
    let passes = if op == Operation::Union { vec![a, a, b] } else { vec![a, b] };
    let count = passes.iter().map(|layer| layer.regions.len() as u64).sum();
    let progress = Progress::of_features("comparing", count);
    if op == Operation::Union {
        for (start, regions) in in_parts(a) {
            let mut write = |parts| joint.write_both((&a.attributes, start), &b.attributes, parts);
            b.common(regions, interrupt, &mut write)?;
            progress.add(regions.len());
        }
    }
    for (start, regions) in in_parts(a) {
        let parts = b.apart(regions, interrupt)?;
        let (left, none) = (parts.rows(start), UInt32Array::new_null(parts.areas.len()));
        joint.write((&a.attributes, &left), (&b.attributes, &none), parts)?;
        progress.add(regions.len());
    }
    for (start, regions) in in_parts(b) {
        let parts = a.apart(regions, interrupt)?;
        let (none, left) = (UInt32Array::new_null(parts.areas.len()), parts.rows(start));
        joint.write((&a.attributes, &none), (&b.attributes, &left), parts)?;
        progress.add(regions.len());
    }
    joint.writer.finish()
}

/// Some regions of a layer at a time, with the place of the first.
fn in_parts(layer: &HeldLayer) -> impl Iterator<Item = (u32, &[PreparedRegion])> {
    (0..).step_by(SOME).zip(layer.regions.chunks(SOME))
}

/// A layer with the columns of two.
struct Joint {
    writer: Writer,
    schema: SchemaRef,
    name: String,
}

impl Joint {
    fn create(output: Output, format: Format, a: &Layer, b: &Layer) -> Result<Joint, Failure> {
        let schema = joined(&a.schema, &b.schema);
        let crs = if a.crs.is_known() { a.crs.clone() } else { b.crs.clone() };
        let layer = Layer { name: format!("{}, {}", a.name, b.name), schema, crs };
        Ok(Joint { writer: formats::create(output, format, &layer)?, schema: layer.schema, name: layer.name })
    }

    /// Writes parts of which each is of a feature of both. Those of A that were asked begin with one.
    fn write_both(
        &mut self,
        (a, start): (&RecordBatch, u32),
        b: &RecordBatch,
        parts: Parts,
    ) -> Result<(), Failure> {
        let (first, second) = (parts.rows(start), UInt32Array::from(parts.second.clone()));
        self.write((a, &first), (b, &second), parts)
    }

    fn write(
        &mut self,
        a: (&RecordBatch, &UInt32Array),
        b: (&RecordBatch, &UInt32Array),
        parts: Parts,
    ) -> Result<(), Failure> {
        let attributes = side_by_side(&self.schema, a, b);
        let attributes = attributes.map_err(|error| Failure::data(&self.name, error))?;
        self.writer.write(&Batch { first: 0, areas: parts.areas, attributes })
    }
}

impl Parts {
    /// The rows of the first layer, of which those that were asked begin with one.
    fn rows(&self, start: u32) -> UInt32Array {
        self.first.iter().map(|row| start + row).collect::<Vec<u32>>().into()
    }
}
