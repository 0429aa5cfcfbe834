//! How the CPU time of each stage of `radiosity solve` grows with the number of patches, as a table in Markdown.
//!
//! ```sh
//! RAYON_NUM_THREADS=1 cargo run --release -p radiosity --example stages -- [town|sky|room|torus|row]... [PATCHES]...
//! ```
//!
//! Between two sizes stands the exponent: the logarithm of the ratio of times over that of the numbers of patches; – where there was no
//! time to measure. `inspect` repairs, and looks from 8 to 256 patches, of which one is
//! measured.
mod large_scenes;

use cpu_time::ProcessTime;
use large_scenes::{FAMILIES, Family};
use radiosity::formfactor::PlanarPolygon;
use radiosity::io::{Source, collada::Collada, gltf, obj, ply};
use radiosity::{Mesh, Moment, Options, Patch, Quality, Record, Scene, Solution};
use radiosity::{element_table, inspect::inspect_until, needed_sides, patch_table, repair, solve, viewer};
use std::error::Error;
use std::hint::black_box;
use std::io::Write;
use std::ops::ControlFlow;
use std::time::Instant;

/// Quick stages are repeated until they have taken so many seconds.
const LEAST: f64 = 0.02;
/// Views, and lights and shots, are granted so many seconds.
const GRANTED: f64 = 8.0;
/// So many shots are measured.
const SHOTS: usize = 3;

type Failure = Box<dyn Error>;
/// The CPU seconds of each stage.
type Times = Vec<(&'static str, f64)>;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let named = |(name, _): &&Family| arguments.iter().any(|argument| argument == name);
    let mut families: Vec<&Family> = FAMILIES.iter().filter(named).collect();
    let mut sizes: Vec<usize> = arguments.iter().filter_map(|argument| argument.parse().ok()).collect();
    if families.len() + sizes.len() < arguments.len() {
        return Err("give names of families and numbers of patches".into());
    }
    if families.is_empty() {
        families = FAMILIES.iter().collect();
    }
    if sizes.is_empty() {
        sizes = vec![1_000, 3_000, 10_000, 30_000, 100_000];
    }
    families.into_iter().try_for_each(|family| tabulate(*family, &sizes))
}

/// Measures a family and prints its table.
fn tabulate((name, scene_of): Family, sizes: &[usize]) -> Result<(), Failure> {
    let (mut counts, mut columns) = (Vec::new(), Vec::new());
    for &size in sizes {
        let scene = scene_of(size);
        eprintln!("{name} of {} patches", scene.patches.len());
        counts.push(scene.patches.len());
        columns.push(measure(&scene)?);
    }
    let mut out = std::io::stdout().lock();
    let heads: String = counts.windows(2).map(|pair| format!(" | | {}", pair[1])).collect();
    writeln!(out, "| {name} | {}{heads} |", counts[0])?;
    writeln!(out, "| --- |{}", " --- |".repeat(2 * counts.len() - 1))?;
    for (stage, (label, _)) in columns[0].iter().enumerate() {
        let times: Vec<f64> = columns.iter().map(|column| column[stage].1).collect();
        writeln!(out, "| {label} | {} |", row(&counts, &times))?;
    }
    Ok(writeln!(out)?)
}

/// Times with the exponents between them.
fn row(counts: &[usize], times: &[f64]) -> String {
    let mut row = shown(times[0]);
    for (count, time) in counts.windows(2).zip(times.windows(2)) {
        let exponent = (time[1] / time[0]).ln() / (count[1] as f64 / count[0] as f64).ln();
        row += &if exponent.is_finite() { format!(" | **{exponent:.2}**") } else { " | ".into() };
        row += &format!(" | {}", shown(time[1]));
    }
    row
}

/// Seconds to three digits.
fn shown(seconds: f64) -> String {
    match seconds {
        0.0 => "–".into(),
        ..0.1 => format!("{:.3} ms", 1e3 * seconds),
        ..1.0 => format!("{:.0} ms", 1e3 * seconds),
        _ => format!("{seconds:.2} s"),
    }
}

/// All stages of a scene.
fn measure(scene: &Scene) -> Result<Times, Failure> {
    let mut times = Times::new();
    files(scene, &mut times)?;
    let sides = double_sided(scene);
    note(&mut times, "needed sides", || needed_sides(&sides));
    view(scene, &mut times);
    note(&mut times, "repair", || repair(scene));
    let options = Quality::Draft.options();
    note(&mut times, "mesh", || Mesh::even(scene, options.elements))?;
    let solution = solution(scene, &options, &mut times)?;
    outputs(scene, &solution, &mut times)?;
    Ok(times)
}

