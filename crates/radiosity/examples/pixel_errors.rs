//! How far the pixels of the built-in scenes' pictures are from an exact gather at their points.
//!
//! ```sh
//! cargo run --release -p radiosity --example pixel_errors -- [draft|normal|high] [WIDTH] [SCENE]...
//! ```
//!
//! Errors are shares of the brightest reflected light of the picture.
#[path = "../tests/gather/mod.rs"]
mod gather;

use cpu_time::ProcessTime;
use gather::pixels::pixel_errors;
use radiosity::{Quality, scenes, solve};
use std::error::Error;
use std::io::Write;
use std::ops::ControlFlow;

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
        let start = ProcessTime::now();
        let solution = solve(&scene, &quality.options(), |_| ControlFlow::Continue(()))?;
        let seconds = start.elapsed().as_secs_f64();
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
