//! Makes a failing case small and draws it: `cargo run --release -p tests --example shrink -- CASE FAILURE OUT`.
//!
//! CASE is a file of the corpus' format (`tests/corpus`; its areas are not read). OUT.json is the smallest case found that
//! still fails, areas by the oracle, and OUT.svg a picture of it: to scale, and again with its coordinates evenly spaced,
//! which shows what happens within an ulp. FAILURE is one of
//!
//! - `invalid`: a result breaks a law of a valid region, or there is none for a panic;
//! - `differs`: a result is not the oracle's;
//! - `slabs`: a result changes in company that sends it down another path;
//! - `repaired`: rounding makes edges meet. No failure of ours, but a way to see this at work.
use glam::DVec2;
use polycsg::{Csg, FillRule, Region};
use std::error::Error;
use std::fmt::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use tests::against::{Verdict, check, csg, leaf, shapes};
use tests::company::{Company, without_company};
use tests::generators::Pair;
use tests::oracle::{Arrangement, Operation};
use tests::{Ring, corpus, shrink::shrink, validity};

type Failure = fn(&Pair, Operation) -> bool;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [case, failure, out] = arguments.as_slice() else {
        return Err("usage: shrink CASE invalid|differs|slabs|repaired OUT".into());
    };
    let asked = failure_of(failure).ok_or(format!("no failure {failure:?}"))?;
    let fails = |pair: &Pair| Operation::ALL.iter().any(|&operation| asked(pair, operation));
    let pair = corpus::read_pair(Path::new(case))?;
    if !fails(&pair) {
        return Err(format!("{case} is not {failure}; there is nothing to shrink").into());
    }
    let small = shrink(pair, fails);
    std::fs::write(format!("{out}.json"), corpus::written(&small, &format!("{case}, shrunk: {failure}")))?;
    std::fs::write(format!("{out}.svg"), drawn(&small))?;
    Ok(())
}

fn failure_of(name: &str) -> Option<Failure> {
    match name {
        "invalid" => Some(|pair, operation| {
            let result = catch_unwind(AssertUnwindSafe(|| evaluated(pair, operation)));
            result.map_or(true, |region| validity::check(&shapes(&region)).is_err())
        }),
        "differs" => Some(|pair, operation| verdict(pair, operation).is_none()),
        "slabs" => Some(|pair, operation| Company::ALL.iter().any(|&c| changes_in(c, pair, operation))),
        "repaired" => Some(|pair, operation| verdict(pair, operation) == Some(Verdict::Repaired)),
        _ => None,
    }
}

fn evaluated(pair: &Pair, operation: Operation) -> Region {
    csg(operation, leaf(&pair.a), leaf(&pair.b)).evaluate()
}

/// What the oracle says; nothing where it disagrees, or where there is a panic.
fn verdict(pair: &Pair, operation: Operation) -> Option<Verdict> {
    let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
    catch_unwind(AssertUnwindSafe(|| check(pair, operation, &arrangement).ok())).unwrap_or(None)
}

fn changes_in(company: Company, pair: &Pair, operation: Operation) -> bool {
    let size = rings(pair).flatten().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let Some(others) = company.rings(size) else { return false };
    let others = Csg::from_rings(&others, FillRule::NonZero).expect("finite points");
    let together = csg(operation, leaf(&pair.a), leaf(&pair.b)) | others;
    without_company(&together.evaluate(), size) != shapes(&evaluated(pair, operation))
}

fn rings(pair: &Pair) -> impl Iterator<Item = &Ring> {
    pair.a.rings.iter().chain(&pair.b.rings)
}

/// Side of a panel, and the margin inside it.
const SIDE: f64 = 480.0;
const MARGIN: f64 = 24.0;

/// Two panels: to scale, and by the order of the coordinates.
fn drawn(pair: &Pair) -> String {
    let points = || rings(pair).flatten();
    let low = points().copied().reduce(DVec2::min).unwrap_or(DVec2::ZERO);
    let high = points().copied().reduce(DVec2::max).unwrap_or(DVec2::ONE);
    let scale = (high - low).max_element().max(f64::MIN_POSITIVE);
    let [xs, ys] = [0, 1].map(|axis| {
        let mut values: Vec<f64> = points().map(|p| p[axis]).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    });
    let rank = |values: &[f64], x: f64| {
        values.partition_point(|&value| value < x) as f64 / (values.len().max(2) - 1) as f64
    };
    let panels = [
        panel(pair, 0.0, |p| (p - low) / scale),
        panel(pair, SIDE, |p| DVec2::new(rank(&xs, p.x), rank(&ys, p.y))),
    ];
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {SIDE}\"><style>.a{{fill:#0072b233;stroke:#0072b2}}\
         .b{{fill:#d55e0033;stroke:#d55e00}}path{{fill-rule:evenodd}}text{{font:11px sans-serif}}</style>\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>{}</svg>\n",
        2.0 * SIDE,
        panels.concat()
    )
}

fn panel(pair: &Pair, left: f64, place: impl Fn(DVec2) -> DVec2) -> String {
    let pixel = |p: &DVec2| {
        let inner = SIDE - 2.0 * MARGIN;
        let at = place(*p);
        DVec2::new(left + MARGIN + inner * at.x, SIDE - MARGIN - inner * at.y)
    };
    let mut svg = String::new();
    for (class, operand) in [("a", &pair.a), ("b", &pair.b)] {
        for ring in &operand.rings {
            let corners = ring.iter().map(|p| format!("{:.3} {:.3}", pixel(p).x, pixel(p).y));
            let path = corners.collect::<Vec<_>>().join("L");
            // Writing to a string cannot fail.
            let _ = write!(svg, "<path class=\"{class}\" d=\"M{path}Z\"/>");
            for (point, number) in ring.iter().zip(0..) {
                let at = pixel(point) + DVec2::new(3.0, -3.0);
                let _ = write!(svg, "<text x=\"{:.1}\" y=\"{:.1}\">{class}{number}</text>", at.x, at.y);
            }
        }
    }
    svg
}
