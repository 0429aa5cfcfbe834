//! `polycsg dissolve`
use super::files::{InputFormat, OutputFile};
use crate::failure::Failure;
use crate::formats::{self, reader::Source};
use crate::interrupt::Interrupt;
use crate::layer::areas::Areas;
use crate::layer::batch::{Batch, Layer};
use crate::layer::columns::{ordinary, rows};
use crate::operands::{each, evaluated, operand};
use crate::progress::Progress;
use arrow_array::{RecordBatch, UInt32Array};
use arrow_row::{RowConverter, Rows, SortField};
use arrow_schema::{ArrowError, Schema};
use arrow_select::concat::concat_batches;
use clap::Args;
use polycsg::{Csg, Error, Region, Scratch};
use rayon::prelude::*;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

/// `polycsg dissolve`
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  polycsg dissolve counties.geojson --by state -o states.geojson
  polycsg dissolve tiles.fgb -o outline.fgb            # all features as one")]
pub(crate) struct Dissolve {
    /// The file to read, - for stdin
    file: PathBuf,
    /// Features with equal values in this column become one; may be given more than once
    #[arg(long, value_name = "COLUMN")]
    by: Vec<String>,
    #[command(flatten)]
    format: InputFormat,
    #[command(flatten)]
    output: OutputFile,
}

/// All features: their polygons, and the columns that they are grouped by.
struct AllFeatures {
    areas: Vec<Areas>,
    keys: RecordBatch,
}

/// Writes one feature for each group, in the order of their keys.
pub(crate) fn run(arguments: &Dissolve, interrupt: &Interrupt) -> Result<ExitCode, Failure> {
    let (output, format) = arguments.output.open(&arguments.file, &arguments.format, interrupt)?;
    let source = arguments.format.open(&arguments.file, interrupt)?;
    let layer = source.layer().clone();
    let (columns, keys) = keys(&layer, &arguments.by)?;
    let broken = |error: ArrowError| Failure::data(&layer.name, error);
    let held = hold(source, &columns, &keys, interrupt)?;
    let sorted = sorted(&held.keys).map_err(broken)?;
    let groups = groups(&sorted);
    let united = unite(&held.areas, &groups, interrupt)?;
    let firsts = groups.iter().map(|group| group[0]).collect::<UInt32Array>();
    let attributes = rows(&held.keys, &firsts).map_err(broken)?;
    let layer = Layer { schema: keys, ..layer };
    let mut writer = formats::create(output, format, &layer)?;
    writer.write(&Batch { first: 0, areas: united.iter().map(Areas::of).collect(), attributes })?;
    writer.finish()?;
    Ok(ExitCode::SUCCESS)
}

/// The places of the columns that are asked for, each once, and their schema.
fn keys(layer: &Layer, by: &[String]) -> Result<(Vec<usize>, Arc<Schema>), Failure> {
    let place = |name: &String| {
        layer.schema.index_of(name).map_err(|_| {
            let names: Vec<&str> = layer.schema.fields().iter().map(|field| field.name().as_str()).collect();
            let known = if names.is_empty() {
                "it has no columns".into()
            } else {
                format!("it has {}", names.join(", "))
            };
            Failure::Usage(format!("{}: there is no column {name:?}; {known}", layer.name))
        })
    };
    let mut columns = Vec::new();
    for column in by.iter().map(place) {
        let column = column?;
        if !columns.contains(&column) {
            columns.push(column);
        }
    }
    let fields = columns.iter().map(|&column| ordinary(&layer.schema.fields()[column]));
    let schema = Schema::new(fields.collect::<Vec<_>>());
    Ok((columns, Arc::new(schema)))
}

/// Reads what is needed of all features. Those without a geometry keep their place in their group.
fn hold(
    source: Box<dyn Source>,
    columns: &[usize],
    keys: &Arc<Schema>,
    interrupt: &Interrupt,
) -> Result<AllFeatures, Failure> {
    let (layer, mut areas, mut tables) = (source.layer().clone(), Vec::new(), Vec::new());
    let broken = |error: ArrowError| Failure::data(&layer.name, error);
    source.read(&mut |batch| {
        interrupt.check()?;
        // What cannot be an operand is named while its number is known.
        each(&layer, &batch, |_, areas| operand(areas).map(|_| ()))?;
        let columns = columns.iter().map(|&column| Arc::clone(batch.attributes.column(column))).collect();
        let rows = batch.areas.len();
        tables.push(crate::layer::batch::table(Arc::clone(keys), columns, rows).map_err(broken)?);
        let nothing = || Areas::multi_polygon([]);
        areas.extend(batch.areas.into_iter().map(|areas| areas.unwrap_or_else(nothing)));
        Ok(())
    })?;
    Ok(AllFeatures { areas, keys: together(keys, &tables).map_err(broken)? })
}

/// Tables one behind another, also where they have no columns.
fn together(schema: &Arc<Schema>, tables: &[RecordBatch]) -> Result<RecordBatch, ArrowError> {
    if schema.fields().is_empty() {
        let rows = tables.iter().map(RecordBatch::num_rows).sum();
        return crate::layer::batch::table(Arc::clone(schema), vec![], rows);
    }
    concat_batches(schema, tables)
}

/// The keys in an order of their values, and the feature of each.
fn sorted(keys: &RecordBatch) -> Result<Vec<(u32, usize)>, ArrowError> {
    let count = u32::try_from(keys.num_rows())
        .map_err(|_| ArrowError::MemoryError("more than 2^32 features".into()))?;
    if keys.num_columns() == 0 {
        return Ok((0..count).map(|feature| (feature, 0)).collect());
    }
    let fields =
        keys.schema().fields().iter().map(|field| SortField::new(field.data_type().clone())).collect();
    let rows: Rows = RowConverter::new(fields)?.convert_columns(keys.columns())?;
    let mut features: Vec<u32> = (0..count).collect();
    features.sort_by(|&a, &b| rows.row(a as usize).cmp(&rows.row(b as usize)));
    let mut group = 0;
    let numbered = features.iter().enumerate().map(|(place, &feature)| {
        let is_new = place > 0 && rows.row(features[place - 1] as usize) != rows.row(feature as usize);
        group += usize::from(is_new);
        (feature, group)
    });
    Ok(numbered.collect())
}

/// The features of each group.
fn groups(sorted: &[(u32, usize)]) -> Vec<Vec<u32>> {
    sorted
        .chunk_by(|a, b| a.1 == b.1)
        .map(|group| group.iter().map(|(feature, _)| *feature).collect())
        .collect()
}

fn unite(areas: &[Areas], groups: &[Vec<u32>], interrupt: &Interrupt) -> Result<Vec<Region>, Failure> {
    let progress = Progress::of_features("uniting", areas.len() as u64);
    let one = |scratch: &mut Scratch, group: &Vec<u32>| {
        let operands: Result<Vec<_>, Error> = group.iter().map(|&i| operand(&areas[i as usize])).collect();
        let united = evaluated(&Csg::union(operands?), scratch, interrupt);
        progress.add(group.len());
        united
    };
    let found: Result<Vec<Region>, Error> = groups.par_iter().map_init(Scratch::default, one).collect();
    // Every operand has been one before.
    found.map_err(|_| Failure::Interrupted)
}
