//! Form factors from area to area past obstructions, against references that use nothing of `formfactor`:
//! `cargo run --release -p tests --example obstructed_pairs [-- PAIRS [FIRST [TOLERANCE ...]]]`; 400 pairs from seed 0 at 1e-2 to
//! 1e-8 by default.
//!
//! It prints for each family and tolerance how many errors are beyond the tolerance and beyond the estimate, and after the
//! table each of them by its seed. `-- PAIRS FIRST freeze` prints references as they stand in `tests/cases/obstructed.json`.
use formfactor::{Enclosure, Limits, PlanarPolygon};
use std::error::Error;
use std::io::{self, Write};
use std::thread;
use std::time::Instant;
use tests::obstructed::{FAMILIES, Pair, pair};

const TOLERANCES: [f64; 7] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// A pair at a tolerance.
struct Outcome {
    seed: u64,
    tolerance: f64,
    error: f64,
    estimate: f64,
    evaluations: u64,
    seconds: f64,
}

impl Outcome {
    fn is_beyond_tolerance(&self) -> bool {
        self.error > self.tolerance
    }

    fn is_beyond_estimate(&self) -> bool {
        self.error > self.estimate
    }

    /// It says itself that it gave up.
    fn is_unfinished(&self) -> bool {
        self.estimate > self.tolerance
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let pairs: u64 = arguments.next().map_or(Ok(400), |text| text.parse())?;
    let first: u64 = arguments.next().map_or(Ok(0), |text| text.parse())?;
    let rest: Vec<String> = arguments.collect();
    let seeds = first..first + pairs;
    if rest == ["freeze"] {
        return freeze(seeds);
    }
    let asked: Result<Vec<f64>, _> = rest.iter().map(|text| text.parse()).collect();
    let asked = asked?;
    let tolerances = if asked.is_empty() { TOLERANCES.to_vec() } else { asked };
    report(&outcomes(seeds, &tolerances), &tolerances)
}

/// Of all seeds, by all threads, in the order of the seeds.
fn outcomes(seeds: std::ops::Range<u64>, tolerances: &[f64]) -> Vec<Outcome> {
    let threads = u64::try_from(thread::available_parallelism().map_or(1, usize::from)).unwrap_or(1);
    let share = |start: u64| {
        let own = seeds.clone().filter(move |seed| seed % threads == start);
        own.flat_map(|seed| check(seed, tolerances)).collect::<Vec<_>>()
    };
    let mut found: Vec<Outcome> = thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|start| scope.spawn(move || share(start))).collect();
        running.into_iter().flat_map(|thread| thread.join().unwrap_or_default()).collect()
    });
    found.sort_by_key(|outcome| outcome.seed);
    found
}

fn check(seed: u64, tolerances: &[f64]) -> Vec<Outcome> {
    let pair = pair(seed);
    let (expected, slack) = (pair.form_factor(), pair.uncertainty());
    let Some(enclosure) = enclosure(&pair) else { return Vec::new() };
    let outcome = |&tolerance: &f64| {
        let start = Instant::now();
        let found = enclosure.area_form_factor(0, 1, tolerance, &Limits::default()).ok()??;
        Some(Outcome {
            seed,
            tolerance,
            error: ((found.value - expected).abs() - slack).max(0.0),
            estimate: found.error_estimate,
            evaluations: found.evaluations,
            seconds: start.elapsed().as_secs_f64(),
        })
    };
    tolerances.iter().filter_map(outcome).collect()
}

fn enclosure(pair: &Pair) -> Option<Enclosure> {
    let polygons: Result<Vec<_>, _> = pair.polygons().into_iter().map(|p| PlanarPolygon::new([p])).collect();
    polygons.ok().map(Enclosure::new)
}

fn report(found: &[Outcome], tolerances: &[f64]) -> Result<(), Box<dyn Error>> {
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "| family | tolerance | pairs | beyond tolerance | beyond estimate | unfinished | evaluations, mean | ms, mean |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- |"
    )?;
    for family in 0..u64::try_from(FAMILIES)? {
        let name = pair(family).family;
        for tolerance in tolerances {
            let own: Vec<&Outcome> = found
                .iter()
                .filter(|o| o.seed % FAMILIES as u64 == family && o.tolerance == *tolerance)
                .collect();
            let count = |is: fn(&Outcome) -> bool| own.iter().filter(|o| is(o)).count();
            let pairs = own.len().max(1) as f64;
            writeln!(
                out,
                "| {name} | {tolerance:e} | {} | {} | {} | {} | {:.0} | {:.2} |",
                own.len(),
                count(Outcome::is_beyond_tolerance),
                count(Outcome::is_beyond_estimate),
                count(Outcome::is_unfinished),
                own.iter().map(|o| o.evaluations as f64).sum::<f64>() / pairs,
                own.iter().map(|o| 1e3 * o.seconds).sum::<f64>() / pairs,
            )?;
        }
    }
    for outcome in found.iter().filter(|o| o.is_beyond_tolerance() || o.is_beyond_estimate()) {
        let Outcome { seed, tolerance, error, estimate, .. } = outcome;
        let what = if outcome.is_beyond_tolerance() { "tolerance" } else { "estimate" };
        writeln!(
            out,
            "beyond {what}: {}, tolerance {tolerance:e}: off by {error:.1e}, estimate {estimate:.1e}",
            pair(*seed).name
        )?;
    }
    Ok(())
}

fn freeze(seeds: std::ops::Range<u64>) -> Result<(), Box<dyn Error>> {
    let lines: Vec<String> = seeds
        .map(|seed| {
            let pair = pair(seed);
            format!(
                "  {{\"seed\": {seed}, \"family\": \"{}\", \"form_factor\": {:e}}}",
                pair.family,
                pair.form_factor()
            )
        })
        .collect();
    writeln!(io::stdout().lock(), "[\n{}\n]", lines.join(",\n"))?;
    Ok(())
}
