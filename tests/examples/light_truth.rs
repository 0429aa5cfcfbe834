//! What the faces of a built-in scene receive by path tracing, as a table of Rust: mean irradiance and one standard error per band.
//!
//! ```sh
//! cargo run --release -p tests --example light_truth -- separating-wall 4000000
//! ```
mod traced;

use radiosity::scenes;
use std::error::Error;
use std::io::{self, Write};
use tests::light::{Estimate, mean_irradiance};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, paths] = arguments.as_slice() else { return Err("give a scene and a number of paths".into()) };
    let scene = scenes::scene(name).ok_or_else(|| format!("{name}: no built-in scene"))?;
    let paths = paths.parse()?;
    let surfaces = traced::surfaces(&scene);
    let mut out = io::stdout().lock();
    for (index, surface) in surfaces.iter().enumerate().filter(|(_, surface)| surface.radiance == [0.0; 3]) {
        let found = mean_irradiance(&surfaces, index, paths, index as u64);
        let [means, errors] = [|of: Estimate| of.mean, |of: Estimate| of.error].map(|part| found.map(part));
        writeln!(out, "(\"{}\", {means:.6?}, {errors:.6?}),", surface.name)?;
    }
    Ok(())
}
