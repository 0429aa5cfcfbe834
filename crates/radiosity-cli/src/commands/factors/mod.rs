//! `radiosity factors`
//!
//! ```text
//! format    rows as text
//! npz       a matrix for numpy and scipy
//! matrix    the matrix from area to area: what is done to it, and its rows
//! pairs     what patches exchange: on all threads, row by row, to a journal
//! journal   rows found so far, in a file
//! tally     progress and the time left
//! row       rows of form factors
//! names     patches by their names
//! ```
mod format;
mod journal;
mod matrix;
mod names;
mod npz;
mod pairs;
mod row;
mod tally;

use crate::clashes;
use crate::commands::patience::Patience;
use crate::failure::Failure;
use crate::input;
use crate::messages::say;
use crate::outputs::{is_stream, print, save};
use crate::parse::positive;
use crate::waiting::wait;
use clap::{Args, ValueEnum};
use format::Table;
use matrix::Found;
use radiosity::formfactor::{DifferentialArea, Enclosure, Limits};
use radiosity::glam::DVec3;
use radiosity::inspect::Finding;
use radiosity::io::Source;
use radiosity::{Scene, inspect, io};
use row::Origin;
use std::{path::PathBuf, process::ExitCode};

/// `radiosity factors`
#[derive(Args, Debug)]
pub(crate) struct Factors {
    /// The scene: a COLLADA (.dae), glTF (.gltf, .glb), OBJ (.obj), PLY (.ply), STL (.stl) or View3D (.vs3) file; - for standard input
    scene: PathBuf,
    /// From this point with this normal, in the file's units and axes
    #[arg(long, value_name = "X,Y,Z,NX,NY,NZ", value_parser = point_and_normal, allow_hyphen_values = true)]
    from: Option<[f64; 6]>,
    /// The patch that the point lies on; it neither blocks the view nor is seen
    #[arg(long, value_name = "PATCH", requires = "from")]
    on: Option<String>,
    /// From this patch; may be given several times [default: the whole matrix, without --from]
    #[arg(long, value_name = "PATCH", conflicts_with = "from")]
    row: Vec<String>,
    /// From area to area, each row to this absolute tolerance [default: exactly from the middle of each patch]
    #[arg(long, value_name = "TOLERANCE", value_parser = positive, conflicts_with = "from")]
    area: Option<f64>,
    /// What is done to the whole matrix
    #[command(flatten)]
    changes: matrix::Changes,
    /// Stop after so many seconds, without a result; the same command goes on from there with --area, -o and no --row
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    time: Option<f64>,
    /// The output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// The same as --format json
    #[arg(long, conflicts_with = "format")]
    json: bool,
    /// Write to this file; - for stdout [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// `--format`
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Columns for people
    Text,
    /// Factors that are not 0, one a line
    Csv,
    /// Everything, as JSON
    Json,
    /// The output format 0 of View3D: areas, the matrix, emittances; needs --area and the whole matrix
    View3d,
    /// Compressed sparse rows for scipy.sparse.load_npz, with errors and names; needs --area, the whole matrix and -o
    Npz,
}

/// Prints form factors: from a point, or from patches, to every patch.
pub(crate) fn run(arguments: &Factors) -> Result<ExitCode, Failure> {
    let format = if arguments.json { Format::Json } else { arguments.format };
    check(arguments, format)?;
    let output = arguments.output.as_deref().filter(|path| !is_stream(path));
    let journal = output.and_then(pairs::beside);
    clashes::refuse([arguments.scene.as_path()], output.into_iter().chain(journal.as_deref()))?;
    // Reading counts.
    let patience = Patience::new(arguments.time);
    let is_late = || patience.is_over();
    let (scene, source, (enclosure, overlaps)) =
        input::read(&arguments.scene, enclosed(arguments.area), is_late)?;
    overlaps.iter().for_each(|finding| {
        say!("warning: {}: {finding}", finding.patches.join(" and "));
    });
    let found = match arguments.area {
        Some(tolerance) if is_matrix(arguments) => {
            patience.listen()?;
            let request = match &source {
                Source::Vs3(file) => Some(file.request()?),
                _ => None,
            };
            let pairs = pairs::find(&enclosure, tolerance, output, &patience)?;
            let Some(pairs) = pairs else { return Ok(patience.code()) };
            matrix::finish(&scene, pairs, request, &arguments.changes)?
        }
        Some(tolerance) => {
            patience.listen()?;
            let named = named(arguments, &scene)?;
            let found = row::from_areas(&enclosure, &named, tolerance, &patience)?;
            if found.len() < named.len() {
                say!("stopped: {} of {} rows are there", found.len(), arguments.row.len());
                return Ok(patience.code());
            }
            Found::of(&scene, found)
        }
        // Ctrl-C ends these at once.
        None => {
            let origin = origin(arguments, &scene)?;
            let found = move || Ok(Found::of(&scene, origin.rows(&scene, &enclosure)));
            wait(found, is_late, "all factors were found")?
        }
    };
    let table = Table { found: &found, tolerance: arguments.area };
    let text = match format {
        Format::Text => table.text(),
        Format::Csv => table.csv(),
        Format::Json => table.json(),
        Format::View3d => table.view3d(),
        Format::Npz => String::new(),
    };
    match output {
        Some(path) if format == Format::Npz => {
            io::save_with(path, |file| npz::write(&found, file).map_err(std::io::Error::from))?;
        }
        Some(path) => save(path, text.as_bytes())?,
        None => print(&text)?,
    }
    if is_matrix(arguments) {
        pairs::forget(output);
    }
    Ok(ExitCode::SUCCESS)
}

