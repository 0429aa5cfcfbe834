//! How the CPU time of a solution by levels grows with the number of patches, as a table in Markdown.
//!
//! ```sh
//! RAYON_NUM_THREADS=1 cargo run --release -p radiosity --example levels -- [ERROR] [town|sky|room|torus|row] [PATCHES]...
//! ```
//!
//! Links are those of two tiles in the end. An exponent is the logarithm of the ratio of times, or links, over that of the numbers of patches in
//! two rows.
mod large_scenes;

use cpu_time::ProcessTime;
use large_scenes::FAMILIES;
use radiosity::{Method, Options, Quality, Scene, solve};
use std::error::Error;
use std::io::Write;
use std::ops::ControlFlow;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let error = arguments.next().map_or(Ok(0.3), |text| text.parse())?;
    let name = arguments.next().unwrap_or_else(|| "town".into());
    let (_, scene_of) =
        FAMILIES.iter().find(|family| family.0 == name).ok_or_else(|| format!("{name}: no family"))?;
    let mut sizes = arguments.map(|text| text.parse()).collect::<Result<Vec<usize>, _>>()?;
    if sizes.is_empty() {
        sizes = vec![1_000, 4_000, 16_000];
    }
    let mut out = std::io::stdout().lock();
    writeln!(out, "| {name}: patches | CPU s | exponent | links | exponent | converged |")?;
    writeln!(out, "| --- | --- | --- | --- | --- | --- |")?;
    let mut before = None;
    for size in sizes {
        let now = Row::of(&scene_of(size), error)?;
        now.write(before.as_ref(), &mut out)?;
        before = Some(now);
    }
    Ok(())
}

/// What one scene took.
struct Row {
    patches: f64,
    seconds: f64,
    links: f64,
    converged: bool,
}

impl Row {
    fn of(scene: &Scene, error: f64) -> Result<Row, Box<dyn Error>> {
        let options = Options { method: Method::Hierarchical, error, ..Quality::Draft.options() };
        let start = ProcessTime::now();
        let solution = solve(scene, &options, |_| ControlFlow::Continue(()))?;
        let seconds = start.elapsed().as_secs_f64();
        let links = solution.transfers.map_or(0, |found| found.open + found.occluded) as f64;
        Ok(Row { patches: scene.patches.len() as f64, seconds, links, converged: solution.converged })
    }

    fn write(&self, before: Option<&Row>, out: &mut impl Write) -> std::io::Result<()> {
        let Row { patches, seconds, links, converged } = self;
        let exponent = |of: fn(&Row) -> f64| {
            let ratio = |before: &Row| (of(self) / of(before)).ln() / (patches / before.patches).ln();
            before.map_or("–".to_owned(), |before| format!("{:.2}", ratio(before)))
        };
        let (of_time, of_links) = (exponent(|row| row.seconds), exponent(|row| row.links));
        let converged = if *converged { "yes" } else { "no" };
        writeln!(out, "| {patches} | {seconds:.1} | {of_time} | {links} | {of_links} | {converged} |")
    }
}
