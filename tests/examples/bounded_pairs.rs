//! How wide proven form factors between areas are, and whether they hold: pairs past obstructions against references that use
//! nothing of `formfactor`:
//! `cargo run --release -p tests --example bounded_pairs [-- PAIRS [FIRST [TOLERANCE ...]]]`; 200 pairs from seed 0 at 1e-4 by
//! default.
//!
//! Each pair gets a hundred times the evaluations that the estimate takes at the same tolerance. It prints for each tolerance how many
//! intervals are wrong, how many are wider than the tolerance, and evaluations and time as multiples of those of the estimate.
use formfactor::{Enclosure, Limits, PlanarPolygon};
use std::error::Error;
use std::io::{self, Write};
use std::thread;
use std::time::Instant;
use tests::obstructed::{Pair, pair};

/// A pair at a tolerance.
struct Outcome {
    seed: u64,
    /// How far the reference is beyond the bound.
    beyond: f64,
    width: f64,
    /// Evaluations and seconds, of the bound and of the estimate.
    evaluations: [u64; 2],
    seconds: [f64; 2],
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let pairs: u64 = arguments.next().map_or(Ok(200), |text| text.parse())?;
    let first: u64 = arguments.next().map_or(Ok(0), |text| text.parse())?;
    let asked: Result<Vec<f64>, _> = arguments.map(|text| text.parse()).collect();
    let asked = asked?;
    for tolerance in if asked.is_empty() { vec![1e-4] } else { asked } {
        report(tolerance, &outcomes(first..first + pairs, tolerance))?;
    }
    Ok(())
}

/// Of all seeds, by all threads, in the order of the seeds.
fn outcomes(seeds: std::ops::Range<u64>, tolerance: f64) -> Vec<Outcome> {
    let threads = u64::try_from(thread::available_parallelism().map_or(1, usize::from)).unwrap_or(1);
    let share = |start: u64| {
        let own = seeds.clone().filter(move |seed| seed % threads == start);
        own.filter_map(|seed| check(seed, tolerance)).collect::<Vec<_>>()
    };
    let mut found: Vec<Outcome> = thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|start| scope.spawn(move || share(start))).collect();
        running.into_iter().flat_map(|thread| thread.join().unwrap_or_default()).collect()
    });
    found.sort_by_key(|outcome| outcome.seed);
    found
}

fn check(seed: u64, tolerance: f64) -> Option<Outcome> {
    let pair = pair(seed);
    let enclosure = enclosure(&pair)?;
    let start = Instant::now();
    let estimate = enclosure.area_form_factor(0, 1, tolerance, &Limits::default()).ok()??;
    let between = Instant::now();
    let limits = Limits { per_pair: 100 * estimate.evaluations.max(10), ..Limits::default() };
    // An interval is as wide as twice its bound.
    let found = enclosure.bounded_area_form_factor(0, 1, tolerance / 2.0, &limits).ok()??;
    let end = Instant::now();
    Some(Outcome {
        seed,
        beyond: (found.value - pair.form_factor()).abs() - pair.uncertainty() - found.error_bound,
        width: 2.0 * found.error_bound,
        evaluations: [found.evaluations, estimate.evaluations.max(1)],
        seconds: [(end - between).as_secs_f64(), (between - start).as_secs_f64()],
    })
}

fn enclosure(pair: &Pair) -> Option<Enclosure> {
    let polygons: Result<Vec<_>, _> = pair.polygons().into_iter().map(|p| PlanarPolygon::new([p])).collect();
    polygons.ok().map(Enclosure::new)
}

fn report(tolerance: f64, found: &[Outcome]) -> Result<(), Box<dyn Error>> {
    let mut out = io::stdout().lock();
    let wide = |outcome: &&Outcome| outcome.width > tolerance;
    writeln!(
        out,
        "{tolerance:e}: {} pairs, {} wrong, {} wider; evaluations {}, time {} times those of the estimate",
        found.len(),
        found.iter().filter(|outcome| outcome.beyond > 0.0).count(),
        found.iter().filter(wide).count(),
        quantiles(found.iter().map(|o| o.evaluations[0] as f64 / o.evaluations[1] as f64).collect()),
        quantiles(found.iter().map(|o| o.seconds[0] / o.seconds[1]).collect()),
    )?;
    for outcome in found.iter().filter(|outcome| outcome.beyond > 0.0) {
        writeln!(
            out,
            "wrong: {}, by {:.1e} more than {:.1e}",
            pair(outcome.seed).name,
            outcome.beyond,
            outcome.width / 2.0
        )?;
    }
    for outcome in found.iter().filter(wide) {
        let [own, estimate] = outcome.evaluations;
        writeln!(
            out,
            "wide: {}, {:.1e} after {own} evaluations of {estimate}",
            pair(outcome.seed).name,
            outcome.width
        )?;
    }
    Ok(())
}

/// Median, and what 90 and 95 of 100 stay below.
fn quantiles(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    let at = |share: usize| values.get(values.len() * share / 100).copied().unwrap_or(0.0);
    format!("{:.1} (90 %: {:.1}, 95 %: {:.1})", at(50), at(90), at(95))
}
