//! `radiosity factors`
use super::{Factors, Failure, input, json, output};
use formfactor::{DifferentialArea, Enclosure};
use glam::DVec3;
use radiosity::{Error, Scene};
use std::{fmt::Write, process::ExitCode};

/// Prints the form factors from a point to every patch.
pub(super) fn run(arguments: &Factors) -> Result<ExitCode, Failure> {
    let (scene, _) = input::read(&arguments.scene)?;
    let [x, y, z, nx, ny, nz] = arguments.from;
    let mut from =
        DifferentialArea::new(DVec3::new(x, y, z), DVec3::new(nx, ny, nz)).map_err(Failure::usage)?;
    if let Some(name) = &arguments.on {
        from = from.owned_by(find(&scene, name).map_err(Failure::usage)?);
    }
    let enclosure = Enclosure::new(scene.patches.iter().map(|patch| patch.polygon.clone()).collect());
    let rows = json::Rows::new(&scene, &enclosure.row(&from));
    output::print(&if arguments.json { json::line(&rows) } else { table(&rows) })?;
    Ok(ExitCode::SUCCESS)
}

/// The index of the patch of that name.
fn find(scene: &Scene, name: &str) -> Result<usize, Error> {
    scene.patches.iter().position(|patch| patch.name == name).ok_or_else(|| {
        let known: Vec<_> = scene.patches.iter().take(20).map(|patch| patch.name.as_str()).collect();
        let more = if scene.patches.len() > known.len() { ", …" } else { "" };
        Error::NoSuchPatch { name: name.to_owned(), known: known.join(", ") + more }
    })
}

/// Columns for people.
fn table(rows: &json::Rows<'_>) -> String {
    let mut table = String::new();
    for row in &rows.rows {
        let _ = writeln!(table, "{:<24} {:<24} ± {:.1e}", row.name, row.form_factor, row.error_bound);
    }
    table + &format!("{:<24} {}\n", "sum", rows.sum)
}
