//! How far solutions are from the truth: mean irradiance of every face of rooms of seven kinds, beside path tracing.
//!
//! ```sh
//! cargo run --release -p tests --example light_errors -- [draft|normal|high] [SEEDS] [PATHS] [METHOD]...
//! ```
//!
//! A method is `mesh` or `hierarchical`; the latter's estimates are set beside the true errors, or beside the standard error where that is more:
//! the median and the lowest ratio, and how many estimates are below what is certain of the error.
//!
//! Errors are in shares of a face's own mean or, where that is more, 1 % of the scene's mean; three standard errors of the path tracer
//! are taken off. Paths are those of a face.
use radiosity::formfactor::PlanarPolygon;
use radiosity::{Method, Options, Patch, Quality, Scene, Solution, solve};
use std::error::Error;
use std::io::{self, Write};
use std::ops::ControlFlow;
use tests::cpu_time::cpu_seconds;
use tests::light::{Estimate, KINDS, Surface, mean_irradiance, room};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let quality = match arguments.first().map(String::as_str) {
        Some("draft") => Quality::Draft,
        Some("high") => Quality::High,
        None | Some("normal") => Quality::Normal,
        Some(other) => return Err(format!("{other}: no quality").into()),
    };
    let number = |index: usize, default: u32| arguments.get(index).map_or(Ok(default), |text| text.parse());
    let (seeds, paths) = (number(1, 1)?, number(2, 100_000)?);
    let methods = match arguments.get(3..) {
        None | Some([]) => vec![Method::Hierarchical],
        Some(names) => names.iter().map(|name| method(name)).collect::<Result<_, _>>()?,
    };
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "| room | method | faces | worst | its face | root mean square | beyond 1 % | estimates | lowest | too low | CPU s |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
    )?;
    for (kind, name) in KINDS.iter().enumerate() {
        for seed in 0..u64::from(seeds) {
            let surfaces = room(kind, seed);
            let traced = |of: usize| mean_irradiance(&surfaces, of, paths, of as u64);
            let references: Vec<[Estimate; 3]> = (0..surfaces.len()).map(traced).collect();
            for &method in &methods {
                let options = Options { method, ..quality.options() };
                let start = cpu_seconds();
                let solution = solve(&scene(&surfaces)?, &options, |_| ControlFlow::Continue(()))?;
                let seconds = cpu_seconds() - start;
                let row = row(&surfaces, &solution, &references);
                writeln!(out, "| {name} {seed} | {method:?} | {row} | {seconds:.1} |")?;
            }
        }
    }
    Ok(())
}

fn method(name: &str) -> Result<Method, String> {
    match name {
        "mesh" => Ok(Method::Mesh),
        "hierarchical" => Ok(Method::Hierarchical),
        other => Err(format!("{other}: no method")),
    }
}

/// The figures of a solution.
fn row(surfaces: &[Surface], solution: &Solution, references: &[[Estimate; 3]]) -> String {
    let errors = errors(surfaces, solution, references);
    let (worst, face) = errors.iter().copied().fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a });
    let square: f64 = errors.iter().map(|(error, _)| error * error).sum();
    format!(
        "{} | {:.2} % | {} | {:.2} % | {} | {}",
        surfaces.len(),
        100.0 * worst,
        surfaces[face].name,
        100.0 * (square / errors.len() as f64).sqrt(),
        errors.iter().filter(|(error, _)| *error > 0.01).count(),
        estimates(solution, references),
    )
}

/// The median and the lowest of estimates over true errors, and how many of the estimates are too low.
fn estimates(solution: &Solution, references: &[[Estimate; 3]]) -> String {
    let Some(estimate) = &solution.estimate else { return " | | ".to_owned() };
    let means = solution.patch_means(&solution.irradiance, references.len()).concat();
    let traced = references.concat();
    let off = |at: usize| (means[at] - traced[at].mean).abs();
    let below = (0..means.len()).filter(|&at| estimate[at] < off(at) - 3.0 * traced[at].error).count();
    let mut ratios: Vec<f64> =
        (0..means.len()).map(|at| estimate[at] / off(at).max(traced[at].error)).collect();
    ratios.sort_by(f64::total_cmp);
    format!("{:.1} × | {:.1} × | {below} of {}", ratios[ratios.len() / 2], ratios[0], ratios.len())
}

fn scene(surfaces: &[Surface]) -> Result<Scene, radiosity::formfactor::Error> {
    let patch = |surface: &Surface| {
        let polygon = PlanarPolygon::new(&surface.loops)?;
        Ok(Patch::new(&surface.name, polygon, surface.reflectance.to_vec(), surface.radiance.to_vec()))
    };
    let patches = surfaces.iter().map(patch).collect::<Result<_, _>>()?;
    Ok(Scene { patches, bands: 3, ..Scene::default() })
}

/// The error of each face in each band, with the face.
fn errors(surfaces: &[Surface], solution: &Solution, references: &[[Estimate; 3]]) -> Vec<(f64, usize)> {
    let means = solution.patch_means(&solution.irradiance, surfaces.len());
    let whole =
        |band: usize| references.iter().map(|face| face[band].mean).sum::<f64>() / references.len() as f64;
    let error = |face: usize, band: usize| {
        let Estimate { mean, error } = references[face][band];
        let off = ((means[face][band] - mean).abs() - 3.0 * error).max(0.0);
        (off / mean.max(0.01 * whole(band)), face)
    };
    (0..surfaces.len()).flat_map(|face| [0, 1, 2].map(|band| error(face, band))).collect()
}
