//! True errors and CPU time of whole scenes, by the mesh and by levels, beside path tracing.
//!
//! ```sh
//! cargo run --release -p tests --example error_against_time -- [PATHS] [SCENE]...
//! ```
//!
//! A scene is a built-in one, a kind of room, or `town-SIDE` of so many houses along each side. At most 60 faces are compared, at equal distances
//! in the scene's order, each by so many paths. Errors are in shares of a face's own mean or, where that is more, 1 % of the mean of those faces;
//! three standard errors of the path tracer are taken off.
mod beside_paths;
mod traced;

use beside_paths::{errors, root_mean_square, scene};
use cpu_time::ProcessTime;
use radiosity::{Method, Options, Quality, Solution, scenes, solve};
use std::error::Error;
use std::io::{self, Write};
use std::ops::ControlFlow;
use tests::light::{Estimate, KINDS, Surface, mean_irradiance, room, town};

const FACES: usize = 60;
const QUALITIES: [(&str, Quality); 3] =
    [("draft", Quality::Draft), ("normal", Quality::Normal), ("high", Quality::High)];
const ERRORS: [f64; 4] = [0.3, 0.1, 0.03, 0.01];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let paths = arguments.first().map_or(Ok(20_000), |text| text.parse())?;
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "| scene | patches | run | worst | root mean square | estimates too low | CPU s |\n\
         | --- | --- | --- | --- | --- | --- | --- |"
    )?;
    for name in arguments.iter().skip(1) {
        let surfaces = surfaces(name)?;
        let step = surfaces.len().div_ceil(FACES);
        let faces: Vec<usize> = (0..surfaces.len()).step_by(step).collect();
        let traced = |of: &usize| mean_irradiance(&surfaces, *of, paths, *of as u64);
        let references: Vec<[Estimate; 3]> = faces.iter().map(traced).collect();
        for (run, options) in runs() {
            let start = ProcessTime::now();
            let solution = solve(&scene(&surfaces)?, &options, |_| ControlFlow::Continue(()))?;
            let (seconds, row) =
                (start.elapsed().as_secs_f64(), row(&faces, surfaces.len(), &solution, &references));
            writeln!(out, "| {name} | {} | {run} | {row} | {seconds:.1} |", surfaces.len())?;
        }
    }
    Ok(())
}

/// All qualities on a mesh, and all errors by levels.
fn runs() -> impl Iterator<Item = (String, Options)> {
    let mesh = QUALITIES.map(|(name, quality)| {
        (format!("mesh, {name}"), Options { method: Method::Mesh, ..quality.options() })
    });
    let levels = ERRORS.map(|error| {
        let quality = if error < 0.03 { Quality::Normal } else { Quality::Draft };
        let options = Options { method: Method::Hierarchical, error, ..quality.options() };
        (format!("levels, {} %", 100.0 * error), options)
    });
    mesh.into_iter().chain(levels)
}

fn surfaces(name: &str) -> Result<Vec<Surface>, Box<dyn Error>> {
    if let Some(kind) = KINDS.iter().position(|kind| *kind == name) {
        return Ok(room(kind, 0));
    }
    if let Some(side) = name.strip_prefix("town-") {
        return Ok(town(side.parse()?, 0));
    }
    let scene = scenes::scene(name).ok_or_else(|| format!("{name}: no scene"))?;
    Ok(traced::surfaces(&scene))
}

/// The worst and the root mean square of the errors of some faces in all bands, and how many of their estimates are too low.
fn row(faces: &[usize], patches: usize, solution: &Solution, references: &[[Estimate; 3]]) -> String {
    let errors = errors(solution, patches, faces, references);
    let worst = errors.iter().map(|(error, ..)| *error).fold(0.0, f64::max);
    let low = match solution.estimate {
        Some(_) => format!("{} of {}", errors.iter().filter(|(.., is_low)| *is_low).count(), errors.len()),
        None => "–".to_owned(),
    };
    format!("{:.2} % | {:.2} % | {low}", 100.0 * worst, 100.0 * root_mean_square(&errors))
}
