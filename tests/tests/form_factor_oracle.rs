//! `formfactor` against the angular sweep: on the reference cases, and on random enclosures. `FORM_FACTOR_ENCLOSURES`
//! sets the number of the latter.
use formfactor::{DifferentialArea, Enclosure, FormFactor, PlanarPolygon, by_hierarchy};
use glam::DVec3;
use serde_json::Value;
use tests::enclosures::{Surroundings, surroundings};
use tests::sweep::{self, Loops, Sweep};

fn vector(v: &Value) -> DVec3 {
    DVec3::from([0, 1, 2].map(|i| v[i].as_f64().expect("a number")))
}

fn list(v: &Value) -> &[Value] {
    v.as_array().expect("a list")
}

fn loops(v: &Value) -> Loops {
    list(v).iter().map(|l| list(l).iter().map(vector).collect()).collect()
}

#[test]
fn the_sweep_finds_the_reference_values() {
    let data = include_str!("../../crates/formfactor/tests/data/form_factor_point.json");
    let data: Value = serde_json::from_str(data).expect("JSON");
    for case in list(&data["cases"]) {
        let occluders: Vec<Loops> = list(&case["occluders"]).iter().map(loops).collect();
        let (point, normal) = (vector(&case["point"]), vector(&case["normal"]));
        let found = sweep::form_factor(point, normal, &loops(&case["target"]), &occluders);
        let expected: f64 = case["form_factor"].as_str().and_then(|s| s.parse().ok()).expect("a number");
        let error = (found.value - expected).abs();
        assert!(error <= 1e-15 && error <= found.error, "{}: off by {error:e}", case["name"]);
    }
}

fn polygon(loops: &Loops) -> PlanarPolygon {
    PlanarPolygon::new(loops).expect("a planar polygon")
}

/// Whether a value is what the sweep found, within what both say of themselves.
fn agrees(found: FormFactor, swept: Sweep, what: &str, name: &str) -> Result<(), String> {
    let error = (found.value - swept.value).abs();
    if error <= found.error_bound + swept.error && found.error_bound <= 1e-7 {
        return Ok(());
    }
    Err(format!("{name}: {what} gives {found:?}, the sweep {swept:?}, off by {error:e}"))
}

/// Every polygon from a point that belongs to none.
fn check(case: &Surroundings) -> Result<(), String> {
    let polygons: Vec<PlanarPolygon> = case.polygons.iter().map(polygon).collect();
    let from = DifferentialArea::new(case.position, case.normal).expect("a direction");
    let row = Enclosure::new(polygons.clone()).row(&from);
    for (id, factor) in row.iter().enumerate() {
        let others: Vec<Loops> = [&case.polygons[..id], &case.polygons[id + 1..]].concat();
        let swept = sweep::form_factor(case.position, case.normal, &case.polygons[id], &others);
        let name = format!("{}, polygon {id}", case.name);
        agrees(*factor, swept, "the visible part", &name)?;
        let others = [&polygons[..id], &polygons[id + 1..]].concat();
        agrees(by_hierarchy(&from, &polygons[id], &others), swept, "the hierarchy", &name)?;
    }
    Ok(())
}

fn enclosures() -> u64 {
    let asked = std::env::var("FORM_FACTOR_ENCLOSURES").ok();
    asked.map_or(240, |count| count.parse().expect("FORM_FACTOR_ENCLOSURES is a number"))
}

#[test]
fn random_enclosures_are_as_the_sweep_sees_them() {
    let (count, threads) = (enclosures(), 2);
    let every = |start: u64| {
        let seeds = (start..count).step_by(2);
        seeds.filter_map(|seed| check(&surroundings(seed)).err()).take(8).collect::<Vec<_>>()
    };
    let failures: Vec<String> = std::thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|start| scope.spawn(move || every(start))).collect();
        running.into_iter().flat_map(|t| t.join().expect("the check itself does not panic")).collect()
    });
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
