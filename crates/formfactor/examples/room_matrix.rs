//! The view-factor matrix of a room, each surface to every other: `cargo run --release -p formfactor --example room_matrix`.
//!
//! A room of 4 x 3 x 2.5 with a table in it. The room is closed: rows add to 1 within the tolerance. Reciprocity holds to
//! rounding, as each pair is integrated once.
use formfactor::{Enclosure, Error, Limits, PlanarPolygon, Row};
use std::fmt::Write as _;
use std::io::{self, Write};

type Corners = [[f64; 3]; 4];

const SURFACES: [(&str, Corners); 8] = [
    ("floor", [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 3.0, 0.0], [0.0, 3.0, 0.0]]),
    ("ceiling", [[0.0, 0.0, 2.5], [0.0, 3.0, 2.5], [4.0, 3.0, 2.5], [4.0, 0.0, 2.5]]),
    ("front", [[0.0, 0.0, 0.0], [0.0, 0.0, 2.5], [4.0, 0.0, 2.5], [4.0, 0.0, 0.0]]),
    ("back", [[0.0, 3.0, 0.0], [4.0, 3.0, 0.0], [4.0, 3.0, 2.5], [0.0, 3.0, 2.5]]),
    ("left", [[0.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 3.0, 2.5], [0.0, 0.0, 2.5]]),
    ("right", [[4.0, 0.0, 0.0], [4.0, 0.0, 2.5], [4.0, 3.0, 2.5], [4.0, 3.0, 0.0]]),
    ("table", [[1.0, 1.0, 0.75], [2.5, 1.0, 0.75], [2.5, 2.0, 0.75], [1.0, 2.0, 0.75]]),
    ("under it", [[1.0, 1.0, 0.75], [1.0, 2.0, 0.75], [2.5, 2.0, 0.75], [2.5, 1.0, 0.75]]),
];

/// What a row's sum may be off by.
const TOLERANCE: f64 = 1e-6;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let polygons: Result<Vec<_>, Error> =
        SURFACES.iter().map(|(_, corners)| PlanarPolygon::new([corners])).collect();
    let room = Enclosure::new(polygons?);
    let rows = room.area_matrix(TOLERANCE, &Limits::default())?.unwrap_or_default();
    let mut table = format!("{:>9}", "from / to");
    for (name, _) in &SURFACES {
        write!(table, "{name:>10}")?;
    }
    writeln!(table, "{:>14}{:>10}{:>8}", "sum - 1", "estimate", "points")?;
    for ((name, _), row) in SURFACES.iter().zip(&rows) {
        write_row(&mut table, name, row)?;
    }
    io::stdout().lock().write_all(table.as_bytes())?;
    Ok(())
}

fn write_row(table: &mut String, name: &str, row: &Row) -> std::fmt::Result {
    write!(table, "{name:>9}")?;
    for id in 0..SURFACES.len() {
        let factor = row.iter().find(|(to, _)| *to == id).map_or(0.0, |(_, factor)| factor.value);
        write!(table, "{factor:>10.6}")?;
    }
    let sum: f64 = row.iter().map(|(_, factor)| factor.value).sum();
    let estimate: f64 = row.iter().map(|(_, factor)| factor.error_estimate).sum();
    let points: u64 = row.iter().map(|(_, factor)| factor.evaluations).sum();
    writeln!(table, "{:>14.1e}{estimate:>10.1e}{points:>8}", sum - 1.0)
}
