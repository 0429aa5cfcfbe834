//! `radiosity factors`
mod format;
mod matrix;

use crate::failure::Failure;
use crate::input;
use crate::outputs::print;
use crate::parse::positive;
use clap::{Args, ValueEnum};
use format::Table;
use matrix::Row;
use radiosity::formfactor::{DifferentialArea, Enclosure};
use radiosity::glam::DVec3;
use radiosity::{Scene, io};
use std::{path::PathBuf, process::ExitCode};

/// `radiosity factors`
#[derive(Args, Debug)]
pub(crate) struct Factors {
    /// The scene: a COLLADA (.dae), glTF (.gltf, .glb) or View3D (.vs3) file
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
    /// The output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// The same as --format json
    #[arg(long, conflicts_with = "format")]
    json: bool,
    /// Write to this file [default: stdout]
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
}

/// Prints form factors: from a point, or from patches, to every patch.
pub(crate) fn run(arguments: &Factors) -> Result<ExitCode, Failure> {
    let whole = arguments.row.is_empty() && arguments.from.is_none();
    if arguments.format == Format::View3d && !(whole && arguments.area.is_some()) {
        let message = "View3D's format holds a whole matrix from area to area; give --area TOLERANCE and no --row or --from";
        return Err(Failure::usage(message));
    }
    let (scene, _) = input::read(&arguments.scene)?;
    let rows = rows(arguments, &scene)?;
    let table = Table { scene: &scene, rows: &rows, tolerance: arguments.area };
    let text = match (arguments.json, arguments.format) {
        (true, _) | (_, Format::Json) => table.json(),
        (_, Format::Text) => table.text(),
        (_, Format::Csv) => table.csv(),
        (_, Format::View3d) => table.view3d(),
    };
    match &arguments.output {
        Some(path) => io::save(path, text.as_bytes())?,
        None => print(&text)?,
    }
    Ok(ExitCode::SUCCESS)
}

/// The rows asked for.
fn rows(arguments: &Factors, scene: &Scene) -> Result<Vec<Row>, Failure> {
    let enclosure = Enclosure::new(scene.patches.iter().map(|patch| patch.polygon.clone()).collect());
    if let Some([x, y, z, nx, ny, nz]) = arguments.from {
        let place = (DVec3::new(x, y, z), DVec3::new(nx, ny, nz));
        let mut from = DifferentialArea::new(place.0, place.1).map_err(Failure::usage)?;
        if let Some(name) = &arguments.on {
            from = from.owned_by(find(scene, name)?);
        }
        return Ok(vec![Row::of_point(&enclosure, &from)]);
    }
    let named = arguments.row.iter().map(|name| find(scene, name));
    let named = named.collect::<Result<Vec<_>, _>>()?;
    match arguments.area {
        None => Ok(matrix::from_middles(scene, &enclosure, &named)),
        Some(tolerance) => matrix::from_areas(scene, &enclosure, &named, tolerance),
    }
}

/// The index of the patch of that name.
fn find(scene: &Scene, name: &str) -> Result<usize, Failure> {
    scene.patches.iter().position(|patch| patch.name == name).ok_or_else(|| {
        let known: Vec<_> = scene.patches.iter().take(20).map(|patch| patch.name.as_str()).collect();
        let more = if scene.patches.len() > known.len() { ", …" } else { "" };
        Failure::usage(format!("no patch is named {name}; the scene has {}{more}", known.join(", ")))
    })
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
