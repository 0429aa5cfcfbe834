//! How far solutions are from the truth: mean irradiance of every face of rooms of seven kinds, beside path tracing.
//!
//! ```sh
//! cargo run --release -p tests --example light_errors -- [draft|normal|high] [SEEDS] [PATHS]
//! ```
//!
//! Errors are in shares of a face's own mean or, where that is more, 1 % of the scene's mean; three standard errors of the path tracer
//! are taken off. Paths are those of a face.
use radiosity::formfactor::PlanarPolygon;
use radiosity::{Patch, Quality, Scene, Solution, solve};
use std::error::Error;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::time::Instant;
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
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "| room | faces | worst | its face | root mean square | beyond 1 % | s |\n| --- | --- | --- | --- | --- | --- | --- |"
    )?;
    for (kind, name) in KINDS.iter().enumerate() {
        for seed in 0..u64::from(seeds) {
            let surfaces = room(kind, seed);
            let start = Instant::now();
            let solution = solve(&scene(&surfaces)?, &quality.options(), |_| ControlFlow::Continue(()))?;
            let seconds = start.elapsed().as_secs_f64();
            let errors = errors(&surfaces, &solution, paths);
            let (worst, face) = errors.iter().copied().fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a });
            let square: f64 = errors.iter().map(|(error, _)| error * error).sum();
            writeln!(
                out,
                "| {name} {seed} | {} | {:.2} % | {} | {:.2} % | {} | {seconds:.1} |",
                surfaces.len(),
                100.0 * worst,
                surfaces[face].name,
                100.0 * (square / errors.len() as f64).sqrt(),
                errors.iter().filter(|(error, _)| *error > 0.01).count(),
            )?;
        }
    }
    Ok(())
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
fn errors(surfaces: &[Surface], solution: &Solution, paths: u32) -> Vec<(f64, usize)> {
    let means = solution.patch_means(&solution.irradiance, surfaces.len());
    let traced = |of: usize| mean_irradiance(surfaces, of, paths, of as u64);
    let references: Vec<[Estimate; 3]> = (0..surfaces.len()).map(traced).collect();
    let whole =
        |band: usize| references.iter().map(|face| face[band].mean).sum::<f64>() / references.len() as f64;
    let error = |face: usize, band: usize| {
        let Estimate { mean, error } = references[face][band];
        let off = ((means[face][band] - mean).abs() - 3.0 * error).max(0.0);
        (off / mean.max(0.01 * whole(band)), face)
    };
    (0..surfaces.len()).flat_map(|face| [0, 1, 2].map(|band| error(face, band))).collect()
}
