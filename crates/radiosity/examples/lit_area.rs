//! How much of what is lit in scene files is shown within 5 % of an exact gather over the solution itself.
//!
//! ```sh
//! cargo run --release -p radiosity --example lit_area -- [draft|normal|high] SECONDS COUNT FILE...
//! ```
//!
//! Solving takes so many seconds at most. So many points are looked at, spread evenly over the area; what is darker than 1 % of the mean is not lit. A scene without light gets a
//! uniform sky, as from `radiosity solve`.
#[path = "../tests/gather/mod.rs"]
mod gather;

use gather::area::{lit_samples, within};
use radiosity::io::Source;
use radiosity::{Options, Quality, Scene, Sky, SkyKind, needed_sides, repair, solve};
use std::error::Error;
use std::io::Write;
use std::ops::ControlFlow;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [quality, seconds, count, files @ ..] = arguments.as_slice() else {
        return Err("give a quality, a time, how many points, and files".into());
    };
    let quality = match quality.as_str() {
        "draft" => Quality::Draft,
        "normal" => Quality::Normal,
        "high" => Quality::High,
        other => return Err(format!("{other}: no quality").into()),
    };
    let options = Options { max_seconds: Some(seconds.parse()?), ..quality.options() };
    let count = count.parse()?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "| file | patches | elements | s | lit points | within 5 % | within 20 % |")?;
    writeln!(out, "| --- | --- | --- | --- | --- | --- | --- |")?;
    for file in files {
        let scene = lit(file)?;
        let solution = solve(&scene, &options, |_| ControlFlow::Continue(()))?;
        let found = lit_samples(&scene, &solution, count)?;
        let [fine, coarse] = [0.05, 0.2].map(|share| 100.0 * within(&found, share));
        let (patches, elements) = (scene.patches.len(), solution.mesh.elements.len());
        let (seconds, points) = (solution.seconds, found.len());
        writeln!(
            out,
            "| {file} | {patches} | {elements} | {seconds:.1} | {points} | {fine:.0} % | {coarse:.0} % |"
        )?;
    }
    Ok(())
}

fn lit(file: &str) -> Result<Scene, Box<dyn Error>> {
    let mut scene = Source::open(file)?.scene()?;
    if !scene.has_light() {
        scene.sky = Some(Sky { radiance: vec![1.0; scene.bands], kind: SkyKind::Uniform });
    }
    Ok(repair(&needed_sides(&scene)).scene)
}
