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
mod beside_paths;

use beside_paths::{errors, root_mean_square, scene};
use cpu_time::ProcessTime;
use radiosity::{Method, Options, Quality, Solution, solve};
use std::error::Error;
use std::io::{self, Write};
use std::ops::ControlFlow;
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
                let start = ProcessTime::now();
                let solution = solve(&scene(&surfaces)?, &options, |_| ControlFlow::Continue(()))?;
                let seconds = start.elapsed().as_secs_f64();
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
    let faces: Vec<usize> = (0..surfaces.len()).collect();
    let errors = errors(solution, surfaces.len(), &faces, references);
    let worst = errors.iter().copied().fold((0.0, 0, false), |a, b| if b.0 > a.0 { b } else { a });
    let below = errors.iter().filter(|(.., is_low)| *is_low).count();
    format!(
        "{} | {:.2} % | {} | {:.2} % | {} | {}",
        surfaces.len(),
        100.0 * worst.0,
        surfaces[worst.1].name,
        100.0 * root_mean_square(&errors),
        errors.iter().filter(|(error, ..)| *error > 0.01).count(),
        estimates(solution, references, below),
    )
}

/// The median and the lowest of estimates over true errors, and how many of them are too low.
fn estimates(solution: &Solution, references: &[[Estimate; 3]], below: usize) -> String {
    let Some(estimate) = &solution.estimate else { return " | | ".to_owned() };
    let means = solution.patch_means(&solution.irradiance, references.len()).concat();
    let traced = references.concat();
    let off = |at: usize| (means[at] - traced[at].mean).abs();
    let mut ratios: Vec<f64> =
        (0..means.len()).map(|at| estimate[at] / off(at).max(traced[at].error)).collect();
    ratios.sort_by(f64::total_cmp);
    format!("{:.1} × | {:.1} × | {below} of {}", ratios[ratios.len() / 2], ratios[0], ratios.len())
}
