//! Unoccluded form factors against closed forms evaluated to 25 digits.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{DVec3, DifferentialArea, PlanarPolygon, unoccluded, unoccluded_complement};

fn value(id: &str) -> (String, f64) {
    let data: serde_json::Value = serde_json::from_str(include_str!("data/closed_forms.json")).unwrap();
    let forms = data["closed_forms"].as_array().unwrap();
    let form = forms.iter().find(|f| f["id"] == id).unwrap_or_else(|| panic!("no closed form {id}"));
    (form["gives"].as_str().unwrap().to_owned(), form["value"].as_str().unwrap().parse().unwrap())
}

fn area(position: [f64; 3], normal: [f64; 3]) -> DifferentialArea {
    DifferentialArea::new(position.into(), normal.into()).unwrap()
}

/// The polygon through these points, its front toward dA at `position`.
fn facing(position: [f64; 3], points: &[[f64; 3]]) -> PlanarPolygon {
    let polygon = PlanarPolygon::new([points]).unwrap();
    let towards = DVec3::from(position) - DVec3::from(points[0]);
    if polygon.normal().dot(towards) > 0.0 {
        return polygon;
    }
    let reversed: Vec<_> = points.iter().rev().copied().collect();
    PlanarPolygon::new([reversed]).unwrap()
}

fn ceiling([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], z: f64) -> Vec<[f64; 3]> {
    vec![[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]]
}

fn wall(x: f64, [y0, y1]: [f64; 2], [z0, z1]: [f64; 2]) -> Vec<[f64; 3]> {
    vec![[x, y0, z0], [x, y1, z0], [x, y1, z1], [x, y0, z1]]
}

