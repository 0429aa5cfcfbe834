//! Exact routes to one form factor, side by side on the reference cases: `cargo run --release -p tests --example exact_routes`.
//!
//! The source compares its CSG with sampling alone. Here are three ways that share no topology: `form_factor`, which traces
//! visible edges where doubles decide it (Stark and Riesenfeld 2000) and else goes through polycsg; Equation 3.6 through the
//! regions of polycsg; and the angular sweep, which uses neither projection nor polygons. Times are the shortest of several
//! calls; differences are those of each route from the reference, by 1e-16.
use formfactor::{DifferentialArea, PlanarPolygon, by_hierarchy, form_factor};
use glam::DVec3;
use serde_json::Value;
use std::error::Error;
use std::hint::black_box;
use std::io::{self, Write};
use std::time::Instant;
use tests::sweep::{self, Loops};

fn main() -> Result<(), Box<dyn Error>> {
    let data = include_str!("../../crates/formfactor/tests/data/form_factor_point.json");
    let data: Value = serde_json::from_str(data)?;
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "| case | occluders | traced or CSG | Equation 3.6 | sweep | off | off | off |\n| --- | --- | --- | --- | --- | --- | --- | --- |"
    )?;
    for case in data["cases"].as_array().ok_or("no cases")? {
        writeln!(out, "{}", row(case).ok_or("not a case")?)?;
    }
    Ok(())
}

/// A row of the table.
fn row(case: &Value) -> Option<String> {
    let (position, normal, target) =
        (vector(&case["point"])?, vector(&case["normal"])?, loops(&case["target"])?);
    let hiding: Vec<Loops> = case["occluders"].as_array()?.iter().map(loops).collect::<Option<_>>()?;
    let expected: f64 = case["form_factor"].as_str()?.parse().ok()?;
    let from = DifferentialArea::new(position, normal).ok()?;
    let to = PlanarPolygon::new(&target).ok()?;
    let occluders: Vec<PlanarPolygon> =
        hiding.iter().map(PlanarPolygon::new).collect::<Result<_, _>>().ok()?;
    let routes: [(u32, &dyn Fn() -> f64); 3] = [
        (200, &|| form_factor(&from, &to, &occluders).value),
        (50, &|| by_hierarchy(&from, &to, &occluders).value),
        (3, &|| sweep::form_factor(position, normal, &target, &hiding).value),
    ];
    let times = routes.map(|(count, route)| format!("{:.1} µs", 1e6 * shortest(count, route)));
    let off = routes.map(|(_, route)| format!("{:.1}", 1e16 * (route() - expected).abs()));
    Some(format!(
        "| {} | {} | {} | {} |",
        case["name"].as_str()?,
        occluders.len(),
        times.join(" | "),
        off.join(" | ")
    ))
}

/// The shortest of so many calls, in seconds.
fn shortest(count: u32, route: impl Fn() -> f64) -> f64 {
    let once = || {
        let start = Instant::now();
        black_box(route());
        start.elapsed().as_secs_f64()
    };
    (0..count).map(|_| once()).fold(f64::INFINITY, f64::min)
}

fn vector(v: &Value) -> Option<DVec3> {
    Some(DVec3::new(v[0].as_f64()?, v[1].as_f64()?, v[2].as_f64()?))
}

fn loops(v: &Value) -> Option<Loops> {
    v.as_array()?.iter().map(|l| l.as_array()?.iter().map(vector).collect()).collect()
}