/// Writing and reading the scene.
fn files(scene: &Scene, times: &mut Times) -> Result<(), Failure> {
    let text = note(times, "write COLLADA", || Collada::of(scene).text().to_owned());
    note(times, "read COLLADA", || {
        Source::from_bytes("scene.dae", text.as_bytes()).and_then(|file| file.scene())
    })?;
    let bytes = note(times, "write GLB", || gltf::scene_glb(scene))?;
    note(times, "read GLB", || Source::from_bytes("scene.glb", &bytes[..]).and_then(|file| file.scene()))?;
    Ok(())
}

/// The scene as a file of double-sided materials has it.
fn double_sided(scene: &Scene) -> Scene {
    let back = |patch: &Patch| {
        let turned = patch.polygon.loops().map(|points| points.iter().rev().copied().collect::<Vec<_>>());
        let polygon = PlanarPolygon::new(turned).expect("a planar polygon");
        Patch { name: format!("{}.back", patch.name), polygon, is_back: true, ..patch.clone() }
    };
    let patches = scene.patches.iter().flat_map(|patch| [patch.clone(), back(patch)]).collect();
    Scene { patches, ..scene.clone() }
}

/// A row of form factors, as `inspect` finds some.
fn view(scene: &Scene, times: &mut Times) {
    let granted = Instant::now();
    let inspection = inspect_until(scene, &|| granted.elapsed().as_secs_f64() > GRANTED);
    let seconds = inspection.cost.seconds / inspection.cost.elements as f64;
    times.push(("a view of inspect", if inspection.stopped { 0.0 } else { seconds }));
}

/// Solves until some shots are made, or the time is up.
fn solution(scene: &Scene, options: &Options, times: &mut Times) -> Result<Solution, Failure> {
    let start = ProcessTime::now();
    let granted = Instant::now();
    let mut seen = Vec::new();
    let solution = solve(scene, options, |progress| {
        let shots = match progress.moment {
            Moment::Shot(shots, _) => Some(shots),
            _ => None,
        };
        seen.push((shots, start.elapsed().as_secs_f64()));
        let is_late = granted.elapsed().as_secs_f64() > GRANTED + seen[0].1;
        if shots >= Some(SHOTS) || is_late { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    let first = seen[0].1;
    let shooting = || seen.iter().filter(|(shots, _)| shots.is_some());
    let (begin, end) = (shooting().next(), shooting().next_back());
    times.push(("before the first step", first));
    times.push(("light of lamps and sky", begin.map_or(0.0, |at| at.1 - first)));
    let shots = end.and_then(|at| at.0).unwrap_or(0);
    let shot = begin.zip(end).map_or(0.0, |(begin, end)| (end.1 - begin.1) / shots.max(1) as f64);
    times.push(("each shot", shot));
    Ok(solution)
}

/// Writing the results.
fn outputs(scene: &Scene, solution: &Solution, times: &mut Times) -> Result<(), Failure> {
    let record = note(times, "record", || Record::new("scene", scene, solution));
    let camera = &scene.cameras[0];
    let exposure = note(times, "exposure", || record.exposure_for(camera));
    note(times, "picture", || record.draw(camera, exposure, 800));
    note(times, "page", || viewer::page(&record, exposure));
    note(times, "tables", || (patch_table(&record), element_table(&record)));
    note(times, "lit GLB", || gltf::glb(&record, exposure))?;
    note(times, "lit OBJ", || obj::lit(&record, exposure));
    note(times, "lit PLY", || ply::lit(&record, exposure));
    let file = Collada::of(scene);
    note(times, "lit COLLADA", || file.with_light(scene, &record.mesh(), &record.colours()))?;
    Ok(())
}

/// Repeats a stage until its time can be measured.
fn note<T>(times: &mut Times, stage: &'static str, run: impl Fn() -> T) -> T {
    let start = ProcessTime::now();
    let mut repeats = 1;
    let mut result = black_box(run());
    while start.elapsed().as_secs_f64() < LEAST {
        result = black_box(run());
        repeats += 1;
    }
    let seconds = (start.elapsed().as_secs_f64()) / f64::from(repeats);
    eprintln!("{stage}: {}", shown(seconds));
    times.push((stage, seconds));
    result
}