/// An entry's id, the position of dA, its normal, and the target.
type Setup = (&'static str, [f64; 3], [f64; 3], Vec<[f64; 3]>);

/// Every point entry that a contour sum reaches.
fn setups() -> Vec<Setup> {
    let (o, z) = ([0.0; 3], [0.0, 0.0, 1.0]);
    let ngon = (0..64).map(|i| f64::from(i) / 32.0 * std::f64::consts::PI);
    let ngon = ngon.map(|t| [t.cos(), t.sin(), 1.0]).collect();
    let (unit, two) = ([0.0, 1.0], [-1.0, 1.0]);
    vec![
        ("dA-par-corner-1-1-1", o, z, ceiling(unit, unit, 1.0)),
        ("dA-par-corner-2-3-0.5", o, z, ceiling([0.0, 2.0], [0.0, 3.0], 0.5)),
        ("dA-par-centre-2x2-z2", o, z, ceiling(two, two, 2.0)),
        ("dA-par-offset", [3.0, -1.0, 0.0], z, ceiling(unit, [0.0, 2.0], 1.0)),
        ("dA-perp-corner-1-1-1", o, z, wall(1.0, unit, unit)),
        ("dA-perp-corner-1-2-0.25", o, z, wall(0.25, [0.0, 2.0], unit)),
        ("dA-tri", o, z, vec![[1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]]),
        (
            "dA-tri-generic",
            [0.1, 0.2, 0.3],
            [1.0, 2.0, 2.0],
            vec![[1.0, 0.0, 1.0], [0.0, 2.0, 3.0], [-1.0, 1.0, 2.0]],
        ),
        ("dA-ngon-64-r1-h1", o, z, ngon),
        ("dA-horizon-clip", o, z, wall(1.0, two, two)),
        ("dA-near-1e-3", o, z, ceiling(two, two, 1e-3)),
        ("dA-near-1e-6", o, z, ceiling(two, two, 1e-6)),
        ("dA-near-1e-9", o, z, ceiling(two, two, 1e-9)),
        ("dA-near-1e-12", o, z, ceiling(two, two, 1e-12)),
        ("dA-far-1e3", o, z, ceiling(two, two, 1e3)),
        ("dA-far-1e6", o, z, ceiling(two, two, 1e6)),
        ("dA-far-1e12", o, z, ceiling(two, two, 1e12)),
        ("dA-grazing-1e-3", o, z, wall(1e-3, two, [1.0, 2.0])),
        ("dA-grazing-1e-6", o, z, wall(1e-6, two, [1.0, 2.0])),
        ("dA-grazing-1e-9", o, z, wall(1e-9, two, [1.0, 2.0])),
        ("dA-grazing-1e-12", o, z, wall(1e-12, two, [1.0, 2.0])),
        ("dA-grazing-1e-15", o, z, wall(1e-15, two, [1.0, 2.0])),
        ("dA-wall-c-1e-3", o, z, wall(1e-3, two, unit)),
        ("dA-wall-c-1e-6", o, z, wall(1e-6, two, unit)),
        ("dA-wall-c-1e-9", o, z, wall(1e-9, two, unit)),
        ("dA-wall-c-1e-12", o, z, wall(1e-12, two, unit)),
    ]
}

/// Point entries that no contour sum over a polygon reaches, and why.
const OUT_OF_REACH: [(&str, &str); 3] = [
    ("dA-disk-coaxial-r1-h1", "a disk is no polygon: a regular 1024-gon is off by 1.6e-6"),
    ("dA-disk-offset-r1-h1-a2", "a disk is no polygon: a regular 1024-gon is off by 4.3e-7"),
    (
        "dA-wall-on-plane-limit",
        "a limit: dA on the target's plane sees 0, at 2^-52 before it 1/2 within 5e-16",
    ),
];

/// Relative errors of `1 - unoccluded`, where `unoccluded_complement` has none to speak of.
const LOST_BY_SUBTRACTION: [(&str, f64); 4] =
    [("dA-near-1e-3", 2e-10), ("dA-near-1e-6", 1e-4), ("dA-near-1e-9", 1.0), ("dA-near-1e-12", 1.0)];

#[test]
fn point_factors_equal_their_closed_forms() {
    for (id, position, normal, points) in setups() {
        let (gives, given) = value(id);
        let (from, to) = (area(position, normal), facing(position, &points));
        let factor = match gives.as_str() {
            "complement" => unoccluded_complement(&from, &to),
            _ => unoccluded(&from, &to),
        };
        let expected = if gives == "half_minus" { 0.5 - given } else { given };
        let error = (factor.value - expected).abs();
        println!("{id:28} {:e} off by {error:.1e}, bound {:.1e}", factor.value, factor.error_bound);
        // The reference is rounded to a double, and once more where it is taken from 1/2.
        let rounding = expected * f64::EPSILON;
        assert!(
            error <= factor.error_bound + rounding,
            "{id}: {error:e} is over the bound {:e}",
            factor.error_bound
        );
        assert!(error <= 1e-13 * expected, "{id}: off by {error:e}");
    }
}

#[test]
fn every_point_entry_is_reached_or_excused() {
    let data: serde_json::Value = serde_json::from_str(include_str!("data/closed_forms.json")).unwrap();
    let entries = data["closed_forms"].as_array().unwrap().iter().filter(|f| f["kind"] == "point");
    let reached: Vec<&str> = setups().iter().map(|s| s.0).chain(OUT_OF_REACH.map(|o| o.0)).collect();
    for entry in entries {
        assert!(reached.contains(&entry["id"].as_str().unwrap()), "{} is neither", entry["id"]);
    }
}

#[test]
fn what_is_out_of_reach_is_as_far_as_stated() {
    let disk = |x: f64| -> Vec<[f64; 3]> {
        let turn = |i: i32| f64::from(i) / 512.0 * std::f64::consts::PI;
        (0..1024).map(|i| [x + turn(i).cos(), turn(i).sin(), 1.0]).collect()
    };
    for (id, x, stated) in [("dA-disk-coaxial-r1-h1", 0.0, 1.6e-6), ("dA-disk-offset-r1-h1-a2", 2.0, 4.3e-7)]
    {
        let factor = unoccluded(&area([0.0; 3], [0.0, 0.0, 1.0]), &facing([0.0; 3], &disk(x)));
        let error = (factor.value - value(id).1).abs();
        assert!(error < stated && error > 0.5 * stated, "{id}: {error:e}");
    }
    let from = area([0.0; 3], [0.0, 0.0, 1.0]);
    let standing = |x: f64| PlanarPolygon::new([wall(x, [1.0, -1.0], [0.0, 1.0])]).unwrap();
    assert_eq!(unoccluded(&from, &standing(0.0)).value, 0.0);
    assert!((unoccluded(&from, &standing(f64::EPSILON)).value - 0.5).abs() <= 5e-16);
}

#[test]
fn subtraction_loses_what_the_complement_keeps() {
    for (id, stated) in LOST_BY_SUBTRACTION {
        let (_, position, normal, points) = setups().into_iter().find(|s| s.0 == id).unwrap();
        let (from, to) = (area(position, normal), facing(position, &points));
        let (expected, plain) = (value(id).1, 1.0 - unoccluded(&from, &to).value);
        assert!((plain - expected).abs() <= stated * expected, "{id}: {plain:e}");
        assert!((unoccluded_complement(&from, &to).value - expected).abs() <= 1e-15 * expected, "{id}");
    }
}

#[test]
fn factor_and_complement_add_to_one() {
    for (id, position, normal, points) in setups() {
        let (from, to) = (area(position, normal), facing(position, &points));
        let (factor, complement) = (unoccluded(&from, &to), unoccluded_complement(&from, &to));
        let bound = factor.error_bound + complement.error_bound + f64::EPSILON;
        assert!((factor.value + complement.value - 1.0).abs() <= bound, "{id}");
    }
}