/// The patches of a scene as they see each other; for factors from area to area with all that these need, and with the overlaps.
fn enclosed(area: Option<f64>) -> impl FnOnce(&Scene) -> (Enclosure, Vec<Finding>) + Send + 'static {
    move |scene| {
        let polygons = scene.patches.iter().map(|patch| patch.polygon.clone()).collect();
        let enclosure = Enclosure::new(polygons);
        let Some(tolerance) = area.filter(|_| !scene.patches.is_empty()) else {
            return (enclosure, Vec::new());
        };
        // The first factor finds what all need, before it looks at its limits.
        let _ = enclosure.exchange_row(0, tolerance, &Limits { stop: &|| true, ..Limits::default() });
        (enclosure, inspect::coplanar_overlaps(scene))
    }
}

/// Whether it is the whole matrix from area to area.
fn is_matrix(arguments: &Factors) -> bool {
    arguments.area.is_some() && arguments.row.is_empty() && arguments.from.is_none()
}

/// Refuses what only a whole matrix from area to area has.
fn check(arguments: &Factors, format: Format) -> Result<(), Failure> {
    let is_matrix = is_matrix(arguments);
    let needs = "a whole matrix from area to area; give --area TOLERANCE and no --row or --from";
    if format == Format::View3d && !is_matrix {
        return Err(Failure::usage(format!("View3D's format holds {needs}")));
    }
    if format == Format::Npz && !(is_matrix && arguments.output.as_ref().is_some_and(|path| !is_stream(path)))
    {
        return Err(Failure::usage(format!("npz holds {needs}, and is no text; give -o FILE.npz")));
    }
    if arguments.changes.are_asked() && !is_matrix {
        return Err(Failure::usage(format!("--close, --space, --drop-below and --group change {needs}")));
    }
    Ok(())
}

/// Where factors are asked for from, exactly.
fn origin(arguments: &Factors, scene: &Scene) -> Result<Origin, Failure> {
    let Some([x, y, z, nx, ny, nz]) = arguments.from else {
        return Ok(Origin::Middles(named(arguments, scene)?));
    };
    let from = DifferentialArea::new(DVec3::new(x, y, z), DVec3::new(nx, ny, nz)).map_err(Failure::usage)?;
    let patch = arguments.on.as_ref().map(|name| find(scene, name)).transpose()?;
    Ok(Origin::Point(match patch {
        Some(patch) => from.owned_by(patch),
        None => from,
    }))
}

/// The patches that rows are asked for from.
fn named(arguments: &Factors, scene: &Scene) -> Result<Vec<usize>, Failure> {
    arguments.row.iter().map(|name| find(scene, name)).collect()
}

/// The index of the patch of that name.
fn find(scene: &Scene, name: &str) -> Result<usize, Failure> {
    let names = scene.patches.iter().map(|patch| patch.name.as_str());
    names::place(names, name).map_err(Failure::usage)
}

/// Six finite numbers, the last three not all zero.
fn point_and_normal(text: &str) -> Result<[f64; 6], String> {
    let numbers: Vec<f64> = text
        .split(',')
        .map(|part| part.trim().parse())
        .collect::<Result<_, _>>()
        .map_err(|_| "not numbers")?;
    let found = numbers.len();
    let numbers: [f64; 6] = numbers.try_into().map_err(|_| format!("{found} numbers where 6 are needed"))?;
    if numbers.iter().any(|number| !number.is_finite()) || numbers[3..] == [0.0; 3] {
        return Err("give finite numbers and a normal that is not zero".to_owned());
    }
    Ok(numbers)
}
