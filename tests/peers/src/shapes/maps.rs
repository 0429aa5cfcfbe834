//! Maps: the npm packages world-atlas and us-atlas (Natural Earth and US Census Bureau, public domain data).

use super::{shifted, topojson};
use crate::job::{Job, Op, Polygon};
use std::path::PathBuf;
use std::process::Command;

const PACKAGES: [&str; 2] = ["world-atlas@2.0.2", "us-atlas@3.0.1"];

/// Where the maps are kept, and tables written unless told otherwise; not part of the repository.
pub fn folder() -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "target-data"].iter().collect()
}

fn file(name: &str) -> PathBuf {
    folder().join("node_modules").join(name)
}

/// Whether the maps are there.
pub fn is_fetched() -> bool {
    ["world-atlas/land-10m.json", "us-atlas/counties-10m.json"].iter().all(|name| file(name).exists())
}

/// Fetches the maps with npm, once; the error says what to do.
pub fn fetch() -> Result<(), String> {
    if is_fetched() {
        return Ok(());
    }
    let folder = folder();
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut npm = Command::new("npm");
    npm.args(["install", "--ignore-scripts", "--no-audit", "--no-fund", "--silent", "--prefix"]);
    let status = npm.arg(&folder).args(PACKAGES).stdout(std::process::Stdio::null()).status();
    match status {
        Ok(status) if status.success() && is_fetched() => Ok(()),
        Ok(status) => Err(format!("npm could not install {} ({status})", PACKAGES.join(" and "))),
        Err(error) => Err(format!("npm does not run ({error}); install Node.js for the map rows")),
    }
}

fn read(name: &str, object: &str) -> Result<Vec<Polygon>, String> {
    let path = file(name);
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    topojson::polygons(&text, object).map_err(|error| format!("{}: {error}", path.display()))
}

/// The land of the Earth, 1 : `scale` million, and a copy shifted by a few tenths of a degree.
pub(super) fn land(scale: usize) -> Result<Job, String> {
    let subject = read(&format!("world-atlas/land-{scale}m.json"), "land")?;
    let clip = shifted(&subject, [0.31, 0.17]);
    Ok(Job { op: Op::Intersection, subject, clip, disjoint: true })
}

/// All countries, 1 : `scale` million: neighbours share their borders point for point.
pub(super) fn countries(scale: usize) -> Result<Job, String> {
    union(read(&format!("world-atlas/countries-{scale}m.json"), "countries")?)
}

/// All counties of the United States, 1 : `scale` million.
pub(super) fn counties(scale: usize) -> Result<Job, String> {
    union(read(&format!("us-atlas/counties-{scale}m.json"), "counties")?)
}

fn union(subject: Vec<Polygon>) -> Result<Job, String> {
    Ok(Job { op: Op::UnionOfAll, subject, clip: vec![], disjoint: true })
}
