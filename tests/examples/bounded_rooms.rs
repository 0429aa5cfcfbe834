//! How wide proven form factors are between all pairs of a room in View3D's format, beside estimates:
//! `cargo run --release -p tests --example bounded_rooms -- FILE [TOLERANCE [STRIDE]]`, 1e-4 by default and each pair.
//!
//! Each pair gets a hundred times the evaluations that its estimate takes. An interval is wrong where the estimate at a tolerance
//! of 1e-8 is beyond it.
use formfactor::{DVec3, Enclosure, Limits, PlanarPolygon};
use std::error::Error;
use std::io::{self, Write};
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("which file?")?;
    let tolerance: f64 = arguments.next().map_or(Ok(1e-4), |text| text.parse())?;
    let stride: usize = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let enclosure = Enclosure::new(surfaces(&std::fs::read_to_string(file)?)?);
    let count = enclosure.polygons().len();
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j))).step_by(stride);
    let (mut seen, mut wide, mut wrong) = (0, 0, 0);
    let (mut evaluations, mut times) = ([0; 2], [Duration::ZERO; 2]);
    for (i, j) in pairs {
        let start = Instant::now();
        let estimate = enclosure.area_form_factor(i, j, tolerance, &Limits::default())?.unwrap_or_default();
        let between = Instant::now();
        let limits = Limits { per_pair: 100 * estimate.evaluations.max(10), ..Limits::default() };
        let found = enclosure.bounded_area_form_factor(i, j, tolerance / 2.0, &limits)?.unwrap_or_default();
        times = [times[0] + between.elapsed(), times[1] + (between - start)];
        evaluations = [evaluations[0] + found.evaluations, evaluations[1] + estimate.evaluations];
        seen += usize::from(found.value > 0.0 || estimate.value > 0.0);
        wide += usize::from(2.0 * found.error_bound > tolerance);
        let exact = enclosure.area_form_factor(i, j, 1e-8, &Limits::default())?.unwrap_or_default();
        let beyond = (found.value - exact.value).abs() - exact.error_estimate - found.error_bound;
        if beyond > 0.0 {
            wrong += 1;
            writeln!(io::stdout(), "wrong: {i} to {j} by {beyond:e}: {found:?} {exact:?}")?;
        }
    }
    writeln!(
        io::stdout(),
        "{seen} pairs that see each other, {wide} wider than {tolerance:e}, {wrong} wrong; {} evaluations in {:.2?}, \
         estimates {} in {:.2?}",
        evaluations[0],
        times[0],
        evaluations[1],
        times[1]
    )?;
    Ok(())
}

/// The surfaces of lines `V number x y z` and `S number v v v v ...`.
fn surfaces(text: &str) -> Result<Vec<PlanarPolygon>, Box<dyn Error>> {
    let (mut vertices, mut surfaces) = (vec![DVec3::ZERO], Vec::new());
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let number = |i: usize| words.get(i).unwrap_or(&"").parse::<f64>();
        match words.first() {
            Some(&"V") => vertices.push(DVec3::new(number(2)?, number(3)?, number(4)?)),
            Some(&"S") => {
                let ids: Result<Vec<usize>, _> = words[2..6].iter().map(|word| word.parse()).collect();
                let corners: Vec<DVec3> =
                    ids?.into_iter().filter(|id| *id > 0).map(|id| vertices[id]).collect();
                surfaces.push(PlanarPolygon::new([corners])?);
            }
            _ => (),
        }
    }
    Ok(surfaces)
}
