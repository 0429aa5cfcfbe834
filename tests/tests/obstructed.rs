//! Form factors from area to area past obstructions, against references that use nothing of `formfactor`.
use formfactor::{AreaFormFactor, Enclosure, Limits, PlanarPolygon};
use glam::{DMat3, DVec3};
use serde_json::Value;
use std::path::Path;
use tests::obstructed::{Pair, Plate, Plates, Prisms, Setting, pair};

/// All frozen pairs are within these, and within their estimates.
const TOLERANCES: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

fn read(name: &str) -> Vec<Value> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    let text = std::fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()))
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The frozen pairs with their references.
fn frozen() -> Vec<(Pair, f64)> {
    let entry = |v: &Value| {
        let found = pair(v["seed"].as_u64().expect("a seed"));
        assert_eq!(found.family, v["family"], "{}", found.name);
        (found, number(&v["form_factor"]))
    };
    read("obstructed.json").iter().map(entry).collect()
}

/// Pairs that were found wrong, with their tolerances and references.
fn named() -> Vec<(Pair, f64, f64)> {
    let plate = |v: &Value| {
        let [x0, x1, y0, y1, height] = [0, 1, 2, 3, 4].map(|i| number(&v[i]));
        Plate { x: [x0, x1], y: [y0, y1], height }
    };
    let entry = |v: &Value| {
        let blockers = v["blockers"].as_array().expect("a list").iter().map(plate).collect();
        let plates = Plates { source: plate(&v["source"]), target: plate(&v["target"]), blockers };
        let name = v["name"].as_str().expect("a name").to_owned();
        (Pair::upright(name, plates), number(&v["tolerance"]), number(&v["form_factor"]))
    };
    read("area.json").iter().map(entry).collect()
}

fn found(pair: &Pair, tolerance: f64) -> AreaFormFactor {
    found_among(pair.polygons(), tolerance)
}

fn found_among(polygons: Vec<Vec<DVec3>>, tolerance: f64) -> AreaFormFactor {
    let polygon = |points| PlanarPolygon::new([points]).expect("a planar polygon");
    let enclosure = Enclosure::new(polygons.into_iter().map(polygon).collect());
    enclosure
        .area_form_factor(0, 1, tolerance, &Limits::default())
        .expect("a tolerance above 0")
        .expect("no stop")
}

/// What is wrong with a pair at a tolerance.
fn complaint(pair: &Pair, expected: f64, tolerance: f64) -> Option<String> {
    let found = found(pair, tolerance);
    let error = (found.value - expected).abs() - pair.uncertainty();
    let is_right = error <= tolerance && error <= found.error_estimate;
    (!is_right).then(|| format!("{} at {tolerance:e}: {found:?} is off by {error:e}", pair.name))
}

#[test]
fn frozen_pairs_are_within_their_tolerances() {
    let frozen = frozen();
    assert!(frozen.len() >= 400, "only {} pairs", frozen.len());
    let check = |(pair, expected): &(Pair, f64)| {
        let complaints = TOLERANCES.iter().map(|t| complaint(pair, *expected, *t));
        complaints.flatten().collect::<Vec<_>>()
    };
    let share = |start: usize| frozen.iter().skip(start).step_by(2).flat_map(check).collect::<Vec<_>>();
    let failures: Vec<String> = std::thread::scope(|scope| {
        let running = [0, 1].map(|start| scope.spawn(move || share(start)));
        running.into_iter().flat_map(|t| t.join().expect("the check itself does not panic")).collect()
    });
    assert!(failures.is_empty(), "{} of them:\n{}", failures.len(), failures.join("\n"));
}

/// Every fourth frozen pair turned and far from the origin: what its corners are rounded to moves it by more than some tolerances.
#[test]
fn frozen_pairs_elsewhere_are_within_their_tolerances() {
    let turn = DMat3::from_axis_angle(DVec3::new(0.48, 0.6, 0.64), 0.7);
    let check = |(pair, exact): &(Pair, f64)| {
        let mut failures = Vec::new();
        for far in [5e5, 5e6] {
            let place = |p: DVec3| turn * p + far * DVec3::new(1.0, 0.7, -0.3);
            let polygons: Vec<Vec<DVec3>> =
                pair.polygons().into_iter().map(|points| points.into_iter().map(place).collect()).collect();
            let sizes = polygons.iter().map(|points| points[0].distance(points[2]));
            let moved = 32.0 * f64::EPSILON * far / sizes.fold(f64::INFINITY, f64::min);
            for tolerance in TOLERANCES {
                let found = found_among(polygons.clone(), tolerance);
                let error = (found.value - exact).abs() - pair.uncertainty() - moved;
                if error > tolerance || error > found.error_estimate {
                    failures.push(format!("{} at {far} to {tolerance:e}: {found:?}, {exact:e}", pair.name));
                }
            }
        }
        failures
    };
    let failures: Vec<String> = frozen().iter().step_by(4).flat_map(check).collect();
    assert!(failures.is_empty(), "{} of them:\n{}", failures.len(), failures.join("\n"));
}

