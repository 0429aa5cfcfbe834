//! What a matrix of form factors costs in rooms whose obstructions stand on what they hide:
//! `cargo run --release -p tests --example standing_rooms [-- SEEDS [ABSOLUTE ROW]]`; two seeds of each kind, 1e-3 and 8e-3 by default.
//!
//! With `RAYON_NUM_THREADS=1` it is the CPU's time; a unit is what one exact point factor of a plain square takes in the same run.
use formfactor::{DVec3, DifferentialArea, Enclosure, Limits, PlanarPolygon, Tolerance};
use std::error::Error;
use std::hint::black_box;
use std::io::{self, Write};
use std::time::Instant;
use tests::light::{KINDS, room};

fn main() -> Result<(), Box<dyn Error>> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let seeds = asked.first().map_or(Ok(2), |text| text.parse::<u64>())?;
    let number = |place: usize, usual: f64| asked.get(place).map_or(Ok(usual), |text| text.parse::<f64>());
    let tolerance = Tolerance { absolute: number(1, 1e-3)?, relative: 0.0, row: number(2, 8e-3)? };
    let unit = unit()?;
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "| room | surfaces | evaluations a pair | units a pair | largest share of a pair | beyond `absolute` |"
    )?;
    writeln!(out, "| --- | --- | --- | --- | --- | --- |")?;
    for (kind, name) in KINDS.iter().enumerate() {
        for seed in 0..seeds {
            let polygons: Result<Vec<_>, _> =
                room(kind, seed).iter().map(|surface| PlanarPolygon::new(&surface.loops)).collect();
            let scene = Enclosure::new(polygons?);
            let count = scene.polygons().len();
            let pairs = (count * (count - 1)) as f64 / 2.0;
            let start = Instant::now();
            let rows = scene.area_matrix(tolerance, &Limits::default())?.ok_or("stopped")?;
            let seconds = start.elapsed().as_secs_f64();
            let each = || rows.iter().flatten().map(|(_, factor)| factor);
            let all: u64 = each().map(|factor| factor.evaluations).sum::<u64>() / 2;
            let most = each().map(|factor| factor.evaluations).max().unwrap_or(0);
            let beyond = each().filter(|factor| factor.error_estimate > tolerance.absolute).count() / 2;
            writeln!(
                out,
                "| {name} {seed} | {count} | {:.0} | {:.0} | {:.2} | {beyond} |",
                all as f64 / pairs,
                seconds / pairs / unit,
                most as f64 / all.max(1) as f64,
            )?;
        }
    }
    Ok(())
}

/// The seconds that one point factor of a square takes.
fn unit() -> Result<f64, Box<dyn Error>> {
    let square =
        PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])?;
    let scene = Enclosure::new(vec![square]);
    let from = DifferentialArea::new(DVec3::new(0.1, 0.2, 0.0), DVec3::Z)?;
    let start = Instant::now();
    let sum: f64 = (0..1_000_000).map(|_| scene.form_factor(black_box(&from), 0).value).sum();
    black_box(sum);
    Ok(start.elapsed().as_secs_f64() / 1e6)
}
