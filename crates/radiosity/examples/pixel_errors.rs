//! How far the pixels of the built-in scenes' pictures are from an exact gather at their points.
//!
//! ```sh
//! cargo run --release -p radiosity --example pixel_errors -- [draft|normal|high] [WIDTH] [SCENE]...
//! ```
//!
//! Errors are shares of the brightest reflected light of the picture.
#[path = "../tests/gather/mod.rs"]
mod gather;

use gather::pixels::pixel_errors;
use radiosity::{Quality, scenes, solve};
use std::error::Error;
use std::io::Write;
use std::ops::ControlFlow;
use std::time::{SystemTime, UNIX_EPOCH};

const SCENES: [&str; 6] =
    ["beams", "small-occluders", "perforated", "chessboard", "cornell-box", "obstruction"];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let quality = match arguments.first().map(String::as_str) {
        Some("draft") => Quality::Draft,
        Some("high") => Quality::High,
        None | Some("normal") => Quality::Normal,
        Some(other) => return Err(format!("{other}: no quality").into()),
    };
    let width = arguments.get(1).map_or(Ok(80), |text| text.parse())?;
    let named: Vec<&str> = arguments.iter().skip(2).map(String::as_str).collect();
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "| scene | elements | pixels | mean | 99th percentile | worst | at | CPU s |\n| --- | --- | --- | --- | --- | --- | --- | --- |"
    )?;
    for name in if named.is_empty() { &SCENES[..] } else { &named } {
        let scene = scenes::scene(name).ok_or_else(|| format!("{name}: no scene"))?;
        let start = cpu_seconds();
        let solution = solve(&scene, &quality.options(), |_| ControlFlow::Continue(()))?;
        let seconds = cpu_seconds() - start;
        let found = pixel_errors(&scene, &solution, &scene.cameras[0], width)?;
        let percent = |share: f64| 100.0 * share;
        writeln!(
            out,
            "| {name} | {} | {} | {:.2} % | {:.2} % | {:.1} % | {:?} | {seconds:.1} |",
            solution.mesh.elements.len(),
            found.pixels,
            percent(found.mean),
            percent(found.percentile),
            percent(found.worst),
            found.place
        )?;
    }
    Ok(())
}

/// What this process has used, by Linux's count of hundredths; the time of day where there is none.
fn cpu_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let ticks = |field: &str| field.parse::<f64>().ok();
    let fields = || stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    match (fields().nth(11).and_then(ticks), fields().nth(12).and_then(ticks)) {
        (Some(user), Some(system)) => (user + system) / 100.0,
        _ => SystemTime::now().duration_since(UNIX_EPOCH).map_or(0.0, |since| since.as_secs_f64()),
    }
}
