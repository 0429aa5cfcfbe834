//! The view factors of a room, from the middle of each surface to every other: `cargo run --release -p formfactor --example room_matrix`.
//!
//! A room of 4 x 3 x 2.5 with a table in it. Rows are what a point sees: each adds to 1 within the sum of the bounds, as the room
//! is closed. They are factors from points, so that reciprocity between surfaces need not hold.
use formfactor::{DVec3, DifferentialArea, Enclosure, Error, FormFactor, PlanarPolygon};
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

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let polygons: Result<Vec<_>, Error> =
        SURFACES.iter().map(|(_, corners)| PlanarPolygon::new([corners])).collect();
    let room = Enclosure::new(polygons?);
    let mut table = format!("{:>9}", "from / to");
    for (name, _) in &SURFACES {
        write!(table, "{name:>10}")?;
    }
    writeln!(table, "{:>14}{:>10}", "sum - 1", "bound")?;
    for (id, (name, corners)) in SURFACES.iter().enumerate() {
        let normal = room.polygons()[id].normal();
        let from = DifferentialArea::new(middle(corners), normal)?.owned_by(id);
        write_row(&mut table, name, &room.row(&from))?;
    }
    io::stdout().lock().write_all(table.as_bytes())?;
    Ok(())
}

fn middle(corners: &Corners) -> DVec3 {
    corners.iter().map(|corner| DVec3::from(*corner)).sum::<DVec3>() / 4.0
}

fn write_row(table: &mut String, name: &str, row: &[FormFactor]) -> std::fmt::Result {
    write!(table, "{name:>9}")?;
    for factor in row {
        write!(table, "{:>10.6}", factor.value)?;
    }
    let sum: f64 = row.iter().map(|factor| factor.value).sum();
    let bound: f64 = row.iter().map(|factor| factor.error_bound).sum();
    writeln!(table, "{:>14.1e}{bound:>10.1e}", sum - 1.0)
}
