//! Maps: the npm packages world-atlas and us-atlas (Natural Earth and US Census Bureau, public domain data).

use super::{shifted, topojson};
use crate::job::{Job, Op, Parts, Polygon, Ring, signed_area};
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
    let rings = topojson::polygons(&text, object).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(rings.into_iter().map(planar).collect())
}

/// A polygon of the sphere as one of the plane: outer ring counter-clockwise, holes clockwise.
///
/// The ring of most area is the outer one, whatever the file says: a map may draw Antarctica as a hole in the pole.
fn planar(polygon: Polygon) -> Polygon {
    let is_flat = |ring: &Ring| ring.iter().all(|p| p[1] == ring[0][1]);
    let mut rings: Polygon =
        polygon.iter().map(|ring| unrolled(ring)).filter(|ring| !is_flat(ring)).collect();
    rings.sort_by(|a, b| signed_area(b).abs().total_cmp(&signed_area(a).abs()));
    for (i, ring) in rings.iter_mut().enumerate() {
        if (signed_area(ring) > 0.0) != (i == 0) {
            ring.reverse();
        }
    }
    rings
}

/// The maps join at longitude 180 what the plane has to keep apart: there a ring goes on beyond 180 instead of jumping to
/// -180. One that runs around the Earth (Antarctica) is closed over the nearer pole.
fn unrolled(ring: &[[f64; 2]]) -> Ring {
    let mut turns = 0.0;
    let mut last = ring[0];
    let mut flat: Ring = ring
        .iter()
        .map(|&point| {
            turns -= jump(last, point);
            last = point;
            [point[0] + 360.0 * turns, point[1]]
        })
        .collect();
    turns -= jump(last, ring[0]);
    if turns != 0.0 {
        let pole = 90.0_f64.copysign(flat[0][1]);
        let start = flat[0];
        flat.extend([
            [start[0] + 360.0 * turns, start[1]],
            [start[0] + 360.0 * turns, pole],
            [start[0], pole],
        ]);
    }
    let (west, east) = flat.iter().fold((f64::MAX, f64::MIN), |(w, e), p| (p[0].min(w), p[0].max(e)));
    let sheet = 360.0 * ((west + east) / 720.0).round();
    flat.iter().map(|p| [p[0] - sheet, p[1]]).collect()
}

/// By how many turns longitude jumps between neighbours: 1 from -180 to 180, -1 from 180 to -180, else 0. Along a pole it
/// does not jump: some maps close Antarctica there by themselves.
fn jump(from: [f64; 2], to: [f64; 2]) -> f64 {
    let at_pole = |p: [f64; 2]| p[1].abs() > 89.9;
    if at_pole(from) && at_pole(to) { 0.0 } else { ((to[0] - from[0]) / 360.0).round() }
}

/// The land of the Earth, 1 : `scale` million, and a copy shifted by a few tenths of a degree.
pub(super) fn land(scale: usize) -> Result<Job, String> {
    let subject = read(&format!("world-atlas/land-{scale}m.json"), "land")?;
    let clip = shifted(&subject, [0.31, 0.17]);
    Ok(Job::one(Op::Intersection, subject, clip, Parts::Apart))
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
    Ok(Job::union_of_all(subject, Parts::Apart))
}