/// Every other frozen pair as an interval that holds.
#[test]
fn frozen_pairs_are_within_their_bounds() {
    let frozen = frozen();
    let check = |(pair, exact): &(Pair, f64)| {
        let polygon = |points| PlanarPolygon::new([points]).expect("a planar polygon");
        let enclosure = Enclosure::new(pair.polygons().into_iter().map(polygon).collect());
        let limits = Limits { per_pair: 20_000, ..Limits::default() };
        let found = enclosure.bounded_area_form_factor(0, 1, 5e-4, &limits);
        let found = found.expect("a tolerance above 0").expect("no stop");
        let is_right = (found.value - exact).abs() <= found.error_bound + pair.uncertainty();
        (!is_right || found.error_bound > 5e-4).then(|| format!("{}: {found:?}, {exact:e}", pair.name))
    };
    let share = |start: usize| frozen.iter().skip(start).step_by(4).filter_map(check).collect::<Vec<_>>();
    let failures: Vec<String> = std::thread::scope(|scope| {
        let running = [0, 3].map(|start| scope.spawn(move || share(start)));
        running.into_iter().flat_map(|t| t.join().expect("the check itself does not panic")).collect()
    });
    assert!(failures.is_empty(), "{} of them:\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn named_cases_are_within_their_tolerances() {
    let named = named();
    assert!(named.len() > 15, "only {} cases", named.len());
    let failures: Vec<String> =
        named.iter().filter_map(|(pair, tolerance, exact)| complaint(pair, *exact, *tolerance)).collect();
    assert!(failures.is_empty(), "{} of them:\n{}", failures.len(), failures.join("\n"));
}

/// Found wrong by seed: edges of three boxes seem to meet along a curve, where errors do not fall as those of analytic integrands; two
/// differences between rules small by chance; a grille close to the source, where rules of few nodes say nothing; a box so close that its
/// cuts were too many, and a shadow in the corner of what was left uncut.
#[test]
fn seeds_that_were_wrong_are_within_their_tolerances() {
    let cases = [
        (20055, 1e-8),
        (20055, 1e-10),
        (20271, 1e-8),
        (20271, 1e-10),
        (70089, 1e-6),
        (60251, 1e-2),
        (5_001_543, 1e-7),
    ];
    let failures: Vec<String> = cases
        .into_iter()
        .filter_map(|(seed, tolerance)| complaint(&pair(seed), pair(seed).form_factor(), tolerance))
        .collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The references of the named cases are by product quadrature; those of fuzzed ones are the closed form itself.
#[test]
fn the_closed_form_is_that_of_product_quadrature() {
    for (pair, _, exact) in named().into_iter().filter(|case| !case.0.name.starts_with("fuzzed")) {
        let error = (pair.form_factor() - exact).abs();
        // The far one's terms are 4e3 times as large as those of the others.
        assert!(
            error <= 1e-14 || (pair.name == "parallel-28" && error <= 1e-11),
            "{}: off by {error:e}",
            pair.name
        );
    }
}

#[test]
fn the_closed_form_is_that_of_quadrature_across() {
    let few = (0..120).map(pair).filter(|pair| pair.polygons().len() <= 6);
    let both = few.filter_map(|pair| match &pair.setting {
        Setting::Plates(plates) => {
            Some((plates.form_factor(), Prisms::from(plates).form_factor(), pair.name))
        }
        Setting::Prisms(_) => None,
    });
    let mut compared = 0;
    for (closed, across, name) in both {
        assert!((closed - across).abs() <= 1e-14, "{name}: {closed:e} and {across:e}");
        compared += 1;
    }
    assert!(compared >= 60, "only {compared} pairs");
}

/// A generator that drifted would test something else under an old name.
#[test]
fn frozen_references_are_those_of_today() {
    for (pair, expected) in frozen() {
        if matches!(pair.setting, Setting::Plates(_)) || pair.polygons().len() < 6 {
            let error = (pair.form_factor() - expected).abs();
            assert!(error <= pair.uncertainty(), "{}: off by {error:e}", pair.name);
        }
    }
}
